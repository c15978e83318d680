#pragma once

#include "Mesh/ConstrainedEdges.h"
#include "Mesh/TriangleFans.h"

#include <vector>

namespace hop
{

/// Gives fans of triangles that touch in a vertex a particle each, all in the same place: boundary curves of the surface
/// touch there, as where a jump fades. The largest fan keeps the vertex; fans that do not begin and end at boundary
/// curves stay as they are.
/// \param edges follow their fans
/// \param particles receive the new ones
/// \return pairs of a particle and a new one in its place
std::vector<std::array<int, 2>> splitFans(ConstrainedEdges& edges, Buffer<Particle>& particles,
  TriangleFans& fans, const ParallelFor& parallelFor);

/// Makes a mesh a manifold with boundary where only vertices keep it from being one: of several fans of triangles that
/// touch in a vertex, the largest stays, and of two alike the one with the least particle.
/// \return whether triangles were removed
bool keepOneFan(TriangleFans& fans, const ParallelFor& parallelFor);

/// Makes a mesh a manifold with boundary also where particles in one place are one vertex. Of triangles on one side of an
/// edge the first stays: where many creases meet within a spacing, those of several sheets may end in the same two places.
/// \param places for each particle the first one in its place
/// \return all triangles, as TriangleFans::triangles()
std::vector<Triangle> keepManifold(
  const std::vector<int>& places, TriangleFans& fans, const ParallelFor& parallelFor);

} // namespace hop
