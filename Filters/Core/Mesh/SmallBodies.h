#pragma once

#include "Mesh/OpenLoops.h"
#include "Mesh/TangentView.h"

namespace hop
{

/// Closes components of few particles that the stars left open, as those that bend by more than a star sees within a
/// spacing: where their particles and normals are those of a convex body, its mesh is the convex hull.
/// \param loops what is open
/// \return whether there were any
bool closeSmallBodies(const ParticleNeighbors& neighbors, const ConstrainedEdges& edges,
  const std::vector<OpenLoop>& loops, TriangleFans& fans);

} // namespace hop
