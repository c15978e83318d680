#pragma once

#include "Edges/ParticleGrid.h"

namespace hop
{

/// Tells particles near an edge of the surface where it ends, by planes that touch the edge where it is nearest:
/// near a boundary curve normal to the surface's way out of the domain there, as the nearest particle on the boundary curve knows it to
/// second order; near a face at which the normal turns as they were offered it (FacePlanes.h), at a crease only if
/// there are particles behind to cover what is cut off. A splat that reaches beyond a plane is to be cut off there,
/// or, where the surface is almost smooth, to count only where no other does. In corners two planes meet; where
/// creases do, some planes are moved outwards, see CreaseCorners.h.
void markClipPlanes(
  const Isosurface& surface, const ParticleGrid& all, const ParallelFor& parallelFor);

} // namespace hop
