#include "Fast/FastSystem.h"

#include "Fast/PatchDistances.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

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

} // namespace

/// First positions of particles: those of the previous run if enough of them arrive, with seeds between them, else
/// seeds alone.
void FastSystem::makeSeeds(std::int64_t count)
{
  this->startMoving();
  if (!this->Parameters.changedAround.empty())
  {
    this->changeStart(count);
    return;
  }
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
  this->placeOnPolygon();
  this->dropNearBoundaryCurves(OnBoundary::SeedDistance);
  this->coverBoxes(this->Part.widened(this->overlap(SlabOverlap::Reach - SlabOverlap::Guard)));
}

/// Starts with the particles on boundary curves alone.
void FastSystem::startMoving()
{
  this->Evaluations += this->Moving ? this->Moving->evaluations() : 0;
  this->Moving = std::make_unique<MovingParticles>(
    this->Surface, *this->Proxy, this->BoundaryPatches, this->Parallel);
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

/// Continues with the particles of a distribution that is to be changed around some places, and around those where it has
/// gaps at the spacings of now.
void FastSystem::changeStart(std::int64_t count)
{
  this->continueFrom(this->Parameters.start);
  const std::vector<char> all(this->Moving->count(), 1);
  this->Moving->keep(thinOut(this->Moving->patches(), all, MinimumSeparation, this->Parallel));
  this->dropNearBoundaryCurves(MinimumSeparation);
  const auto before = static_cast<std::ptrdiff_t>(this->Moving->count());
  this->addSeedsBetween(count);
  this->coverBoxes({});
  const auto begin = this->Moving->patches().begin();
  const auto after = static_cast<std::ptrdiff_t>(this->Moving->count());
  this->Changed = this->Parameters.changedAround;
  this->Changed.insert(this->Changed.end(), begin + before, begin + after);
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

/// Drops particles that are too near to one on a boundary curve: these are sampled first and stay.
void FastSystem::dropNearBoundaryCurves(double nearest)
{
  this->Moving->keep(areFarFrom(this->Moving->patches(), this->Moving->count(),
    this->BoundaryPatches, nearest, this->Parallel));
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

} // namespace hop
