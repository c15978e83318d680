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

/// So often at most particles are exchanged until they stand well; how far apart those are that are added or
/// removed at once, in units of the spacing.
constexpr int exchanges = 3;
constexpr double exchangedApart = 2.0;

/// Indices of values, the first in that order first; of equal ones, the first.
template <class Before>
std::vector<int> indicesBy(const std::vector<double>& values, const Before& before)
{
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return before(values[a], values[b]); });
  return order;
}

class NumberSettler
{
public:
  NumberSettler(const DistributionParameters& parameters, const Buffer<Patch>& boundaries,
    MovingParticles& moving, const ParallelFor& parallelFor)
    : Parameters(parameters)
    , Boundaries(boundaries)
    , Moving(moving)
    , Parallel(parallelFor)
  {
  }

  void settle();

private:
  // Each returns what stands or stood where something has changed.
  Buffer<Patch> keep(const std::vector<char>& kept);
  Buffer<Patch> removeSqueezed();
  Buffer<Patch> removeCrowded(std::int64_t count);
  Buffer<Patch> addInGaps(std::int64_t count);
  Buffer<Patch> matchNumber();

  const DistributionParameters& Parameters;
  const Buffer<Patch>& Boundaries;
  MovingParticles& Moving;
  const ParallelFor& Parallel;
};

Buffer<Patch> NumberSettler::keep(const std::vector<char>& kept)
{
  const Buffer<Patch> removed = marked(this->Moving.patches(), opposite(kept));
  this->Moving.keep(kept);
  return removed;
}

/// Removes particles that were squeezed against boundary curves or each other.
Buffer<Patch> NumberSettler::removeSqueezed()
{
  const Buffer<Patch>& patches = this->Moving.patches();
  const std::vector<char> kept =
    areFarFrom(patches, this->Moving.count(), this->Boundaries, Squeezed, this->Parallel);
  return this->keep(thinOut(patches, kept, Squeezed, this->Parallel));
}

/// Removes the most crowded particles.
Buffer<Patch> NumberSettler::removeCrowded(std::int64_t count)
{
  const Buffer<Patch>& patches = this->Moving.patches();
  const std::vector<int> order =
    indicesBy(clearances(patches, this->Moving.count(), patches, exchangedApart, this->Parallel),
      std::less<>());
  std::vector<char> kept(this->Moving.count(), 1);
  for (const int i : chooseApart(patches, order, count, exchangedApart, this->Parallel))
  {
    kept[i] = 0;
  }
  return this->keep(kept);
}

/// Adds particles where there is most room.
Buffer<Patch> NumberSettler::addInGaps(std::int64_t count)
{
  constexpr std::int64_t seedsPerParticle = 2;
  constexpr std::int64_t someSeeds = 64;
  MovingParticles seeds(this->Moving.surface(), this->Moving.proxy(), {}, this->Parallel);
  seeds.draw(someSeeds + seedsPerParticle * this->Parameters.particleCount, this->Parameters.seed);
  const std::vector<double> room = clearances(
    seeds.patches(), seeds.count(), this->Moving.patches(), exchangedApart, this->Parallel);
  const std::vector<int> order = indicesBy(room, std::greater<>());
  std::vector<char> wanted(seeds.count(), 0);
  for (const int s : chooseApart(seeds.patches(), order, count, exchangedApart, this->Parallel))
  {
    wanted[s] = 1;
  }
  seeds.keep(wanted);
  seeds.approach();
  this->Moving.join(seeds);
  return seeds.patches();
}

/// Adds or removes particles until there are as many as there should be, if possible.
Buffer<Patch> NumberSettler::matchNumber()
{
  const std::int64_t missing =
    this->Parameters.particleCount - static_cast<std::int64_t>(this->Moving.size());
  return missing > 0 ? this->addInGaps(missing) : this->removeCrowded(-missing);
}

void NumberSettler::settle()
{
  for (int n = 0;; ++n)
  {
    Buffer<Patch> changed = this->removeSqueezed();
    const Buffer<Patch> exchanged = this->matchNumber();
    changed.insert(changed.end(), exchanged.begin(), exchanged.end());
    if (changed.empty() || n == exchanges)
    {
      return;
    }
    relaxAround(changed, Balance::None, this->Moving, this->Parallel);
  }
}

} // namespace

void settleNumber(const DistributionParameters& parameters, const Buffer<Patch>& boundaries,
  MovingParticles& moving, const ParallelFor& parallelFor)
{
  NumberSettler(parameters, boundaries, moving, parallelFor).settle();
}

} // namespace hop
