#pragma once

#include "Mesh/TangentView.h"
#include "Mesh/TriangleFans.h"

namespace hop
{

/// The triangles that the particles agree about. Each particle triangulates its neighbours in its tangent plane, where
/// they stand at their distance in space: its star is that of the constrained Delaunay triangulation there. A triangle
/// is kept if it belongs to the stars of all of its corners. So
///  - an edge has one triangle on each of its sides at most, as it has in the star of each of its ends;
///  - the normal of a triangle points to the same side as the normals of its corners.
/// Triangles overlap nowhere where the stars' planes see the surface as a graph; holes are left where stars do not
/// agree.
/// Derivation: Documentation/algorithm.md, section Mesh.
TriangleFans agreedTriangles(const ParticleNeighbors& neighbors, const ConstrainedEdges& edges,
  const ParallelFor& parallelFor);

} // namespace hop
