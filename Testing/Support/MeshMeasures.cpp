#include "MeshMeasures.h"

#include "Support/DisjointSets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hop::testing
{
namespace
{

using Corners = std::array<int, 3>;
constexpr double degreesPerRadian = 57.295779513082321;

/// Whether the surface ends at a particle, to a twentieth of its spacing.
bool isAtBoundary(const Particle& particle)
{
  return std::any_of(particle.clips.begin(), particle.clips.end(),
    [&](const ClipPlane& plane)
    { return plane.isBoundary() && plane.distance <= 0.05 * particle.spacing; });
}

/// The triangles with coincident particles as one vertex.
class WeldedMesh
{
public:
  WeldedMesh(const Distribution& distribution, const std::vector<Corners>& triangles)
    : VertexOf(distribution.particles.size())
  {
    for (const auto& [a, b] : distribution.edges.coincident)
    {
      this->VertexOf.unite(a, b);
    }
    for (std::size_t p = 0; p < distribution.particles.size(); ++p)
    {
      if (isAtBoundary(distribution.particles[p]))
      {
        this->BesideSegments.insert(this->VertexOf.root(static_cast<int>(p)));
      }
    }
    for (const auto& [a, b] : distribution.edges.segments)
    {
      this->Segments.insert(std::minmax(this->VertexOf.root(a), this->VertexOf.root(b)));
      this->BesideSegments.erase(this->VertexOf.root(a));
      this->BesideSegments.erase(this->VertexOf.root(b));
    }
    for (const Corners& triangle : triangles)
    {
      this->Triangles.push_back({ this->VertexOf.root(triangle[0]),
        this->VertexOf.root(triangle[1]), this->VertexOf.root(triangle[2]) });
    }
  }

  bool isBoundary(const std::pair<int, int>& edge) const
  {
    return this->Segments.count(edge) > 0 || this->BesideSegments.count(edge.first) > 0 ||
      this->BesideSegments.count(edge.second) > 0;
  }

  void measure(MeshMeasures& measures)
  {
    DisjointSets sets(this->VertexOf.size());
    // Corners of triangles that share an edge at a vertex are in one fan.
    DisjointSets fans(3 * this->Triangles.size());
    std::map<std::pair<int, int>, std::vector<int>> sides;
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      const Corners& corners = this->Triangles[t];
      for (int n = 0; n < 3; ++n)
      {
        sets.unite(corners[n], corners[(n + 1) % 3]);
        sides[std::minmax(corners[n], corners[(n + 1) % 3])].push_back(static_cast<int>(3 * t) + n);
      }
    }
    DisjointSets loops(this->VertexOf.size());
    std::set<int> open;
    for (const auto& [edge, corners] : sides)
    {
      if (corners.size() == 1)
      {
        ++measures.openEdges;
        measures.holeEdges += !this->isBoundary(edge);
        loops.unite(edge.first, edge.second);
        open.insert(edge.first);
      }
      else
      {
        measures.badEdges +=
          corners.size() > 2 || this->corner(corners[0]) == this->corner(corners[1]);
      }
      for (std::size_t n = 1; n < corners.size(); ++n)
      {
        this->joinFans(fans, corners[0], corners[n]);
      }
    }
    std::set<int> loopRoots, componentRoots, vertices, fanRoots;
    for (const int vertex : open)
    {
      loopRoots.insert(loops.root(vertex));
    }
    for (std::size_t c = 0; c < 3 * this->Triangles.size(); ++c)
    {
      vertices.insert(this->corner(static_cast<int>(c)));
      componentRoots.insert(sets.root(this->corner(static_cast<int>(c))));
      fanRoots.insert(fans.root(static_cast<int>(c)));
    }
    measures.openLoops = static_cast<std::int64_t>(loopRoots.size());
    measures.components = static_cast<std::int64_t>(componentRoots.size());
    measures.badVertices = static_cast<std::int64_t>(fanRoots.size() - vertices.size());
    measures.eulerCharacteristic = static_cast<std::int64_t>(vertices.size()) -
      static_cast<std::int64_t>(sides.size()) + static_cast<std::int64_t>(this->Triangles.size());
  }

private:
  int corner(int number) const { return this->Triangles[number / 3][number % 3]; }
  static int following(int number) { return number % 3 == 2 ? number - 2 : number + 1; }

  /// \param a, b the first corners of the same edge in two triangles
  void joinFans(DisjointSets& fans, int a, int b) const
  {
    const bool alike = this->corner(a) == this->corner(b);
    fans.unite(a, alike ? b : following(b));
    fans.unite(following(a), alike ? following(b) : b);
  }

  struct Sets : DisjointSets
  {
    explicit Sets(std::size_t count)
      : DisjointSets(count)
      , Count(count)
    {
    }
    std::size_t size() const { return this->Count; }
    std::size_t Count;
  };

  Sets VertexOf;
  std::vector<Corners> Triangles;
  std::set<std::pair<int, int>> Segments;
  /// Particles on no segment at which the surface ends.
  std::set<int> BesideSegments;
};

/// Degrees.
double minAngleOf(const std::array<glm::dvec3, 3>& x)
{
  double least = 180.0;
  for (int n = 0; n < 3; ++n)
  {
    const glm::dvec3 a = x[(n + 1) % 3] - x[n];
    const glm::dvec3 b = x[(n + 2) % 3] - x[n];
    least =
      std::min(least, degreesPerRadian * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
  }
  return least;
}

double quantile(std::vector<double>& values, double share)
{
  if (values.empty())
  {
    return 0.0;
  }
  const auto at =
    values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

bool isNearEdge(const Particle& particle)
{
  return std::any_of(particle.clips.begin(), particle.clips.end(),
    [&](const ClipPlane& plane) { return plane.exists() && plane.distance < particle.spacing; });
}

void measureTriangles(const Buffer<Particle>& particles,
  const std::vector<std::array<int, 2>>& coincident, const std::vector<Corners>& triangles,
  MeshMeasures& measures)
{
  std::vector<double> angles, inner;
  std::vector<char> isUsed(particles.size(), 0);
  for (const Corners& triangle : triangles)
  {
    std::array<glm::dvec3, 3> x;
    bool isInner = true;
    for (int n = 0; n < 3; ++n)
    {
      x[n] = particles[triangle[n]].position.xyz;
      isUsed[triangle[n]] = 1;
      isInner = isInner && !isNearEdge(particles[triangle[n]]);
    }
    const glm::dvec3 normal = glm::cross(x[1] - x[0], x[2] - x[0]);
    measures.area += 0.5 * glm::length(normal);
    measures.turnedTriangles += std::any_of(triangle.begin(), triangle.end(),
      [&](int corner) { return glm::dot(normal, particles[corner].normal.xyz) <= 0.0; });
    angles.push_back(minAngleOf(x));
    if (isInner)
    {
      inner.push_back(angles.back());
    }
  }
  // All pairs of a place have its first particle.
  for (int n = 0; n < 2; ++n)
  {
    for (const auto& [a, b] : coincident)
    {
      isUsed[a] = isUsed[b] = isUsed[a] | isUsed[b];
    }
  }
  measures.unusedParticles = std::count(isUsed.begin(), isUsed.end(), 0);
  measures.worstMinAngle = angles.empty() ? 0.0 : *std::min_element(angles.begin(), angles.end());
  measures.medianMinAngle = quantile(angles, 0.5);
  measures.lowMinAngle = quantile(inner, 0.01);
}

} // namespace

MeshMeasures measureMesh(const Distribution& distribution, const std::vector<Corners>& triangles)
{
  MeshMeasures measures;
  WeldedMesh(distribution, triangles).measure(measures);
  measureTriangles(distribution.particles, distribution.edges.coincident, triangles, measures);
  return measures;
}

} // namespace hop::testing
