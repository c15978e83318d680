#pragma once

#include "MovingParticles.h"
#include "PatchRelaxation.h"

namespace hop
{

/// Relaxes particles around some places further, alone; those farther off stay.
/// \return those of them that stand too near to others afterwards
Buffer<Patch> relaxAround(const Buffer<Patch>& places, Balance::Extent extent,
  MovingParticles& moving, const ParallelFor& parallelFor);

/// Mends places where particles stand too near to each other, and what is left of them as long as that may
/// be mended.
void repairPacking(MovingParticles& moving, const ParallelFor& parallelFor);

} // namespace hop
