#pragma once

#include "Mesh/OpenLoops.h"
#include "Mesh/TangentView.h"
#include "Mesh/TriangleFans.h"

namespace hop
{

/// Joins particles without triangles to the mesh that covers their places, one after the other (Bowyer and Watson): the
/// triangles whose circles in the tangent plane of the particle contain it are replaced by triangles with the particle.
/// Constrained edges stay. A particle is left alone where a triangle would be turned away from the normal of a corner.
void joinLooseParticles(const ParticleNeighbors& neighbors, const ConstrainedEdges& edges,
  const std::vector<OpenLoop>& loops, TriangleFans& fans);

} // namespace hop
