#pragma once

#include "Mesh/OpenLoops.h"
#include "Mesh/TangentView.h"

namespace hop
{

/// Fills the holes that the stars have left. Each hole gets the triangulation whose triangles are nearest to
/// equilateral ones in sum: of a polygon in the plane that is the constrained Delaunay triangulation. Particles and
/// pieces of the mesh inside a hole are joined to its border first; where a triangle would be much larger than the
/// spacing allows, a particle is added on the surface. A triangle is made only
///  - if no edge gets a third triangle by it,
///  - if its normal points to the same side as those of its corners,
///  - if the surface goes on below its middle.
/// Small holes that have no such triangulation get one whose triangles are turned away from as few corners as may be.
/// Holes that have no such triangulation, or too many edges, stay open.
/// Derivation: Documentation/algorithm.md, section Mesh.
/// \param distribution receives the particles that are added
void fillHoles(const Isosurface& surface, const ParticleNeighbors& neighbors,
  const ConstrainedEdges& edges, Distribution& distribution, TriangleFans& fans,
  const ParallelFor& parallelFor);

} // namespace hop
