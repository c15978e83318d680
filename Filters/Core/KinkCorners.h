#pragma once

#include "ParticleGrid.h"

namespace hop
{

/// Moves planes of kinks outwards where nothing else covers what they cut off. Where several kinks meet, the
/// corner between two of them may be too narrow for a particle of its own, and its neighbours all end at their
/// own planes. Of those that could cover such a place, the one whose plane is nearest to it does.
///
/// Planes of kinks of more than 80 degrees stay: splats would stand off from what they are to cover.
/// \pre planes are marked
void closeKinkCorners(const ParticleGrid& all, const ParallelFor& parallelFor);

} // namespace hop
