#pragma once

#include "Edges/ParticleGrid.h"

namespace hop
{

/// Moves planes of creases outwards where nothing else covers what they cut off. Where several creases meet, the
/// corner between two of them may be too narrow for a particle of its own, and its neighbours all end at their
/// own planes. Of those that could cover such a place, the one whose plane is nearest to it does.
///
/// Planes of creases of more than 80 degrees stay: splats would stand off from what they are to cover.
/// \pre planes are marked
void closeCreaseCorners(const ParticleGrid& all, const ParallelFor& parallelFor);

} // namespace hop
