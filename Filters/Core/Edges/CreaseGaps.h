#pragma once

#include "Edges/ParticleGrid.h"

namespace hop
{

/// Moves planes of creases outwards where nothing else covers what they cut off. A sliver between two creases, or a
/// corner where several meet, may be too narrow for a particle of its own, and the splats around all end at their own
/// planes. Among the particles whose splats could cover a place in it, the one whose plane is nearest to the place covers
/// it. Planes of faces where the surface is almost smooth, behind which splats fill more, come before those of creases, as
/// less of a splat stands off, and in another brightness.
///
/// Planes of creases of more than 80 degrees stay: splats would stand off from what they are to cover.
/// Derivation: Documentation/algorithm.md, section Boundary curves and creases.
/// \pre all other planes are marked (ClipPlanes.h)
void closeCreaseGaps(const ParticleGrid& all, const ParallelFor& parallelFor);

} // namespace hop
