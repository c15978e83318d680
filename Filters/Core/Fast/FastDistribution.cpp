#include "Fast/FastDistribution.h"

#include "Edges/ClipPlanes.h"
#include "Edges/CreaseSpacings.h"
#include "Edges/CurveSegments.h"
#include "Edges/SmallComponents.h"
#include "Fast/FastSystem.h"
#include "Fast/FinishParticles.h"
#include "Fast/GivenNumber.h"
#include "Fast/PackingRepair.h"
#include "Fast/PatchDistances.h"
#include "Fast/SlabDistribution.h"
#include "Isolation/UndecidedBoxes.h"
#include "Support/KeepMarked.h"
#include "Surface/SpacingSearch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hop
{
namespace
{

/// Largest diagonals of the boxes in which the surface is sampled, in units of the spacing there: a box then holds some
/// five particles. Chosen by experiment. Smaller boxes cost more evaluations; in larger ones a single sample tells the
/// area and the spacing less exactly, and with them the number of particles.
struct BoxDiagonal
{
  static constexpr double Hexahedron = 6.0;
  /// More than in a hexahedron, as wedges and tetrahedra fill less of their bounds.
  static constexpr double Wedge = 7.0;
  static constexpr double Tetrahedron = 7.5;
  /// For drafts, in all elements. Larger: holes.
  static constexpr double Draft = 9.0;
  /// Where the gradient of the field vanishes nearby (SurfaceBox::risesWeakly), so that one sample tells less.
  static constexpr double Weak = 3.0;
  /// Where the surface is thinner than a spacing: each box gets a particle of its own.
  static constexpr double Thin = 1.0;
  /// Curvature magnitude times spacing from which on the surface counts as thin: its radius is a spacing.
  static constexpr double ThinBend = 1.0;

  static double of(Domain domain)
  {
    switch (domain)
    {
      case Domain::Hexahedron:
        return Hexahedron;
      case Domain::Wedge:
        return Wedge;
      case Domain::Tetrahedron:
        return Tetrahedron;
    }
    unknownDomain();
  }
};

/// Spacing at which particles are counted before memory is allocated, in units of the mesh's diagonal. A flat surface
/// across the mesh takes some 400,000 particles at it, so that no estimate is needed where the spacing asked for is
/// larger. Chosen by experiment. Larger: a cheaper estimate that tells curvature less exactly; smaller: the estimate
/// itself takes time and memory.
constexpr double estimateSpacingPerExtent = 0.001;

/// Least distance between particles of drafts, in units of their spacing; see MinimumSeparation. Pairs are many in one
/// round without a repair. Chosen by experiment. Larger: holes where particles were dropped; smaller: pairs that crowd.
constexpr double draftSeparation = 0.4;

/// Relative error of a given number up to which all spacings are scaled instead of isolating the surface anew: the boxes
/// are those of a spacing that is off by half of the error, and the angular density is off by as much. Chosen by
/// experiment. Larger: it is farther off; smaller: the surface is isolated more often.
constexpr double nearlyTheNumber = 0.3;

/// The proxy that guesses the spacing which goes with a given number, before the surface is isolated for it. Chosen by
/// experiment; they change what the guess costs, and how near it comes.
struct RoughProxy
{
  /// Area that the surface is taken to have before anything is known of it, in units of the squared diagonal of the
  /// mesh: a plane across it has about half of that.
  static constexpr double Area = 0.4;
  /// Width of its boxes in units of the usual one. Smaller: areas are more exact, and take more time.
  static constexpr double Width = 2.5;
  /// Least spacing, as a share of the diagonals of all boxes in a row over the number of particles: surfaces of no area,
  /// in flat cells, have boundary curves all the same. Chosen so that it does not matter elsewhere: a surface through n
  /// boxes of the size w with N > n particles has spacings of about w sqrt(n/N), above w n/N.
  static constexpr double LengthShare = 0.1;
};

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

/// How the particles of a previous run are continued. Lengths are in units of the spacing; all were chosen by
/// experiment.
struct WarmStart
{
  /// Largest distance from the surface at which a particle is still taken there. Larger: particles come from other
  /// sheets; smaller: fewer survive a step of the isovalue.
  static constexpr float FarthestStart = 2.0f;
  /// A particle has arrived if it is nearer to the surface than this after a Newton step; others are dropped.
  static constexpr float Arrived = 0.1f;
  /// Share of the target count that has to arrive; with fewer the run starts from seeds alone. Larger: more runs start
  /// anew, smaller: more of the surface is left to the seeds between the particles that arrived.
  static constexpr double LeastShare = 0.7;
  /// Seeds farther than this from all that arrived are added. Larger: holes remain for the rounds to fill; smaller:
  /// pairs that the rounds have to thin out.
  static constexpr double SeedDistance = 0.75;
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

/// Number of sweeps in each round of relaxation. More of them make a more even spread and take longer; each round
/// costs one evaluation a particle. Chosen by experiment; TestFastQuality.cpp says how even Standard has to be.
std::vector<int> sweepsOfRounds(Quality quality, bool isWarm)
{
  switch (quality)
  {
    case Quality::Draft:
      return { 8 };
    case Quality::High:
      return { 5, 8, 8, 10 };
    case Quality::Standard:
      break;
  }
  // Particles of the previous run crowd or thin out where the surface has moved: the same quality takes more sweeps.
  return isWarm ? std::vector<int>{ 12, 22 } : std::vector<int>{ 7, 13 };
}

/// Marks the particles on curves that the relaxation sees: of those in one place one a sheet, as several would repel
/// others several times.
std::vector<char> onePerSheet(const BoundaryCurves& curves)
{
  std::vector<char> seen(curves.particles.size(), 1);
  std::map<int, std::vector<int>> inPlace;
  for (const auto& [first, other] : curves.edges.coincident)
  {
    std::vector<int>& chosen = inPlace.emplace(first, std::vector<int>{ first }).first->second;
    const WorldVector& normal = curves.particles[other].particle.normal;
    seen[other] = std::none_of(chosen.begin(), chosen.end(),
      [&](int one) { return dot(curves.particles[one].particle.normal, normal) > SheetCosine; });
    if (seen[other])
    {
      chosen.push_back(other);
    }
  }
  return seen;
}

} // namespace

/// Whether one sample tells enough about the surface in a box. It tells less where the gradient of the field vanishes
/// nearby; where the surface is thinner than a spacing every box gets a particle of its own.
bool FastSystem::isFineEnough(const SurfaceBox& box, const SizingFunction& sizing)
{
  const int element = box.middle.element;
  const Domain domain = this->Mesh.elements[element].domain;
  const double perSpacing =
    this->Parameters.quality == Quality::Draft ? BoxDiagonal::Draft : BoxDiagonal::of(domain);
  const double largest = perSpacing * sizing.spacing;
  const double smallest = (box.mayBeThin ? 1.0 : perSpacing) * sizing.smallest();
  if (this->isOutOfReach(box))
  {
    return true;
  }
  if (box.size > largest || box.size <= smallest ||
    (sizing.angularDensity == 0.0 && !box.mayBeThin))
  {
    return box.size <= largest;
  }
  ++this->Evaluations;
  Anchor anchor;
  Patch patch;
  const Location place{ element, proxyMiddle(domain, box) };
  const Jet jet = exactHessian(this->Mesh, place);
  if (!anchorPatch(place, jet, this->Surface.isovalue, anchor, patch))
  {
    return true;
  }
  const double spacing = sizing.at(patch.curvatureMagnitude());
  const bool isThin = patch.curvatureMagnitude() * spacing > BoxDiagonal::ThinBend ||
    (box.risesWeakly && std::abs(anchor.offset) > MovingParticles::SeedOffset * spacing);
  const double perOwnSpacing = isThin ? BoxDiagonal::Thin
    : box.risesWeakly                 ? BoxDiagonal::Weak
                                      : perSpacing;
  return box.size <= perOwnSpacing * spacing;
}

/// Whether a box is so far from the slab that no particles are wanted in it.
bool FastSystem::isOutOfReach(const SurfaceBox& box) const
{
  const int element = box.middle.element;
  return !this->ReachesOut.empty() && this->ReachesOut[element] &&
    !this->Part.widened(this->overlap(SlabOverlap::Reach) + box.size)
       .holds(glm::dvec3(evaluateGradient(this->Mesh.form(element), box.middle.u).value));
}

/// \param sizing decides how fine the boxes are; the proxy's spacings follow the sizing function that is asked for
/// \param shareOfRun fraction of the run that is over when the surface is found
SurfaceProxy FastSystem::proxyOfBoxesAt(const SizingFunction& sizing, double shareOfRun)
{
  const auto isFineEnough = [&](const SurfaceBox& box) { return this->isFineEnough(box, sizing); };
  const auto found = [&](double share) { this->Work.raiseFraction(shareOfRun * share); };
  SurfaceProxy proxy(this->Surface, this->Sizing,
    findSurfaceBoxes(this->Mesh, this->Surface.isovalue, isFineEnough, this->Parallel, found),
    this->Parallel);
  this->Evaluations += proxy.evaluations();
  return proxy;
}

bool FastSystem::tooMany(double count)
{
  this->Result.report.error = this->Parameters.refusal(count);
  return !this->Result.report.error.empty();
}

/// Particles along strips of the surface that are narrower than a spacing, as in cells like slivers: more than go by
/// their area. Only boxes many spacings wide count: a surface that is no strip takes more there by its area.
double FastSystem::countAlongStrips(const SurfaceProxy& proxy)
{
  constexpr double narrowest = 100.0; // box, in spacings
  double count = 0.0;
  for (std::size_t b = 0; b < proxy.boxes().size(); ++b)
  {
    const double spacings = proxy.boxes()[b].size / proxy.samples()[b].patch.spacing;
    count += proxy.samples()[b].found && spacings > narrowest ? spacings : 0.0;
  }
  return count;
}

/// Counts the particles on a coarse proxy, before memory is allocated. The proxy's boxes are coarse; its spacings
/// are the ones asked for, as a number that is scaled up from coarse spacings would count curvature twice.
/// \return whether there are few enough
bool FastSystem::estimateCount()
{
  if (this->Parameters.particleCount > 0)
  {
    return !this->tooMany(static_cast<double>(this->Parameters.particleCount));
  }
  const SizingFunction coarse{ meshExtent(this->Mesh) * estimateSpacingPerExtent,
    this->Sizing.angularDensity };
  if (coarse.smallest() <= this->Sizing.smallest())
  {
    return true;
  }
  const SurfaceProxy rough = this->proxyOfBoxesAt(coarse, ProgressAt::Estimated);
  return !this->tooMany(std::max(rough.particleCount(), countAlongStrips(rough)));
}

/// Makes the proxy, and traces the boundary curves. From then on the surface ends where the field jumps, and the
/// sizing function is lowered at creases, but not in drafts.
void FastSystem::prepareSurface()
{
  this->Surface.jumpTolerances = nullptr;
  this->Proxy =
    std::make_unique<SurfaceProxy>(this->proxyOfBoxesAt(this->Sizing, ProgressAt::Isolated));
  this->Work.ask();
  this->Jumps = findFaceJumps(this->Surface, *this->Proxy, this->Parallel);
  std::int64_t cost = this->Jumps.evaluations;
  if (this->Parameters.quality != Quality::Draft)
  {
    this->Proxy->limitSpacings(
      findCreaseSpacings(this->Surface, *this->Proxy, this->Jumps, this->Parallel, cost),
      this->Parallel);
  }
  this->Surface.jumpTolerances = &this->Jumps.jumpTolerances;
  this->Work.ask();
  this->traceBoundaryCurves();
  this->Evaluations += cost + this->Curves.evaluations;
}

/// Number of particles that the surface takes at the sizing function.
double FastSystem::targetCount() const
{
  return this->Proxy->particleCount() + this->BoundaryCount;
}

/// Finds the spacing that goes with a given number of particles: first on a rough proxy, then on the surface itself. What
/// is missing to the number then is settled by scaling all spacings.
void FastSystem::matchSpacing(std::int64_t count)
{
  const auto given = static_cast<double>(count);
  findSpacing(
    count, this->guessSpacing(given),
    [this](double spacing)
    {
      this->Sizing.spacing = spacing;
      this->prepareSurface();
      return this->targetCount();
    },
    nearlyTheNumber);
  const double inside = this->Proxy->particleCount();
  const double onBoundary = this->targetCount() - inside;
  const double error = this->targetCount() / given - 1.0;
  if (std::abs(error) > SpacingSearch::Tolerance && std::abs(error) < nearlyTheNumber)
  {
    // Spacings f times as large take inside/f^2 + onBoundary/f particles: the positive root of given f^2 - onBoundary f -
    // inside. It is near 1, as both numbers together are near the one that is given.
    const double factor =
      (onBoundary + std::sqrt(onBoundary * onBoundary + 4.0 * given * inside)) / (2.0 * given);
    this->Proxy->scaleSpacings(factor);
    this->Sizing.spacing *= factor;
    this->traceBoundaryCurves();
    this->Evaluations += this->Curves.evaluations;
  }
  if (this->placesOnCurves() > count)
  {
    this->CreasesFit = false;
    this->traceBoundaryCurves();
  }
  this->keepOnBoundary(static_cast<std::size_t>(count));
}

/// About the spacing that goes with a number of particles, by a proxy whose boxes are wide.
double FastSystem::guessSpacing(double count)
{
  this->Sizing.spacing = meshExtent(this->Mesh) * std::sqrt(RoughProxy::Area / count);
  SizingFunction wide = this->Sizing;
  wide.spacing *= RoughProxy::Width;
  const SurfaceProxy proxy = this->proxyOfBoxesAt(wide, ProgressAt::Estimated);
  double length = 0.0;
  for (const SurfaceBox& box : proxy.boxes())
  {
    length += box.size;
  }
  return std::max(proxy.spacingFor(count), RoughProxy::LengthShare * length / count);
}

/// Thins out the particles on boundary curves where they are more than a given number: their corners stay at any
/// spacing.
void FastSystem::keepOnBoundary(std::size_t most)
{
  const std::size_t count = this->BoundaryPatches.size();
  if (this->placesOnCurves() <= static_cast<std::int64_t>(most))
  {
    return;
  }
  const std::size_t left = std::min(count, most);
  std::vector<char> kept(count, 0);
  for (std::size_t n = 0; n < left; ++n)
  {
    kept[n * count / left] = 1;
  }
  keepMarked(this->Curves.particles, kept);
  keepMarked(this->BoundaryPatches, kept);
  this->BoundaryCount = OnBoundary::Count * static_cast<double>(left);
  if (left < count)
  {
    this->Curves.edges.segments = withoutDropped(this->Curves.edges.segments, kept);
  }
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

/// First positions of particles: those of the previous run if enough of them arrive, with seeds between them, else
/// seeds alone.
void FastSystem::makeSeeds(std::int64_t count)
{
  this->startMoving();
  if (!this->Parameters.start.empty())
  {
    this->continueFrom(this->Parameters.start);
    const std::vector<char> all(this->Moving->count(), 1);
    this->Moving->keep(thinOut(this->Moving->patches(), all, MinimumSeparation, this->Parallel));
    this->IsWarm = static_cast<double>(this->Moving->size()) >=
      WarmStart::LeastShare * static_cast<double>(count);
  }
  if (this->IsWarm)
  {
    this->addSeedsBetween(count);
  }
  else
  {
    this->startMoving();
    this->Moving->draw(count, this->Parameters.seed);
    this->keepIn(this->Part.widened(this->overlap(SlabOverlap::Reach)));
    this->Moving->approach();
    this->fixOuterSeeds();
  }
  this->dropNearBoundaryCurves(OnBoundary::SeedDistance);
  this->coverBoxes(this->Part.widened(this->overlap(SlabOverlap::Reach - SlabOverlap::Guard)));
}

/// In a slab, lets the outermost seeds stay where they are: beyond them is nothing into which the others may spread.
void FastSystem::fixOuterSeeds()
{
  const Slab inner = this->Part.widened(this->overlap(SlabOverlap::Reach - SlabOverlap::Guard));
  if (inner.isEverything())
  {
    return;
  }
  Buffer<Patch> fixed = this->BoundaryPatches;
  for (std::size_t i = 0; i < this->Moving->count(); ++i)
  {
    const Patch& patch = this->Moving->patches()[i];
    if (!inner.holds(patch.position))
    {
      fixed.push_back(patch);
      fixed.back().fixed = true;
    }
  }
  this->keepIn(inner);
  const double atEnd = this->overlap(SlabOverlap::Strip);
  this->TargetInSlab = this->seedsLeftFor(inner);
  this->TargetInStrip =
    this->seedsLeftFor({ this->Part.direction, this->Part.end - atEnd, this->Part.end + atEnd });
  this->Moving->replaceFixed(fixed);
}

/// Number of particles that are to move in a slab: the seeds there, without what counts for particles on boundary
/// curves.
double FastSystem::seedsLeftFor(const Slab& slab) const
{
  const auto isThere = [&](const Patch& patch) { return slab.holds(patch.position); };
  const auto begin = this->Moving->patches().begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(this->Moving->count());
  return static_cast<double>(std::count_if(begin, end, isThere)) -
    OnBoundary::Count *
    static_cast<double>(
      std::count_if(this->BoundaryPatches.begin(), this->BoundaryPatches.end(), isThere));
}

/// Drops the particles outside of a slab.
void FastSystem::keepIn(const Slab& slab)
{
  if (!slab.isEverything())
  {
    std::vector<char> kept(this->Moving->count());
    std::transform(this->Moving->anchors().begin(), this->Moving->anchors().end(),
      this->Moving->patches().begin(), kept.begin(),
      [&](const Anchor&, const Patch& patch) { return slab.holds(patch.position); });
    this->Moving->keep(kept);
  }
}

/// Of `count` seeds all over the surface, adds the ones that are far from all particles.
void FastSystem::addSeedsBetween(std::int64_t count)
{
  MovingParticles seeds(this->Surface, *this->Proxy, {}, this->Parallel);
  seeds.draw(count, this->Parameters.seed);
  seeds.keep(areFarFrom(seeds.patches(), seeds.count(), this->Moving->patches(),
    WarmStart::SeedDistance, this->Parallel));
  seeds.approach();
  this->Moving->append(seeds);
}

/// Takes particles from places near the surface to it. Particles that start too far from it, or do not
/// arrive, are dropped.
void FastSystem::continueFrom(const std::vector<Location>& places)
{
  const auto keepWithin = [this](float farthest)
  {
    std::vector<char> kept(this->Moving->count());
    std::transform(this->Moving->anchors().begin(), this->Moving->anchors().end(),
      this->Moving->patches().begin(), kept.begin(),
      [farthest](const Anchor& anchor, const Patch& patch)
      { return std::abs(anchor.offset) <= farthest * patch.spacing; });
    this->Moving->keep(kept);
  };
  this->Moving->add(places);
  keepWithin(WarmStart::FarthestStart);
  this->Moving->approach(WarmStart::Arrived);
  keepWithin(WarmStart::Arrived);
}

/// Starts with the particles on boundary curves alone.
void FastSystem::startMoving()
{
  this->Evaluations += this->Moving ? this->Moving->evaluations() : 0;
  this->Moving = std::make_unique<MovingParticles>(
    this->Surface, *this->Proxy, this->BoundaryPatches, this->Parallel);
}

void FastSystem::traceBoundaryCurves()
{
  const Slab inReach = this->Part.widened(this->overlap(SlabOverlap::Reach));
  const bool withCreases = this->Parameters.onCreases && this->CreasesFit;
  this->Curves = findBoundaryCurves(this->Surface, this->Jumps, *this->Proxy, this->Sizing,
    withCreases ? SampledCurves::BoundaryAndCreases : SampledCurves::Boundary, this->Parallel,
    this->Part, inReach);
  this->keepCurvesIn(inReach);
  this->BoundaryPatches.clear();
  this->BoundaryCount = 0.0;
  const std::vector<char> seen = onePerSheet(this->Curves);
  for (std::size_t n = 0; n < seen.size(); ++n)
  {
    const BoundaryParticle& boundary = this->Curves.particles[n];
    if (seen[n])
    {
      this->BoundaryPatches.push_back(boundary.patch);
      this->BoundaryCount +=
        boundary.side.exists() || !boundary.isOnCrease ? OnBoundary::Count : 0.0;
    }
  }
}

/// Number of places with particles on boundary curves and creases. On creases several particles are in one.
std::int64_t FastSystem::placesOnCurves() const
{
  const std::vector<int> first = firstInPlace(this->Curves.edges, this->Curves.particles.size());
  std::int64_t places = 0;
  for (std::size_t n = 0; n < first.size(); ++n)
  {
    places += first[n] == static_cast<int>(n);
  }
  return places;
}

/// Number of particles that the relaxation sees when there are as many places as particles are asked for.
std::int64_t FastSystem::sizeForGivenNumber() const
{
  return this->Parameters.particleCount + static_cast<std::int64_t>(this->BoundaryPatches.size()) -
    this->placesOnCurves();
}

/// Drops what is on boundary curves outside of a slab.
void FastSystem::keepCurvesIn(const Slab& slab)
{
  if (slab.isEverything())
  {
    return;
  }
  const auto isOutside = [&](const BoundaryParticle& some)
  { return !slab.holds(some.patch.position); };
  for (Buffer<BoundaryParticle>* some : { &this->Curves.particles, &this->Curves.thinned })
  {
    some->erase(std::remove_if(some->begin(), some->end(), isOutside), some->end());
  }
  // Segments are for meshes, which are not made of slabs.
  this->Curves.edges = {};
}

/// Drops particles that are too near to one on a boundary curve: these are sampled first and stay.
void FastSystem::dropNearBoundaryCurves(double nearest)
{
  this->Moving->keep(areFarFrom(this->Moving->patches(), this->Moving->count(),
    this->BoundaryPatches, nearest, this->Parallel));
}

/// What a round does about the number of particles: the last round repairs single defects, the rounds before it
/// insert and delete everywhere.
Balance FastSystem::balanceOf(bool isLast) const
{
  Balance balance;
  balance.extent = isLast ? Balance::Defects : Balance::Everywhere;
  const auto size = static_cast<double>(this->Moving->size());
  if (this->countIsGiven())
  {
    balance.missing = static_cast<double>(this->sizeForGivenNumber()) - size;
  }
  // Where spacings vary, energies tell of narrow places that the proxy misses. They would leave the particles of a
  // previous run as many as they are, though.
  else if (this->Sizing.angularDensity == 0.0 || this->IsWarm)
  {
    balance.missing = this->Part.isEverything()
      ? this->targetCount() - size
      : this->TargetInSlab - static_cast<double>(this->Moving->count());
  }
  return balance;
}

void FastSystem::relaxOnce(int sweeps, bool isLast, const Section& section)
{
  this->Moving->relax({ sweeps }, this->balanceOf(isLast),
    [&](double share) { this->Work.raiseFraction(section.at(share)); });
  this->dropNearBoundaryCurves(MinimumSeparation);
}

void FastSystem::relaxInRounds()
{
  const std::vector<int> rounds = sweepsOfRounds(this->Parameters.quality, this->IsWarm);
  const Section all{ ProgressAt::Seeded, ProgressAt::Relaxed };
  this->reach(all.begin);
  for (std::size_t n = 0; n < rounds.size(); ++n)
  {
    const auto count = static_cast<double>(rounds.size());
    const Section round{ all.at(n / count), all.at((n + 1) / count) };
    this->relaxOnce(rounds[n], n + 1 == rounds.size(), round);
    this->reach(round.end);
  }
}

/// Adds a particle in boxes on whose piece of surface no particle stands. One may cover several boxes.
/// \param where of the boxes' samples
void FastSystem::coverBoxes(const Slab& where)
{
  const auto& samples = this->Proxy->samples();
  std::vector<char> uncovered = findUncovered(samples, this->Moving->patches(), this->Parallel);
  if (!where.isEverything())
  {
    forAll(this->Parallel, samples.size(),
      [&](std::size_t b)
      { uncovered[b] = uncovered[b] && where.holds(samples[b].patch.position); });
  }
  this->addSamples(chooseUncovered(samples, uncovered, this->Parallel));
}

/// Takes all particles to the tolerance, and evaluates there what belongs to a finished particle. In a slab the particles
/// of other slabs are there as neighbours, and are dropped at last.
void FastSystem::finish()
{
  FinishedParticles finished =
    finishParticles(*this->Moving, this->Jumps, this->Sizing, this->Parallel);
  this->Evaluations += finished.evaluations;
  DistributionReport& report = this->Result.report;
  std::vector<char>& kept = finished.converged;
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    report.particlesRejected += !kept[i] && (this->IsOwn.empty() || this->IsOwn[i]);
  }
  if (!this->countIsGiven())
  {
    const bool isDraft = this->Parameters.quality == Quality::Draft;
    kept = thinOut(
      this->Moving->patches(), kept, isDraft ? draftSeparation : MinimumSeparation, this->Parallel);
  }
  Buffer<Particle>& particles = this->Result.particles;
  particles = std::move(finished.particles);
  particles.resize(closeGaps(particles, particles.size(), kept));
  this->IsOwn.resize(closeGaps(this->IsOwn, this->IsOwn.size(), kept));
  const ParticleGrid all(particles, this->Curves.particles, this->Parallel);
  markClipPlanes(this->Surface, all, this->Curves.thinned, this->Parallel);
  const int first = static_cast<int>(particles.size());
  const auto addAll = [first](const std::vector<std::array<int, 2>>& pairs)
  {
    std::vector<std::array<int, 2>> result;
    result.reserve(pairs.size());
    for (const auto& [a, b] : pairs)
    {
      result.push_back({ first + a, first + b });
    }
    return result;
  };
  const SurfaceEdges& edges = this->Curves.edges;
  this->Result.edges = { addAll(edges.segments), addAll(edges.directed), addAll(edges.coincident) };
  for (const BoundaryParticle& boundary : this->Curves.particles)
  {
    particles.push_back(boundary.particle);
  }
  const FacePassages faces =
    countFacePassages(this->Mesh, *this->Proxy, this->Jumps, this->Parallel);
  report.facesReached = faces.reached;
  report.facesEnded = faces.ended;
  fitSmallComponents(*this->Proxy, all, particles, this->Parallel);
  this->dropOthers();
  report.particlesUndersampled = std::count_if(
    particles.begin(), particles.end(), [](const Particle& p) { return p.isUndersampled(); });
}

/// Drops finished particles that are at home in other slabs.
void FastSystem::dropOthers()
{
  if (this->Part.isEverything())
  {
    return;
  }
  Buffer<Particle>& particles = this->Result.particles;
  const Slab own = this->Part.shifted(this->overlap(SlabOverlap::OnPlane));
  std::vector<char> kept = this->IsOwn;
  for (std::size_t i = kept.size(); i < particles.size(); ++i)
  {
    kept.push_back(own.holds(particles[i].position.xyz));
  }
  keepMarked(particles, kept);
}

/// Boxes within the slab that isolation could not decide.
std::vector<SurfaceBox> FastSystem::undecidedBoxes()
{
  std::vector<SurfaceBox> undecided;
  for (std::size_t b = 0; b < this->Proxy->boxes().size(); ++b)
  {
    const SurfaceBox& box = this->Proxy->boxes()[b];
    const SurfaceProxy::Sample& sample = this->Proxy->samples()[b];
    const auto position = [&]()
    {
      return sample.found
        ? sample.patch.position
        : glm::dvec3(evaluateGradient(this->Mesh.form(box.middle.element), box.middle.u).value);
    };
    if (!box.certified && this->Part.holds(position()))
    {
      undecided.push_back(box);
    }
  }
  return undecided;
}

/// All stages but the last, one after the other.
/// \return whether there are particles
bool FastSystem::relax()
{
  if (!this->estimateCount())
  {
    return false;
  }
  if (this->countIsGiven())
  {
    this->matchSpacing(this->Parameters.particleCount);
  }
  else
  {
    this->prepareSurface();
  }
  reportUndecided(this->Surface,
    this->Part.isEverything() ? this->Proxy->boxes() : this->undecidedBoxes(), this->Result.report);
  this->Result.report.boxes = static_cast<std::int64_t>(this->Proxy->boxes().size());
  this->reach(ProgressAt::Prepared);
  const double count = this->Proxy->particleCount();
  if (count <= 0.0 || this->tooMany(count))
  {
    return false;
  }
  this->makeSeeds(std::llround(count));
  this->relaxInRounds();
  return true;
}

std::vector<double> FastSystem::countsOfElements()
{
  std::vector<double> counts(this->Mesh.elements.size(), 0.0);
  if (counts.empty())
  {
    return counts;
  }
  this->prepareSurface();
  for (std::size_t e = 0; e < counts.size(); ++e)
  {
    counts[e] = this->Proxy->particleCount(static_cast<int>(e));
  }
  for (const BoundaryParticle& boundary : this->Curves.particles)
  {
    counts[boundary.particle.location.element] += OnBoundary::Count;
  }
  return counts;
}

Distribution FastSystem::run()
{
  if (!this->Mesh.elements.empty() && this->relax())
  {
    if (this->Parameters.quality != Quality::Draft)
    {
      repairPacking(*this->Moving, this->Parallel);
    }
    // Beside another sheet the last particle of a small component may have been deleted as one too many.
    this->coverBoxes({});
    if (this->countIsGiven())
    {
      DistributionParameters parameters = this->Parameters;
      parameters.particleCount = this->sizeForGivenNumber();
      matchGivenNumber(parameters, this->BoundaryPatches, *this->Moving, this->Parallel);
    }
    this->finish();
  }
  return this->takeResult();
}

/// The particles, and what they cost.
Distribution FastSystem::takeResult()
{
  DistributionReport& report = this->Result.report;
  report.evaluations = this->Evaluations + this->Locator.evaluations();
  if (this->Moving)
  {
    report.evaluations += this->Moving->evaluations();
    report.iterations = this->Moving->sweeps();
  }
  return std::move(this->Result);
}

Distribution distributeFast(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  return unlessInterrupted(
    [&]() { return FastSystem(surface, parameters, monitor, parallelFor).run(); });
}

std::vector<double> particlesPerElement(const Isosurface& surface, const SizingFunction& sizing,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  DistributionParameters parameters;
  parameters.sizing = sizing;
  return FastSystem(surface, parameters, monitor, parallelFor).countsOfElements();
}

} // namespace hop
