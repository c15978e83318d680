#include "Fast/PackingRepair.h"

#include "Fast/PatchDistances.h"
#include "Support/KeepMarked.h"

namespace hop
{
namespace
{

/// Pairs nearer than this, in units of their spacing, are defects of the packing.
constexpr double smallestSpacing = 0.82;
/// So far, in units of the spacing, those that are relaxed look at others.
constexpr double sight = 3.0;
constexpr int repairRounds = 2;
constexpr int repairSweeps = 8;
/// What is left is repaired again, so often at most, if it is no more than that share of all particles: where
/// fields jump there is much that cannot be.
constexpr int furtherRepairs = 2;
constexpr double fewDefects = 0.005;
/// In the end.
constexpr Nearby lastSteps{ 1.5, 0.2f };

/// Those that move and stand too near to another one.
Buffer<Patch> findCrowded(const MovingParticles& particles, const ParallelFor& parallelFor)
{
  const Buffer<Patch>& patches = particles.patches();
  return marked(
    patches, opposite(areAlone(patches, particles.count(), smallestSpacing, parallelFor)));
}

} // namespace

Buffer<Patch> relaxAround(const Buffer<Patch>& places, Balance::Extent extent,
  MovingParticles& moving, const ParallelFor& parallelFor, const Nearby& nearby)
{
  const Buffer<Patch>& patches = moving.patches();
  const std::size_t count = moving.count();
  const std::vector<char> staying = areFarFrom(patches, count, places, nearby.reach, parallelFor);
  const std::vector<char> outOfSight =
    areFarFrom(patches, patches.size(), places, nearby.reach + sight, parallelFor);
  Buffer<Patch> around;
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    if (!outOfSight[i] && (i >= count || staying[i]))
    {
      around.push_back(patches[i]);
      around.back().fixed = true;
    }
  }
  const std::vector<char> going = opposite(staying);
  MovingParticles part(moving.surface(), moving.proxy(), std::move(around), parallelFor);
  part.add(marked(moving.anchors(), going), marked(patches, going));
  Balance balance;
  balance.extent = extent;
  for (int n = 0; n < repairRounds; ++n)
  {
    part.relax({ repairSweeps, nearby.farthest }, balance);
  }
  moving.keep(staying);
  moving.join(part);
  return findCrowded(part, parallelFor);
}

void repairPacking(MovingParticles& moving, const ParallelFor& parallelFor)
{
  Buffer<Patch> crowded = findCrowded(moving, parallelFor);
  for (int n = 0; n <= furtherRepairs && !crowded.empty(); ++n)
  {
    const double share = static_cast<double>(crowded.size()) / static_cast<double>(moving.count());
    if (n > 0 && share > fewDefects)
    {
      break;
    }
    crowded = relaxAround(crowded, Balance::Crowded, moving, parallelFor);
  }
  if (!crowded.empty())
  {
    relaxAround(crowded, Balance::None, moving, parallelFor, lastSteps);
  }
}

} // namespace hop
