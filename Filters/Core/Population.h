#pragma once

#include "PatchRelaxation.h"
#include "SpacingGrid.h"

#include <vector>

namespace hop
{

/// Which particles to remove and to double so that everywhere stand as many as wanted, seen by their
/// energies after some sweeps: 1 + e times that of hexagonal packing means spacings 1 + eps times
/// those wanted, e = beta E'(beta)/E(beta) eps + ..., and (1 + eps)^2 - 1 particles missing for each
/// that there is. These are averaged over all that a particle sees and summed up along the order of
/// the particles; each time that sum has grown by one a particle is doubled, each time it has fallen
/// by one one is removed. On surfaces that bend too fast for their particles energies say nothing.
///
/// Single defects are particles with far too much energy, which are removed, and holes as wide as a
/// particle, which are filled.
///
/// \param energies of the last sweep; negative for particles that are fixed
/// \param relaxed its displacements; gets its marks and splits; all are kept where it says nothing else
void balancePopulation(const Buffer<Patch>& patches, const SeenLists& lists,
  const std::vector<float>& energies, const Balance& balance, const ParallelFor& parallelFor,
  Relaxed& relaxed);

} // namespace hop
