#pragma once

#include "Surface/Particles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hop::testing
{

/// What holds for a triangle mesh whose vertices are particles. Coincident particles count as one vertex; vertices that
/// no triangle has do not count, but for unusedParticles. It shares no code with what makes meshes.
struct MeshMeasures
{
  /// Edges that two triangles pass in the same direction, or that have more than two triangles.
  std::int64_t badEdges = 0;
  /// Edges with one triangle, and the loops that they form.
  std::int64_t openEdges = 0;
  std::int64_t openLoops = 0;
  /// Open edges that are none of Distribution::edges, nor end at a particle that stands beside one, within a twentieth of
  /// its spacing.
  std::int64_t holeEdges = 0;
  /// Vertices whose triangles form more than one fan.
  std::int64_t badVertices = 0;
  /// Triangles whose normal does not point to the same side as those of its corners.
  std::int64_t turnedTriangles = 0;
  std::int64_t unusedParticles = 0;
  std::int64_t eulerCharacteristic = 0;
  std::int64_t components = 0;
  /// World units squared.
  double area = 0.0;
  /// Of the triangles' smallest angles, degrees: the median; the 1% quantile, without triangles at edges of the surface;
  /// and the least.
  double medianMinAngle = 0.0;
  double lowMinAngle = 0.0;
  double worstMinAngle = 0.0;
};

MeshMeasures measureMesh(
  const Distribution& distribution, const std::vector<std::array<int, 3>>& triangles);

} // namespace hop::testing
