#include "Fast/GivenNumber.h"

#include "Fast/PackingRepair.h"
#include "Fast/PatchDistances.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace hop
{
namespace
{

/// Exchange of crowded particles for others in gaps. All numbers were chosen by experiment.
struct Exchange
{
  /// Largest number of exchanges that are followed by relaxation; one more is not. More: fewer crowded pairs, more
  /// evaluations.
  static constexpr int Times = 1;
  /// What is relaxed. Larger: more evaluations, and where particles stand close as many new crowded pairs as there were.
  static constexpr RepairRegion Region{ 1.5 };
  /// Least distance between particles that are added or removed at once, in units of the spacing, as long as there are
  /// enough such places. Smaller: two may go into the same gap; larger: worse places are used.
  static constexpr double Distance = 2.0;
  /// Distance up to which the nearest neighbour of a particle or a seed is looked for, in units of the spacing: gaps that
  /// are wider count as equally wide. Larger: more time; smaller: worse places are used.
  static constexpr double Clearance = 1.0;
  /// Number of seeds of which the ones with most room are added: so many in all, and so many more for each particle
  /// that is missing, but no more than there are to be particles. More of them find the middles of gaps more exactly,
  /// and take longer.
  static constexpr std::int64_t LeastSeeds = 1024;
  static constexpr std::int64_t SeedsPerMissing = 64;
};

/// Indices of values, sorted; equal values keep their order.
template <class Before>
std::vector<int> indicesBy(const std::vector<double>& values, const Before& before)
{
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return before(values[a], values[b]); });
  return order;
}

class NumberMatcher
{
public:
  NumberMatcher(const DistributionParameters& parameters, const Buffer<Patch>& boundaryPatches,
    MovingParticles& moving, const ParallelFor& parallelFor)
    : Parameters(parameters)
    , BoundaryPatches(boundaryPatches)
    , Moving(moving)
    , Parallel(parallelFor)
  {
  }

  void run();

private:
  // Each returns the patches of the particles that it added or removed.
  Buffer<Patch> keep(const std::vector<char>& kept);
  Buffer<Patch> removeTooNear();
  Buffer<Patch> removeCrowded(std::int64_t count);
  Buffer<Patch> addInGaps(std::int64_t count);
  Buffer<Patch> matchNumber();

  const DistributionParameters& Parameters;
  const Buffer<Patch>& BoundaryPatches;
  MovingParticles& Moving;
  const ParallelFor& Parallel;
};

Buffer<Patch> NumberMatcher::keep(const std::vector<char>& kept)
{
  Buffer<Patch> removed = marked(this->Moving.patches(), opposite(kept));
  this->Moving.keep(kept);
  return removed;
}

/// Removes particles too near to boundary curves or to each other.
Buffer<Patch> NumberMatcher::removeTooNear()
{
  const Buffer<Patch>& patches = this->Moving.patches();
  const std::vector<char> kept = areFarFrom(
    patches, this->Moving.count(), this->BoundaryPatches, MinimumSeparation, this->Parallel);
  return this->keep(thinOut(patches, kept, MinimumSeparation, this->Parallel));
}

/// Removes the most crowded particles.
Buffer<Patch> NumberMatcher::removeCrowded(std::int64_t count)
{
  const Buffer<Patch>& patches = this->Moving.patches();
  const std::vector<int> order = indicesBy(
    clearances(patches, this->Moving.count(), patches, Exchange::Clearance, this->Parallel),
    std::less<>());
  std::vector<char> kept(this->Moving.count(), 1);
  for (const int i : selectSeparated(patches, order, count, Exchange::Distance, this->Parallel))
  {
    kept[i] = 0;
  }
  return this->keep(kept);
}

/// Adds particles where there is most room.
Buffer<Patch> NumberMatcher::addInGaps(std::int64_t count)
{
  MovingParticles seeds(this->Moving.surface(), this->Moving.proxy(), {}, this->Parallel);
  seeds.draw(Exchange::LeastSeeds +
      std::min(this->Parameters.particleCount, Exchange::SeedsPerMissing * count),
    this->Parameters.seed);
  const std::vector<double> room = clearances(
    seeds.patches(), seeds.count(), this->Moving.patches(), Exchange::Clearance, this->Parallel);
  const std::vector<int> order = indicesBy(room, std::greater<>());
  std::vector<char> chosen(seeds.count(), 0);
  for (const int s :
    selectSeparated(seeds.patches(), order, count, Exchange::Distance, this->Parallel))
  {
    chosen[s] = 1;
  }
  seeds.keep(chosen);
  seeds.approach();
  this->Moving.append(seeds);
  return seeds.patches();
}

/// Adds or removes particles until there are as many as there should be, if possible.
Buffer<Patch> NumberMatcher::matchNumber()
{
  const std::int64_t missing =
    this->Parameters.particleCount - static_cast<std::int64_t>(this->Moving.size());
  if (missing == 0)
  {
    return {};
  }
  return missing > 0 ? this->addInGaps(missing) : this->removeCrowded(-missing);
}

void NumberMatcher::run()
{
  for (int n = 0;; ++n)
  {
    Buffer<Patch> changed = this->removeTooNear();
    const Buffer<Patch> exchanged = this->matchNumber();
    changed.insert(changed.end(), exchanged.begin(), exchanged.end());
    if (changed.empty() || n == Exchange::Times)
    {
      return;
    }
    relaxAround(changed, Balance::None, this->Moving, this->Parallel, Exchange::Region);
  }
}

} // namespace

void matchGivenNumber(const DistributionParameters& parameters,
  const Buffer<Patch>& boundaryPatches, MovingParticles& moving, const ParallelFor& parallelFor)
{
  NumberMatcher(parameters, boundaryPatches, moving, parallelFor).run();
}

} // namespace hop
