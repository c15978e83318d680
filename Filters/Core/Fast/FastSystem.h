#pragma once

#include "Edges/BoundaryCurves.h"
#include "Elements/SlabElements.h"
#include "Fast/MovingParticles.h"
#include "Fast/SlabDistribution.h"
#include "Isolation/SurfaceProxy.h"
#include "Support/Interruptible.h"
#include "Support/Slab.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"

#include <atomic>
#include <functional>
#include <memory>

namespace hop
{

/// A part of the run, between two values of its progress.
struct Section
{
  double begin = 0.0, end = 0.0;

  double at(double share) const { return this->begin + share * (this->end - this->begin); }
};

/// The stages of the Fast distribution, and what they leave to each other. See FastDistribution.h; workers of a part of
/// the surface go on from there (SlabDistribution.h).
class FastSystem
{
public:
  FastSystem(const Isosurface& surface, const DistributionParameters& parameters,
    const Monitor& monitor, const ParallelFor& parallelFor, const Slab& slab = {})
    : Surface(surface)
    , Mesh(*surface.mesh)
    , Parameters(parameters)
    , Sizing(parameters.sizing)
    , Part(slab)
    , Work(monitor, parallelFor)
    , Parallel(std::ref(this->Work))
    , Locator(this->Mesh, surface.isovalue, this->Parallel)
  {
    this->Surface.locator = &this->Locator;
    if (!slab.isEverything())
    {
      this->ReachesOut =
        reachingOutOf(this->Mesh, slab.widened(this->overlap(SlabOverlap::Reach)), this->Parallel);
    }
  }

  Distribution run();
  std::vector<double> countsOfElements();

protected:
  bool relax();
  Distribution takeResult();
  /// Reports how far the work is; may throw Interrupted.
  void reach(double fraction)
  {
    this->Work.raiseFraction(fraction);
    this->Work.ask();
  }
  bool isFineEnough(const SurfaceBox& box, const SizingFunction& sizing);
  bool isOutOfReach(const SurfaceBox& box) const;
  SurfaceProxy proxyOfBoxesAt(const SizingFunction& sizing, double shareOfRun);
  bool tooMany(double count);
  static double countAlongStrips(const SurfaceProxy& proxy);
  bool estimateCount();
  void prepareSurface();
  double targetCount() const;
  void matchSpacing(std::int64_t count);
  double guessSpacing(double count);
  void keepOnBoundary(std::size_t most);
  void traceBoundaryCurves();
  void dropNearBoundaryCurves(double nearest);
  void startMoving();
  void addSamples(const std::vector<int>& boxes);
  void makeSeeds(std::int64_t count);
  void continueFrom(const std::vector<Location>& places);
  void addSeedsBetween(std::int64_t count);
  double overlap(double spacings) const { return spacings * this->Parameters.sizing.spacing; }
  void keepIn(const Slab& slab);
  void keepCurvesIn(const Slab& slab);
  void fixOuterSeeds();
  double seedsLeftFor(const Slab& slab) const;
  void dropOthers();
  std::vector<SurfaceBox> undecidedBoxes();
  bool countIsGiven() const { return this->Parameters.particleCount > 0; }
  void coverBoxes(const Slab& where);
  void relaxInRounds();
  void relaxOnce(int sweeps, bool isLast, const Section& section);
  Balance balanceOf(bool isLast) const;
  void finish();

  Isosurface Surface;
  const ElementMesh& Mesh;
  DistributionParameters Parameters;
  SizingFunction Sizing;
  /// Of the surface, what is wanted of this worker.
  Slab Part;
  /// In a slab, marks the elements of which a part lies where no particles are wanted.
  std::vector<char> ReachesOut;
  Interruptible Work;
  ParallelFor Parallel;
  FaceLocator Locator;
  std::unique_ptr<SurfaceProxy> Proxy;
  FaceJumps Jumps;
  BoundaryCurves Curves;
  /// Patches of the particles on these curves.
  Buffer<Patch> BoundaryPatches;
  /// The number of particles for which they count.
  double BoundaryCount = 0.0;
  std::unique_ptr<MovingParticles> Moving;
  /// In a slab, and in the strip at its end, the number of particles that are to move.
  double TargetInSlab = 0.0;
  double TargetInStrip = 0.0;
  /// In a slab, marks the particles that move whose worker this is. The others are at home in other slabs.
  std::vector<char> IsOwn;
  /// Whether particles of the previous run go on.
  bool IsWarm = false;
  std::atomic<std::int64_t> Evaluations{ 0 };
  Distribution Result;
};

} // namespace hop
