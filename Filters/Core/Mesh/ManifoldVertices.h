#pragma once

#include "Mesh/TriangleFans.h"

#include <vector>

namespace hop
{

/// Makes a mesh a manifold with boundary where only vertices keep it from being one: of several fans of triangles that
/// touch in a vertex, the largest stays, and of two alike the one with the least particle.
/// \return whether triangles were removed
bool keepOneFan(TriangleFans& fans, const ParallelFor& parallelFor);

/// Makes a mesh a manifold with boundary also where particles in one place are one vertex. Of triangles on one side of an
/// edge the first stays: where many creases meet within a spacing, those of several sheets may end in the same two places.
/// \param places for each particle the first one in its place
void keepManifold(
  const std::vector<int>& places, TriangleFans& fans, const ParallelFor& parallelFor);

} // namespace hop
