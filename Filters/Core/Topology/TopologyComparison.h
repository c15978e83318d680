#pragma once

#include "Topology/SurfaceTopology.h"

#include <array>

namespace hop
{

/// A component of a triangle mesh, and the component of the surface that it stands for.
struct ComponentComparison
{
  /// Index in SurfaceTopology::components of the component on which all its vertices lie; -1 if there is no such one.
  int component = -1;
  /// Of the mesh.
  std::int64_t eulerCharacteristic = 0;
  std::int64_t boundaryLoops = 0;
  /// The first of its vertices.
  int vertex = -1;
  /// Whether the component of the surface is proven, this is the only component of the mesh that lies on it, and
  /// Euler characteristics and boundary loops are equal.
  bool proven = false;
};

struct TopologyComparison
{
  /// One entry a component of the mesh, by first vertex.
  std::vector<ComponentComparison> meshComponents;
  /// Whether all components of mesh and surface are proven to correspond, and none may be missing.
  bool proven = false;
};

/// Compares a triangle mesh with the surface.
/// \param vertices places of the mesh's vertices, on the surface; vertices without triangle count as components
/// \param triangles indices of vertices; the mesh is a manifold: one or two triangles an edge
TopologyComparison compareTopology(const ElementMesh& mesh, const SurfaceTopology& topology,
  const std::vector<Location>& vertices, const std::vector<std::array<int, 3>>& triangles,
  const ParallelFor& parallelFor);

} // namespace hop
