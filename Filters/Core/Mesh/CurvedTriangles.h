#pragma once

#include "Surface/Particles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hop
{

/// Triangles of polynomial order k whose nodes lie on the exact surface. A node with the barycentric coordinates b of
/// its triangle is the place where the line through sum b_i x_i along sum b_i n_i meets the surface, with the corners'
/// positions x and normals n. This place is a smooth function of b, which nodes of order k interpolate: the surface of
/// the triangles is within O(h^(k+1)) of the exact one, and so are quantities that the nodes carry. On an edge the line
/// depends on the edge's ends alone, so that the triangles on its two sides share its nodes.
/// Derivation: Documentation/algorithm.md, section Curved triangles.
struct CurvedTriangles
{
  static constexpr int LeastOrder = 2;
  static constexpr int LargestOrder = 4;

  /// Number of nodes of a triangle.
  static constexpr int nodeCount(int order) { return (order + 1) * (order + 2) / 2; }

  /// nodeCount() particles a triangle, as VTK numbers them (vtkLagrangeTriangle): corners, nodes inside the edges 01,
  /// 12 and 20 from the first corner to the second, nodes inside the triangle.
  std::vector<int> nodes;
  /// Nodes that were not found on the surface: they stay on the straight edge or in the plane of the triangle.
  std::int64_t straightNodes = 0;
  std::int64_t evaluations = 0;
};

/// Bends triangles. Edges of one triangle, if they are on a boundary curve, and edges at which the two sides of a crease
/// meet are bent along the curve.
/// \param triangles corners as indices into the particles, counterclockwise as seen from where the normals point to
/// \param vertices one a particle: the first particle in the same place, itself as a rule
/// \param order LeastOrder to LargestOrder
/// \param particles receives the nodes behind the particles that are there: first those inside edges, then those inside
///   triangles
CurvedTriangles bendTriangles(const Isosurface& surface,
  const std::vector<std::array<int, 3>>& triangles, const std::vector<int>& vertices, int order,
  Buffer<Particle>& particles, const ParallelFor& parallelFor);

} // namespace hop
