#pragma once

#include "Edges/BoundaryCurves.h"
#include "Elements/SlabElements.h"
#include "Fast/LeastParticles.h"
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

/// Particles on boundary curves.
struct OnBoundary
{
  /// Share of a particle for which each of them counts: half of the area around it lies beyond the surface's end.
  static constexpr double Count = 0.5;
  /// Least distance of a seed from them, in units of the spacing: half the distance sqrt(3)/2 between two rows of
  /// hexagonal packing, so that the first row of seeds comes to lie there on average. Larger: a gap along the curve;
  /// smaller: a crowded row.
  static constexpr double SeedDistance = 0.433;
};

/// Progress, 0 to 1, at the end of the stages: roughly the part of the time that is over. Chosen by experiment; nothing
/// but progress bars depends on it.
struct ProgressAt
{
  static constexpr double Estimated = 0.05;
  static constexpr double Isolated = 0.3;
  static constexpr double Prepared = 0.35;
  static constexpr double Seeded = 0.45;
  static constexpr double Relaxed = 0.9;
};

/// A part of the run, between two values of its progress.
struct Section
{
  double begin = 0.0, end = 0.0;

  double at(double share) const { return this->begin + share * (this->end - this->begin); }
};

/// The stages of the Fast distribution, and what they leave to each other. See FastDistribution.h; workers of a part of
/// the surface go on from there (SlabDistribution.h). Each group of functions has a file named after it.
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
  // The stages, one after the other: FastDistribution.cpp.
  bool relax();
  Distribution takeResult();
  /// Reports how far the work is; may throw Interrupted.
  void reach(double fraction)
  {
    this->Work.raiseFraction(fraction);
    this->Work.ask();
  }
  double overlap(double spacings) const { return spacings * this->Parameters.sizing.spacing; }

  // The surface's boxes and boundary curves: FastSurface.cpp.
  double diagonalPerSpacing(int element) const;
  bool isFineEnough(
    const SurfaceBox& box, const SizingFunction& sizing, const SurfaceProxy* limits);
  bool isOutOfReach(const SurfaceBox& box) const;
  using IsFine = std::function<bool(const SurfaceBox&)>;
  std::vector<SurfaceBox> findBoxes(const IsFine& isFineEnough, const KnownBoxes& known,
    const std::function<void(double)>& progress);
  KnownBoxes boxesBefore(const IsFine& isFineEnough) const;
  bool hasTooManyBoxes() const { return this->BoxCount > this->Parameters.boxLimit(); }
  SurfaceProxy proxyOfBoxesAt(const SizingFunction& sizing, double shareOfRun);
  bool tooMany(double count);
  static double countAlongStrips(const SurfaceProxy& proxy);
  bool estimateCount();
  void prepareSurface();
  void refineBoxes(const std::vector<SizingField::Limit>& limits);
  void findJumps();
  void traceBoundaryCurves();
  void keepCurvesIn(const Slab& slab);
  std::vector<SurfaceBox> undecidedBoxes();

  // A plane cut to a polygon: FastPolygon.cpp.
  bool isFarBeyondPolygon(const SurfaceBox& box) const;
  void dropFarBeyondPolygon(std::vector<SurfaceBox>& boxes) const;
  void placeOnPolygon();
  void dropBeyondPolygon(const Buffer<Particle>& finished, std::vector<char>& kept) const;

  // The spacing that goes with a given number of particles: FastSpacing.cpp.
  bool countIsGiven() const { return this->Parameters.particleCount > 0; }
  double targetCount() const;
  void matchSpacing(std::int64_t count);
  double guessSpacing(double count);
  void keepOnBoundary(std::size_t most);
  std::int64_t placesOnCurves() const;
  std::int64_t sizeForGivenNumber() const;

  // First positions of particles: FastSeeds.cpp.
  void makeSeeds(std::int64_t count);
  void startMoving();
  void continueFrom(const std::vector<Location>& places);
  void changeStart(std::int64_t count);
  void addSeedsBetween(std::int64_t count);
  void dropNearBoundaryCurves(double nearest);
  void addSamples(const std::vector<int>& boxes);
  void coverBoxes(const Slab& where);
  void fixOuterSeeds();
  double seedsLeftFor(const Slab& slab) const;
  void keepIn(const Slab& slab);

  // Rounds of relaxation: FastRounds.cpp.
  void relaxInRounds();
  void relaxOnce(int sweeps, bool isLast, const Section& section);
  Balance balanceOf(bool isLast) const;

  // Finished particles: FastFinish.cpp.
  void finish();
  enum class ComponentHome
  {
    Here,
    Elsewhere,
    Unknown
  };
  ComponentHome homeOf(const SparseComponent& component) const;
  void fillSparseComponents();
  void dropOthers();

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
  /// Boxes of the rough proxy that guessed the spacing of a given number, if they may be as fine as this wants them.
  std::vector<SurfaceBox> RoughBoxes;
  /// Of the surface that is isolated, so far.
  std::atomic<std::int64_t> BoxCount{ 0 };
  std::unique_ptr<SurfaceProxy> Proxy;
  FaceJumps Jumps;
  BoundaryCurves Curves;
  /// Patches of the particles on these curves.
  Buffer<Patch> BoundaryPatches;
  /// The number of particles for which they count.
  double BoundaryCount = 0.0;
  /// Whether particles on creases, where they are asked for, are not more than a given number.
  bool CreasesFit = true;
  std::unique_ptr<MovingParticles> Moving;
  /// In a slab, and in the strip at its end, the number of particles that are to move.
  double TargetInSlab = 0.0;
  double TargetInStrip = 0.0;
  /// In a slab, marks the particles that move whose worker this is. The others are at home in other slabs.
  std::vector<char> IsOwn;
  /// Places around which the particles to start from are relaxed, if not everywhere.
  Buffer<Patch> Changed;
  /// Whether particles of the previous run go on.
  bool IsWarm = false;
  std::atomic<std::int64_t> Evaluations{ 0 };
  Distribution Result;
};

} // namespace hop
