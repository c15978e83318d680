#pragma once

#include "Mesh/ConstrainedEdges.h"
#include "Mesh/TriangleFans.h"

#include <vector>

namespace hop
{

/// Particles in order along edges that lack a triangle to their left, as seen from where the normals point to: the
/// border of a hole counterclockwise, or that of a piece of the mesh clockwise.
struct OpenLoop
{
  std::vector<int> particles;
  /// Whether the last edge leads back to the first particle. It does not where constrained edges end in the midst of
  /// the surface.
  bool isClosed = true;

  std::size_t edgeCount() const { return this->particles.size() - (this->isClosed ? 0 : 1); }
};

/// All edges that lack a triangle though the surface does not end there, as loops, in the order of their first
/// particles. Edges there and back between the same places enclose nothing, and are no loop; nor are rows of edges that
/// count in both directions and have triangles on one side alone.
std::vector<OpenLoop> findOpenLoops(const Buffer<Particle>& particles,
  const ConstrainedEdges& edges, const TriangleFans& fans, const ParallelFor& parallelFor);

/// Twice the area that a loop encloses as seen from where the normals of its particles point to: negative around a piece
/// of the mesh.
double areaInside(const Buffer<Particle>& particles, const std::vector<int>& loop);

/// Cuts closed loops that pass a particle twice in two, if both parts are holes: they only touch there.
void cutAtPinches(const Buffer<Particle>& particles, std::vector<OpenLoop>& loops);

/// Whether a loop runs along constrained edges and, between them, along faces at which the surface of a discontinuous
/// field ends: the mesh ends there, and the surface does not go on inside of the loop. A part of a curve was lost there,
/// or thinned out.
bool isAlongEnds(const ElementMesh& mesh, const Distribution& distribution, const OpenLoop& loop,
  const ConstrainedEdges& edges);

} // namespace hop
