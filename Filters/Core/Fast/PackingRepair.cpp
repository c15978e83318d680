#include "Fast/PackingRepair.h"

#include "Fast/PatchDistances.h"
#include "Support/KeepMarked.h"

#include <algorithm>

namespace hop
{
namespace
{

/// What is repaired, and how often. All numbers were chosen by experiment.
struct Repair
{
  /// Pairs nearer than this, in units of the smaller of their spacings, are defects of the packing. A little more than
  /// the 0.80 that TestFastQuality.cpp demands of the nearest pair. Larger: more evaluations.
  static constexpr double SmallestDistance = 0.82;
  /// How far around the particles that move others are kept as fixed neighbours, in units of the spacing: more than the
  /// sqrt(3) over which particles interact, and the distance that they may move. Larger: more time.
  static constexpr double Sight = 3.0;
  /// Rounds of each repair, and sweeps of each round. Each round costs an evaluation of every particle that moves.
  static constexpr int Rounds = 2;
  static constexpr int Sweeps = 8;
  /// Largest number of repairs after the first.
  static constexpr int Repeats = 2;
  /// Share of all particles up to which defects that are left are repaired again. Where there are more, as where the
  /// field jumps, most of them cannot be repaired.
  static constexpr double FewDefects = 0.005;
};

/// Of the last repair: only the particles beside defects move, in short steps. A smaller reach costs fewer evaluations.
/// Chosen by experiment.
constexpr RepairRegion lastRegion{ 1.5, 0.2f };

/// Particles that move and stand too near to another one.
Buffer<Patch> findCrowded(const MovingParticles& particles, const ParallelFor& parallelFor)
{
  const Buffer<Patch>& patches = particles.patches();
  return marked(patches,
    opposite(areSeparated(patches, particles.count(), Repair::SmallestDistance, parallelFor)));
}

} // namespace

Buffer<Patch> relaxAround(const Buffer<Patch>& places, Balance::Extent extent,
  MovingParticles& moving, const ParallelFor& parallelFor, const RepairRegion& region)
{
  const Buffer<Patch>& patches = moving.patches();
  const std::size_t count = moving.count();
  const std::vector<char> staying = areFarFrom(patches, count, places, region.reach, parallelFor);
  const std::vector<char> outOfSight =
    areFarFrom(patches, patches.size(), places, region.reach + Repair::Sight, parallelFor);
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
  for (int n = 0; n < Repair::Rounds; ++n)
  {
    part.relax({ Repair::Sweeps, region.farthest }, balance);
  }
  moving.keep(staying);
  moving.append(part);
  return findCrowded(part, parallelFor);
}

void repairPacking(MovingParticles& moving, const ParallelFor& parallelFor, const Slab& where)
{
  Buffer<Patch> crowded = findCrowded(moving, parallelFor);
  crowded.erase(std::remove_if(crowded.begin(), crowded.end(),
                  [&](const Patch& patch) { return !where.holds(patch.position); }),
    crowded.end());
  for (int n = 0; n <= Repair::Repeats && !crowded.empty(); ++n)
  {
    const double share = static_cast<double>(crowded.size()) / static_cast<double>(moving.count());
    if (n > 0 && share > Repair::FewDefects)
    {
      break;
    }
    crowded = relaxAround(crowded, Balance::Crowded, moving, parallelFor);
  }
  if (!crowded.empty())
  {
    relaxAround(crowded, Balance::None, moving, parallelFor, lastRegion);
  }
}

} // namespace hop
