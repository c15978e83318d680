#include "Topology/TopologyComparison.h"

#include "Support/DisjointSets.h"
#include "Support/SortedBy.h"

#include <algorithm>
#include <set>

namespace hop
{
namespace
{

/// A triangle as one of its corners sees it: the other two in their order.
struct FanTriangle
{
  int from = -1;
  int to = -1;
};

/// What a vertex knows of the mesh's boundary.
struct Fan
{
  /// The next vertex along the boundary, with the triangles to the left; -1 inside.
  int next = -1;
  /// Whether the triangles are one fan, open or closed.
  bool isOne = true;
};

/// Follows the triangles around a vertex.
Fan followFan(const std::vector<FanTriangle>& triangles)
{
  const auto isStart = [&](const FanTriangle& first)
  {
    return std::none_of(triangles.begin(), triangles.end(),
      [&](const FanTriangle& other) { return other.to == first.from; });
  };
  const auto start = std::find_if(triangles.begin(), triangles.end(), isStart);
  Fan fan;
  fan.next = start == triangles.end() ? -1 : start->from;
  auto at = start == triangles.end() ? triangles.begin() : start;
  std::size_t visited = 0;
  while (at != triangles.end() && visited < triangles.size())
  {
    ++visited;
    const int to = at->to;
    const bool isClosed = fan.next < 0 && to == triangles.front().from;
    at = isClosed ? triangles.end()
                  : std::find_if(triangles.begin(), triangles.end(),
                      [to](const FanTriangle& other) { return other.from == to; });
  }
  const auto hasTwin = [&](const FanTriangle& one)
  {
    return std::count_if(triangles.begin(), triangles.end(),
             [&](const FanTriangle& other)
             { return other.from == one.from || other.to == one.to; }) > 1;
  };
  fan.isOne =
    visited == triangles.size() && std::none_of(triangles.begin(), triangles.end(), hasTwin);
  return fan;
}

/// The fans of all vertices.
std::vector<Fan> findFans(std::size_t vertexCount, const std::vector<std::array<int, 3>>& triangles,
  const ParallelFor& parallelFor)
{
  std::vector<int> corners;
  corners.reserve(3 * triangles.size());
  for (const std::array<int, 3>& triangle : triangles)
  {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  const Grouping ofVertex = groupedBy(
    corners, vertexCount, [](int vertex) { return vertex; }, parallelFor);
  std::vector<Fan> fans(vertexCount);
  forAll(parallelFor, vertexCount,
    [&](std::size_t vertex)
    {
      std::vector<FanTriangle> around;
      for (int n = ofVertex.start[vertex]; n < ofVertex.start[vertex + 1]; ++n)
      {
        const int corner = ofVertex.order[n];
        const std::array<int, 3>& triangle = triangles[corner / 3];
        around.push_back({ triangle[(corner + 1) % 3], triangle[(corner + 2) % 3] });
      }
      fans[vertex] = followFan(around);
    });
  return fans;
}

/// Counts vertices, edges, triangles and boundary loops of the mesh's components.
class MeshCounter
{
public:
  MeshCounter(std::size_t vertexCount, const std::vector<std::array<int, 3>>& triangles)
    : VertexCount(static_cast<int>(vertexCount))
    , Triangles(triangles)
    , Joined(vertexCount)
    , ComponentOfVertex(vertexCount, -1)
    , IsUsed(vertexCount, 0)
  {
    for (const std::array<int, 3>& triangle : triangles)
    {
      this->IsUsed[triangle[0]] = this->IsUsed[triangle[1]] = this->IsUsed[triangle[2]] = 1;
      this->Joined.unite(triangle[0], triangle[1]);
      this->Joined.unite(triangle[0], triangle[2]);
    }
  }

  /// -1: a vertex without triangle.
  const std::vector<int>& componentOfVertex() const { return this->ComponentOfVertex; }

  std::vector<ComponentComparison> count(const std::vector<Fan>& fans)
  {
    std::vector<ComponentComparison> components;
    std::vector<std::int64_t> doubledEdges; // 3 F + B, where B edges have one triangle
    for (int vertex = 0; vertex < this->VertexCount; ++vertex)
    {
      if (!this->IsUsed[vertex])
      {
        continue;
      }
      const int root = this->Joined.root(vertex);
      if (root == vertex)
      {
        this->ComponentOfVertex[vertex] = static_cast<int>(components.size());
        components.emplace_back().vertex = vertex;
        doubledEdges.push_back(0);
      }
      const int number = this->ComponentOfVertex[vertex] = this->ComponentOfVertex[root];
      components[number].eulerCharacteristic += 1;
      components[number].isManifold &= fans[vertex].isOne;
      doubledEdges[number] += fans[vertex].next >= 0;
    }
    for (const std::array<int, 3>& triangle : this->Triangles)
    {
      components[this->ComponentOfVertex[triangle[0]]].eulerCharacteristic += 1;
      doubledEdges[this->ComponentOfVertex[triangle[0]]] += 3;
    }
    for (std::size_t n = 0; n < components.size(); ++n)
    {
      components[n].eulerCharacteristic -= doubledEdges[n] / 2;
    }
    this->countLoops(fans, components);
    return components;
  }

private:
  void countLoops(const std::vector<Fan>& fans, std::vector<ComponentComparison>& components) const
  {
    DisjointSets loops(fans.size());
    for (int vertex = 0; vertex < this->VertexCount; ++vertex)
    {
      if (fans[vertex].next >= 0)
      {
        loops.unite(vertex, fans[vertex].next);
      }
    }
    for (int vertex = 0; vertex < this->VertexCount; ++vertex)
    {
      if (fans[vertex].next >= 0 && loops.root(vertex) == vertex)
      {
        components[this->ComponentOfVertex[vertex]].boundaryLoops += 1;
      }
    }
  }

  int VertexCount;
  const std::vector<std::array<int, 3>>& Triangles;
  DisjointSets Joined;
  std::vector<int> ComponentOfVertex;
  std::vector<char> IsUsed;
};

/// Finds the component of the surface on which all vertices of each component of the mesh lie.
/// \return for each component of the surface the number of components of the mesh with vertices on it, which lie on it
///   alone or not
std::vector<int> findCounterparts(const std::vector<int>& surfaceComponents,
  std::size_t componentCount, const std::vector<int>& componentOfVertex,
  std::vector<ComponentComparison>& components)
{
  std::set<std::pair<int, int>> pairs; // of components of surface and mesh
  for (ComponentComparison& component : components)
  {
    component.component = SurfaceTopology::AnyComponent;
  }
  for (std::size_t vertex = 0; vertex < surfaceComponents.size(); ++vertex)
  {
    const int mesh = componentOfVertex[vertex];
    const int surface = surfaceComponents[vertex];
    if (mesh >= 0 && surface != SurfaceTopology::AnyComponent)
    {
      int& known = components[mesh].component;
      if (known != surface)
      {
        known = known == SurfaceTopology::AnyComponent ? surface : SurfaceTopology::NoComponent;
        pairs.emplace(surface, mesh);
      }
    }
  }
  std::vector<int> meshesOn(componentCount, 0);
  for (const auto& [component, mesh] : pairs)
  {
    if (component >= 0)
    {
      ++meshesOn[component];
    }
  }
  return meshesOn;
}

} // namespace

TopologyComparison compareTopology(const SurfaceTopology& topology,
  const Buffer<Particle>& vertices, const std::vector<std::array<int, 3>>& triangles,
  const ParallelFor& parallelFor)
{
  std::vector<int> surfaceComponents(vertices.size());
  forAll(parallelFor, vertices.size(),
    [&](std::size_t v) { surfaceComponents[v] = topology.componentAt(vertices[v].location); });
  TopologyComparison comparison;
  MeshCounter counter(vertices.size(), triangles);
  comparison.meshComponents = counter.count(findFans(vertices.size(), triangles, parallelFor));
  const std::vector<int> meshesOn = findCounterparts(surfaceComponents, topology.components.size(),
    counter.componentOfVertex(), comparison.meshComponents);
  comparison.proven = topology.isProven();
  for (ComponentComparison& mesh : comparison.meshComponents)
  {
    if (mesh.component >= 0)
    {
      const SurfaceComponent& surface = topology.components[mesh.component];
      mesh.proven = surface.proven && mesh.isManifold && meshesOn[mesh.component] == 1 &&
        surface.eulerCharacteristic == mesh.eulerCharacteristic &&
        surface.boundaryLoops == mesh.boundaryLoops;
    }
    comparison.proven &= mesh.proven;
  }
  for (std::size_t component = 0; component < meshesOn.size(); ++component)
  {
    if (meshesOn[component] == 0)
    {
      comparison.missingComponents.push_back(static_cast<int>(component));
    }
  }
  comparison.proven &= comparison.missingComponents.empty();
  return comparison;
}

} // namespace hop
