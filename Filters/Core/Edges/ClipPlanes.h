#pragma once

#include "Edges/ParticleGrid.h"

namespace hop
{

/// Tells particles near an edge of the surface where to cut their splats off, by planes that touch the edge where it is
/// nearest. The edge is a boundary curve, which the nearest particle on it knows to second order, or a face with a
/// dihedral angle, whose plane particles were offered before (FacePlanes.h). Planes of creases are open where nothing
/// behind them covers what they cut off, or moved outwards (CreaseGaps.h). In corners planes meet. Beyond planes of
/// smaller angles splats are not cut off, but count only where no other does.
/// Derivation: Documentation/algorithm.md, section Boundary curves and creases.
/// \param thinned see BoundaryCurves
void markClipPlanes(const Isosurface& surface, const ParticleGrid& all,
  Buffer<BoundaryParticle>& thinned, const ParallelFor& parallelFor);

} // namespace hop
