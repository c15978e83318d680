#pragma once

#include "Surface/Particles.h"
#include "Topology/SurfaceTopology.h"

#include <array>

namespace hop
{

/// A component of a triangle mesh, and the component of the surface that it stands for.
struct ComponentComparison
{
  /// Index in SurfaceTopology::components of the component on which all its vertices lie; negative if there is none.
  int component = -1;
  /// Of the mesh.
  std::int64_t eulerCharacteristic = 0;
  std::int64_t boundaryLoops = 0;
  /// The first of its vertices.
  int vertex = -1;
  /// Whether every edge has one or two triangles, wound alike, and every vertex one fan of triangles.
  bool isManifold = true;
  /// Whether the mesh is as the surface is proven to be: the component of the surface is proven, no other component of
  /// the mesh lies on it, and Euler characteristics and boundary loops are equal.
  bool proven = false;
};

struct TopologyComparison
{
  /// One entry a component of the mesh, by first vertices.
  std::vector<ComponentComparison> meshComponents;
  /// Components of the surface on which the mesh has no triangle: indices in SurfaceTopology::components, ascending.
  std::vector<int> missingComponents;
  /// Whether all components of the mesh are proven, and no component of the surface is missing or may be.
  bool proven = false;
};

/// Compares a triangle mesh with the surface.
/// \param vertices points of the surface; those without triangle are no part of the mesh
/// \param triangles indices of vertices, wound alike
TopologyComparison compareTopology(const SurfaceTopology& topology,
  const Buffer<Particle>& vertices, const std::vector<std::array<int, 3>>& triangles,
  const ParallelFor& parallelFor);

} // namespace hop
