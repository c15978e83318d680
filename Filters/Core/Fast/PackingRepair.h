#pragma once

#include "Fast/MovingParticles.h"
#include "Fast/PatchRelaxation.h"
#include "Support/Slab.h"

namespace hop
{

/// Which particles around a place are relaxed further, and how.
struct RepairRegion
{
  /// Largest distance of a particle from the place, in units of its spacing. Chosen by experiment. Larger: more
  /// evaluations; smaller: less room to spread into.
  double reach = 3.0;
  /// As of Sweeps.
  float farthest = Sweeps{}.farthest;
};

/// Relaxes the particles around some places further. Particles farther off stay where they are.
/// \return the relaxed particles that still stand too near to others
Buffer<Patch> relaxAround(const Buffer<Patch>& places, Balance::Extent extent,
  MovingParticles& moving, const ParallelFor& parallelFor, const RepairRegion& region = {});

/// Repairs places where particles stand too near to each other, and repeats that where pairs are left, as long as they
/// are few. The last repair takes short steps: at sharp creases long ones lead back and forth between the patches of
/// the two sides.
/// \param where the places have to be
void repairPacking(MovingParticles& moving, const ParallelFor& parallelFor, const Slab& where = {});

} // namespace hop
