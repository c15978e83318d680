#include "Fast/FastDistribution.h"

#include "Edges/BoundaryCurves.h"
#include "Edges/ClipPlanes.h"
#include "Edges/CreaseSpacings.h"
#include "Edges/SmallComponents.h"
#include "Fast/FinishParticles.h"
#include "Fast/GivenNumber.h"
#include "Fast/MovingParticles.h"
#include "Fast/PackingRepair.h"
#include "Fast/PatchDistances.h"
#include "Isolation/SurfaceProxy.h"
#include "Isolation/UndecidedBoxes.h"
#include "Support/Interruptible.h"
#include "Support/KeepMarked.h"
#include "Surface/SpacingSearch.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <utility>

namespace hop
{
namespace
{

/// Largest boxes of the proxy, in units of the spacing wanted: some five particles each. Tetrahedra fill
/// less of their bounds.
constexpr double hexahedronPerSpacing = 6.0;
constexpr double wedgePerSpacing = 7.0;
constexpr double tetrahedronPerSpacing = 7.5;
constexpr double weaklyPerSpacing = 3.0;
/// Spacing of the first look, in units of the mesh's diagonal. Where more is asked for, the number of
/// particles cannot get out of hand.
constexpr double coarseSpacingPerExtent = 0.001;
/// Particles on boundary curves stand for half as much area as others, and count as so much of one.
constexpr double onBoundary = 0.5;
/// Seeds nearer to a boundary curve's particle than this, in units of their spacing, are dropped: half the
/// distance of two rows of hexagonal packing.
constexpr double seedToBoundary = 0.433;
/// Particles of a run before come from no farther off than the first, and have arrived if they are nearer to
/// the surface than the second, in units of their spacing.
constexpr float farthestStart = 2.0f;
constexpr float arrivedOffset = 0.1f;
/// They go on if they are no less than that share of those wanted, and seeds farther than that from all of them
/// join them, in units of the spacing.
constexpr double worthContinuing = 0.7;
constexpr double uncovered = 0.75;
/// Shares of the run that are over with seeding and relaxation.
constexpr double seededFraction = 0.45;
constexpr double relaxedFraction = 0.9;

std::vector<int> sweepsOfRounds(Quality quality, bool isWarm)
{
  switch (quality)
  {
    case Quality::Draft:
      return { 8 };
    case Quality::High:
      return { 5, 8, 8, 10 };
    default:
      // Where particles of a run before crowd or thin out there is more to do.
      return isWarm ? std::vector<int>{ 12, 22 } : std::vector<int>{ 7, 13 };
  }
}

/// A part of the run, as far as progress is concerned.
struct Section
{
  double begin = 0.0, end = 0.0;

  double at(double share) const { return this->begin + share * (this->end - this->begin); }
};

class FastSystem
{
public:
  FastSystem(const Isosurface& surface, const DistributionParameters& parameters,
    const Monitor& monitor, const ParallelFor& parallelFor)
    : Surface(surface)
    , Mesh(*surface.mesh)
    , Parameters(parameters)
    , Sizing(parameters.sizing)
    , Work(monitor, parallelFor)
    , Parallel(std::ref(this->Work))
    , Locator(this->Mesh, surface.isovalue, this->Parallel)
  {
    this->Surface.locator = &this->Locator;
  }

  Distribution run();
  std::vector<double> wantedInElements();

private:
  void make();
  /// Reports how far the work is; may throw Interrupted.
  void reach(double fraction)
  {
    this->Work.raiseFraction(fraction);
    this->Work.ask();
  }
  bool isSmall(const SurfaceBox& box, const SizingFunction& sizing);
  SurfaceProxy proxyOfBoxesAt(double spacing, double shareOfRun);
  bool tooMany(double count);
  bool estimateCount();
  void lookAtSurface();
  double wantedCount() const;
  void matchCount(std::int64_t count);
  void makeBoundaries();
  void dropNearBoundaries(double nearest);
  void startMoving();
  void addSamples(const std::vector<int>& boxes);
  void makeSeeds(std::int64_t count);
  void continueFrom(const std::vector<Location>& places);
  bool countIsGiven() const { return this->Parameters.particleCount > 0; }
  void coverBoxes();
  void relaxAll(int sweeps, bool isLast, const Section& section);
  void finish();

  Isosurface Surface;
  const ElementMesh& Mesh;
  DistributionParameters Parameters;
  SizingFunction Sizing;
  Interruptible Work;
  ParallelFor Parallel;
  FaceLocator Locator;
  std::unique_ptr<SurfaceProxy> Proxy;
  FaceJumps Jumps;
  BoundaryCurves Boundaries;
  Buffer<Patch> BoundaryPatches;
  std::unique_ptr<MovingParticles> Moving;
  /// Particles of the run before go on.
  bool IsWarm = false;
  std::atomic<std::int64_t> Evaluations{ 0 };
  Distribution Result;
};

/// Whether a box is small enough to be looked at in one place. Where the field stands still nearby that says
/// less; what is thinner than spacings gets boxes no larger than one, each with a particle of its own.
bool FastSystem::isSmall(const SurfaceBox& box, const SizingFunction& sizing)
{
  const int element = box.middle.element;
  const Domain domain = this->Mesh.elements[element].domain;
  const double perSpacing = domain == Domain::Hexahedron ? hexahedronPerSpacing
    : domain == Domain::Wedge                            ? wedgePerSpacing
                                                         : tetrahedronPerSpacing;
  const double largest = perSpacing * sizing.spacing;
  const double smallest =
    (box.mayBeThin ? sizing.spacing : largest) / (1.0 + sizing.angularDensity);
  if (box.size > largest || box.size <= smallest ||
    (sizing.angularDensity == 0.0 && !box.mayBeThin))
  {
    return box.size <= largest;
  }
  ++this->Evaluations;
  Anchor anchor;
  Patch patch;
  const Location place{ element, proxyMiddle(domain, box) };
  const Jet jet = evaluateHessian(this->Mesh.form(element), place.u);
  if (!anchorPatch(place, jet, this->Surface.isovalue, anchor, patch))
  {
    return true;
  }
  const double spacing = sizing.at(patch.curvatureMagnitude());
  const bool isThin = patch.curvatureMagnitude() * spacing > 1.0 ||
    (box.weakly && std::abs(anchor.offset) > MovingParticles::SeedOffset * spacing);
  const double perOwnSpacing = isThin ? 1.0 : box.weakly ? weaklyPerSpacing : perSpacing;
  return box.size <= perOwnSpacing * spacing;
}

/// \param spacing that boxes are to suit; the proxy's own is the sizing function's
/// \param shareOfRun how far the run is when the surface is found
SurfaceProxy FastSystem::proxyOfBoxesAt(double spacing, double shareOfRun)
{
  const SizingFunction sizing{ spacing, this->Sizing.angularDensity };
  const auto isSmall = [&](const SurfaceBox& box) { return this->isSmall(box, sizing); };
  const auto found = [&](double share) { this->Work.raiseFraction(shareOfRun * share); };
  SurfaceProxy proxy(this->Surface, this->Sizing,
    findSurfaceBoxes(this->Mesh, this->Surface.isovalue, isSmall, this->Parallel, found),
    this->Parallel);
  this->Evaluations += proxy.evaluations();
  return proxy;
}

bool FastSystem::tooMany(double count)
{
  this->Result.report.error = this->Parameters.refusal(count);
  return !this->Result.report.error.empty();
}

/// From a coarse look at the surface, before memory is asked for: particles are counted at the spacing wanted.
/// Counted at the coarse one, as many more as it is larger, those that stand closer where the surface bends
/// would count twice.
/// \return whether there are few enough
bool FastSystem::estimateCount()
{
  if (this->Parameters.particleCount > 0)
  {
    return !this->tooMany(static_cast<double>(this->Parameters.particleCount));
  }
  const double coarse = meshExtent(this->Mesh) * coarseSpacingPerExtent;
  return coarse <= this->Sizing.spacing ||
    !this->tooMany(this->proxyOfBoxesAt(coarse, 0.05).particleCount());
}

/// Makes the proxy. From then on the surface ends where its two sides miss each other, particles are to
/// stand closer where it turns, and those on boundary curves are there.
void FastSystem::lookAtSurface()
{
  this->Surface.jumpTolerances = nullptr;
  this->Proxy = std::make_unique<SurfaceProxy>(this->proxyOfBoxesAt(this->Sizing.spacing, 0.3));
  this->Work.ask();
  this->Jumps = findFaceJumps(this->Surface, *this->Proxy, this->Parallel);
  std::int64_t cost = this->Jumps.evaluations;
  this->Proxy->limitSpacings(
    findCreaseSpacings(this->Surface, *this->Proxy, this->Jumps, this->Parallel, cost),
    this->Parallel);
  this->Surface.jumpTolerances = &this->Jumps.jumpTolerances;
  this->Work.ask();
  this->makeBoundaries();
  this->Evaluations += cost + this->Boundaries.evaluations;
}

/// How many particles the surface wants.
double FastSystem::wantedCount() const
{
  return this->Proxy->particleCount() +
    onBoundary * static_cast<double>(this->BoundaryPatches.size());
}

/// Finds the spacing that goes with a given number of particles.
void FastSystem::matchCount(std::int64_t count)
{
  const double firstSpacing = this->Parameters.firstSpacing > 0.0
    ? this->Parameters.firstSpacing
    : meshExtent(this->Mesh) * SpacingSearch::FirstSpacingPerDiagonal;
  findSpacing(count, firstSpacing,
    [this](double spacing)
    {
      this->Sizing.spacing = spacing;
      this->lookAtSurface();
      return this->wantedCount();
    });
  // Corners of boundary curves are there at any spacing.
  const std::size_t boundaries = this->BoundaryPatches.size();
  const std::size_t most = std::min(boundaries, static_cast<std::size_t>(count));
  std::vector<char> kept(boundaries, 0);
  for (std::size_t n = 0; n < most; ++n)
  {
    kept[n * boundaries / most] = 1;
  }
  keepMarked(this->Boundaries.particles, kept);
  keepMarked(this->BoundaryPatches, kept);
}

void FastSystem::addSamples(const std::vector<int>& boxes)
{
  Buffer<Anchor> anchors;
  Buffer<Patch> patches;
  for (const int b : boxes)
  {
    anchors.push_back(this->Proxy->samples()[b].anchor);
    patches.push_back(this->Proxy->samples()[b].patch);
  }
  this->Moving->add(anchors, patches);
}

/// First places: those to start from, if they are near enough to as many as are wanted, and of that many seeds those
/// that they leave alone.
void FastSystem::makeSeeds(std::int64_t count)
{
  this->startMoving();
  if (!this->Parameters.start.empty())
  {
    this->continueFrom(this->Parameters.start);
    const std::vector<char> all(this->Moving->count(), 1);
    this->Moving->keep(thinOut(this->Moving->patches(), all, Squeezed, this->Parallel));
    this->IsWarm =
      static_cast<double>(this->Moving->size()) >= worthContinuing * static_cast<double>(count);
  }
  if (this->IsWarm)
  {
    MovingParticles seeds(this->Surface, *this->Proxy, {}, this->Parallel);
    seeds.draw(count, this->Parameters.seed);
    seeds.keep(areFarFrom(
      seeds.patches(), seeds.count(), this->Moving->patches(), uncovered, this->Parallel));
    seeds.approach();
    this->Moving->join(seeds);
  }
  else
  {
    this->startMoving();
    this->Moving->draw(count, this->Parameters.seed);
    this->Moving->approach();
  }
  this->dropNearBoundaries(seedToBoundary);
  this->coverBoxes();
}

/// Takes particles from places near the surface to it; those that come from far off or do not arrive are
/// dropped.
void FastSystem::continueFrom(const std::vector<Location>& places)
{
  const auto keepThoseWithin = [this](float farthest)
  {
    std::vector<char> kept(this->Moving->count());
    std::transform(this->Moving->anchors().begin(), this->Moving->anchors().end(),
      this->Moving->patches().begin(), kept.begin(),
      [farthest](const Anchor& anchor, const Patch& patch)
      { return std::abs(anchor.offset) <= farthest * patch.spacing; });
    this->Moving->keep(kept);
  };
  this->Moving->add(places);
  keepThoseWithin(farthestStart);
  this->Moving->approach(arrivedOffset);
  keepThoseWithin(arrivedOffset);
}

/// No particles yet but those on boundary curves.
void FastSystem::startMoving()
{
  this->Evaluations += this->Moving ? this->Moving->evaluations() : 0;
  this->Moving = std::make_unique<MovingParticles>(
    this->Surface, *this->Proxy, this->BoundaryPatches, this->Parallel);
}

void FastSystem::makeBoundaries()
{
  this->Boundaries =
    findBoundaryCurves(this->Surface, this->Jumps, *this->Proxy, this->Sizing, this->Parallel);
  this->BoundaryPatches.clear();
  for (const BoundaryParticle& boundary : this->Boundaries.particles)
  {
    this->BoundaryPatches.push_back(boundary.patch);
  }
}

/// Particles on boundary curves are there first: others too near to one are dropped.
void FastSystem::dropNearBoundaries(double nearest)
{
  this->Moving->keep(areFarFrom(this->Moving->patches(), this->Moving->count(),
    this->BoundaryPatches, nearest, this->Parallel));
}

/// One round. Before the last one so many are added or removed everywhere that their number is as wanted; the last
/// one mends single defects.
void FastSystem::relaxAll(int sweeps, bool isLast, const Section& section)
{
  Balance balance;
  balance.extent = isLast ? Balance::Defects : Balance::Everywhere;
  const auto size = static_cast<double>(this->Moving->size());
  // Where spacings vary, energies know of narrow places that the proxy overlooks; but they would leave the
  // particles of a run before as many as they are.
  if (this->countIsGiven())
  {
    balance.missing = static_cast<double>(this->Parameters.particleCount) - size;
  }
  else if (this->Sizing.angularDensity == 0.0 || this->IsWarm)
  {
    balance.missing = this->wantedCount() - size;
  }
  this->Moving->relax(
    { sweeps }, balance, [&](double share) { this->Work.raiseFraction(section.at(share)); });
  this->dropNearBoundaries(Squeezed);
}

/// Boxes on whose piece of surface no particle stands get one. Those added cover others in turn.
void FastSystem::coverBoxes()
{
  const auto& samples = this->Proxy->samples();
  const std::vector<char> lonely = findLonely(samples, this->Moving->patches(), this->Parallel);
  this->addSamples(chooseUncovered(samples, lonely, this->Parallel));
}

/// Takes all particles to the tolerance and says what there is to say about them.
void FastSystem::finish()
{
  FinishedParticles finished =
    finishParticles(*this->Moving, this->Jumps, this->Sizing, this->Parallel);
  this->Evaluations += finished.evaluations;
  DistributionReport& report = this->Result.report;
  std::vector<char>& kept = finished.settled;
  report.particlesRejected += std::count(kept.begin(), kept.end(), 0);
  if (!this->countIsGiven())
  {
    kept = thinOut(this->Moving->patches(), kept, Squeezed, this->Parallel);
  }
  Buffer<Particle>& particles = this->Result.particles;
  particles = std::move(finished.particles);
  particles.resize(closeGaps(particles, particles.size(), kept));
  const ParticleGrid all(particles, this->Boundaries.particles, this->Parallel);
  markClipPlanes(this->Surface, all, this->Parallel);
  for (const BoundaryParticle& boundary : this->Boundaries.particles)
  {
    particles.push_back(boundary.particle);
  }
  report.particlesUndersampled = std::count_if(
    particles.begin(), particles.end(), [](const Particle& p) { return p.isUndersampled(); });
  fitSmallComponents(*this->Proxy, all, particles, this->Parallel);
}

/// The road of the data, as long as nobody interrupts.
void FastSystem::make()
{
  if (!this->estimateCount())
  {
    return;
  }
  if (this->countIsGiven())
  {
    this->matchCount(this->Parameters.particleCount);
  }
  else
  {
    this->lookAtSurface();
  }
  reportUndecided(this->Surface, this->Proxy->boxes(), this->Result.report);
  this->reach(0.35);
  const double wanted = this->Proxy->particleCount();
  if (wanted > 0.0 && !this->tooMany(wanted))
  {
    this->makeSeeds(std::llround(wanted));
    const std::vector<int> rounds = sweepsOfRounds(this->Parameters.quality, this->IsWarm);
    const Section all{ seededFraction, relaxedFraction };
    this->reach(all.begin);
    for (std::size_t n = 0; n < rounds.size(); ++n)
    {
      const auto count = static_cast<double>(rounds.size());
      const Section round{ all.at(n / count), all.at((n + 1) / count) };
      this->relaxAll(rounds[n], n + 1 == rounds.size(), round);
      this->reach(round.end);
    }
    repairPacking(*this->Moving, this->Parallel);
    // Beside another sheet the last particle of a small component may have been taken for one too many.
    this->coverBoxes();
    if (this->countIsGiven())
    {
      settleNumber(this->Parameters, this->BoundaryPatches, *this->Moving, this->Parallel);
    }
    this->finish();
  }
}

std::vector<double> FastSystem::wantedInElements()
{
  std::vector<double> wanted(this->Mesh.elements.size(), 0.0);
  if (wanted.empty())
  {
    return wanted;
  }
  this->lookAtSurface();
  for (std::size_t e = 0; e < wanted.size(); ++e)
  {
    wanted[e] = this->Proxy->particleCount(static_cast<int>(e));
  }
  for (const BoundaryParticle& boundary : this->Boundaries.particles)
  {
    wanted[boundary.particle.location.element] += onBoundary;
  }
  return wanted;
}

Distribution FastSystem::run()
{
  if (this->Mesh.elements.empty())
  {
    return {};
  }
  this->make();
  DistributionReport& report = this->Result.report;
  report.evaluations = this->Evaluations + this->Locator.evaluations();
  if (this->Moving)
  {
    report.evaluations += this->Moving->evaluations();
    report.iterations = this->Moving->sweeps();
  }
  return std::move(this->Result);
}

} // namespace

Distribution distributeFast(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  return unlessInterrupted(
    [&]() { return FastSystem(surface, parameters, monitor, parallelFor).run(); });
}

std::vector<double> wantedParticles(const Isosurface& surface, const SizingFunction& sizing,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  DistributionParameters parameters;
  parameters.sizing = sizing;
  return FastSystem(surface, parameters, monitor, parallelFor).wantedInElements();
}

} // namespace hop
