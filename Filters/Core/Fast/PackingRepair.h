#pragma once

#include "Fast/MovingParticles.h"
#include "Fast/PatchRelaxation.h"

namespace hop
{

/// Which particles are relaxed further, and how.
struct Nearby
{
  /// Those not farther than this from a place, in units of the spacing.
  double reach = 3.0;
  /// As of Sweeps.
  float farthest = Sweeps{}.farthest;
};

/// Relaxes particles around some places further, alone; those farther off stay.
/// \return those of them that stand too near to others afterwards
Buffer<Patch> relaxAround(const Buffer<Patch>& places, Balance::Extent extent,
  MovingParticles& moving, const ParallelFor& parallelFor, const Nearby& nearby = {});

/// Mends places where particles stand too near to each other, and what is left of them as long as that may
/// be mended; in the end in short steps, as at sharp creases long ones lead back and forth between patches of
/// the two sides.
void repairPacking(MovingParticles& moving, const ParallelFor& parallelFor);

} // namespace hop
