#include "Mesh/Slivers.h"

#include "Mesh/TriangleNormal.h"
#include "Surface/ParticleMesh.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

namespace hop
{
namespace
{

using Corners = std::array<int, 3>;

/// In units of the spacing: length of edges, and height of triangles, that count as none. Chosen by experiment. Smaller:
/// triangles of less than a degree stay; larger: pairs of particles that a distribution leaves, 0.2 apart and more, count.
constexpr double None = 0.05;
/// Contractions make slivers that flips take away, and the other way round.
constexpr int MostRounds = 10;

class SliverRemoval
{
public:
  SliverRemoval(const ConstrainedEdges& edges, Buffer<Particle>& particles,
    std::vector<int>& vertices, std::vector<Corners>& triangles)
    : Edges(edges)
    , Particles(particles)
    , Vertices(vertices)
    , Triangles(triangles)
    , IsGone(triangles.size(), 0)
    , At(particles.size())
  {
    for (const auto& [vertex, particle] : sharedPlaces(vertices))
    {
      this->Shared[vertex].push_back(particle);
    }
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      for (const int corner : triangles[t])
      {
        this->At[vertices[corner]].push_back(static_cast<int>(t));
      }
    }
  }

  void remove()
  {
    bool isChanged = true;
    for (int round = 0; isChanged && round < MostRounds; ++round)
    {
      const bool isContracted = this->contractShortEdges();
      isChanged = this->flipLongEdges() || isContracted;
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      if (!this->IsGone[t])
      {
        this->Triangles[kept++] = this->Triangles[t];
      }
    }
    this->Triangles.resize(kept);
  }

private:
  struct Edge
  {
    double length;
    int a, b;
    bool operator<(const Edge& other) const
    {
      return std::tie(this->length, this->a, this->b) < std::tie(other.length, other.a, other.b);
    }
  };

  int vertex(int triangle, int corner) const
  {
    return this->Vertices[this->Triangles[triangle][corner % 3]];
  }
  const glm::dvec3& position(int particle) const { return this->Particles[particle].position.xyz; }

  /// The corner of a triangle that a vertex is; -1 if it is none.
  int cornerOf(int triangle, int vertex) const
  {
    for (int i = 0; i < 3; ++i)
    {
      if (this->vertex(triangle, i) == vertex)
      {
        return i;
      }
    }
    return -1;
  }

  /// The triangles of an edge.
  std::vector<int> trianglesOf(int a, int b) const
  {
    std::vector<int> result;
    for (const int t : this->At[a])
    {
      if (!this->IsGone[t] && this->cornerOf(t, b) >= 0)
      {
        result.push_back(t);
      }
    }
    return result;
  }

  /// The vertices that have an edge with one, ascending.
  std::vector<int> neighborsOf(int vertex) const
  {
    std::vector<int> result;
    for (const int t : this->At[vertex])
    {
      for (int i = 0; i < 3 && !this->IsGone[t]; ++i)
      {
        if (this->vertex(t, i) != vertex)
        {
          result.push_back(this->vertex(t, i));
        }
      }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  bool isBoundary(int a, int b) const { return this->trianglesOf(a, b).size() == 1; }

  bool isOnBoundary(int vertex) const
  {
    const std::vector<int> neighbors = this->neighborsOf(vertex);
    return std::any_of(neighbors.begin(), neighbors.end(),
      [&](int other) { return this->isBoundary(vertex, other); });
  }

  /// Least height, in units of the corners' least spacing.
  double heightOf(const Corners& corners) const
  {
    double longest = 0.0;
    double spacing = this->Particles[corners[0]].spacing;
    for (int i = 0; i < 3; ++i)
    {
      longest = std::max(
        longest, glm::distance(this->position(corners[i]), this->position(corners[(i + 1) % 3])));
      spacing = std::min(spacing, this->Particles[corners[i]].spacing);
    }
    return longest > 0.0
      ? glm::length(doubleAreaNormal(this->Particles, corners)) / (longest * spacing)
      : 0.0;
  }

  bool isTurned(const Corners& corners) const { return hop::isTurned(this->Particles, corners); }

  /// Of the particles in a vertex's place the one whose normal is nearest to that of a triangle, as on its side of a crease.
  int besideOf(int vertex, const Corners& triangle) const
  {
    const auto found = this->Shared.find(vertex);
    if (found == this->Shared.end())
    {
      return vertex;
    }
    const glm::dvec3 normal = doubleAreaNormal(this->Particles, triangle);
    return *std::max_element(found->second.begin(), found->second.end(),
      [&](int a, int b)
      {
        return glm::dot(normal, this->Particles[a].normal.xyz) <
          glm::dot(normal, this->Particles[b].normal.xyz);
      });
  }

  /// Whether an edge can be contracted without a change of topology.
  bool isContractible(int a, int b) const
  {
    const std::vector<int> own = this->trianglesOf(a, b);
    const std::vector<int> ofA = this->neighborsOf(a), ofB = this->neighborsOf(b);
    std::vector<int> common;
    std::set_intersection(
      ofA.begin(), ofA.end(), ofB.begin(), ofB.end(), std::back_inserter(common));
    if (own.empty() || common.size() != own.size() ||
      (own.size() == 2 && this->isOnBoundary(a) && this->isOnBoundary(b)))
    {
      return false;
    }
    // Neither a triangle nor a tetrahedron on its own.
    if (common.size() == 1)
    {
      return !this->isBoundary(a, common[0]) || !this->isBoundary(b, common[0]);
    }
    const std::vector<int> across = this->trianglesOf(common[0], common[1]);
    return std::count_if(across.begin(), across.end(),
             [&](int t) { return this->cornerOf(t, a) >= 0 || this->cornerOf(t, b) >= 0; }) < 2;
  }

  /// Whether triangles with a height stay as they are turned if one of their vertices moves.
  bool canMove(int vertex, int to) const
  {
    return std::all_of(this->At[vertex].begin(), this->At[vertex].end(),
      [&](int t)
      {
        if (this->IsGone[t] || this->cornerOf(t, to) >= 0)
        {
          return true;
        }
        Corners moved = this->Triangles[t];
        if (this->heightOf(moved) < None || this->isTurned(moved))
        {
          return true;
        }
        moved[this->cornerOf(t, vertex)] = this->besideOf(to, moved);
        return !this->isTurned(moved);
      });
  }

  void contract(int gone, int to)
  {
    const auto found = this->Shared.find(gone);
    std::vector<int> all = found == this->Shared.end() ? std::vector<int>{ gone } : found->second;
    std::vector<int>& there = this->Shared.try_emplace(to, std::vector<int>{ to }).first->second;
    for (const int particle : all)
    {
      this->Vertices[particle] = to;
      this->Particles[particle].position = this->Particles[to].position;
      this->Particles[particle].location = this->Particles[to].location;
      this->Particles[particle].residual = this->Particles[to].residual;
      there.push_back(particle);
    }
    this->Shared.erase(gone);
    for (const int t : std::exchange(this->At[gone], {}))
    {
      const Corners& corners = this->Triangles[t];
      const bool isFlat = std::count_if(corners.begin(), corners.end(),
                            [&](int corner) { return this->Vertices[corner] == to; }) > 1;
      this->IsGone[t] = static_cast<char>(this->IsGone[t] || isFlat);
      this->At[to].push_back(t);
    }
  }

  /// \return whether there were any
  bool contractShortEdges()
  {
    std::vector<Edge> shortEdges;
    for (std::size_t n = 0; n < 3 * this->Triangles.size(); ++n)
    {
      const int a = this->vertex(static_cast<int>(n / 3), static_cast<int>(n % 3));
      const int b = this->vertex(static_cast<int>(n / 3), static_cast<int>(n % 3 + 1));
      const double length = glm::distance(this->position(a), this->position(b));
      const double spacing = std::min(this->Particles[a].spacing, this->Particles[b].spacing);
      if (!this->IsGone[n / 3] && length < None * spacing)
      {
        shortEdges.push_back({ length, std::min(a, b), std::max(a, b) });
      }
    }
    std::sort(shortEdges.begin(), shortEdges.end());
    bool isChanged = false;
    for (const Edge& edge : shortEdges)
    {
      const bool isWhole = this->Vertices[edge.a] == edge.a && this->Vertices[edge.b] == edge.b;
      if (!isWhole || !this->isContractible(edge.a, edge.b))
      {
        continue;
      }
      auto [to, gone] = std::pair(edge.a, edge.b);
      if (this->Edges.isOnEdge(gone) && !this->Edges.isOnEdge(to))
      {
        std::swap(to, gone);
      }
      if (this->canMove(gone, to))
      {
        this->contract(gone, to);
        isChanged = true;
      }
    }
    return isChanged;
  }

  /// The corner opposite to the longest edge.
  int cornerAcrossLongest(int triangle) const
  {
    const Corners& corners = this->Triangles[triangle];
    int across = 0;
    double longest = -1.0;
    for (int i = 0; i < 3; ++i)
    {
      const double length =
        glm::distance(this->position(corners[(i + 1) % 3]), this->position(corners[(i + 2) % 3]));
      if (length > longest)
      {
        across = i;
        longest = length;
      }
    }
    return across;
  }

  /// Gives the place of a triangle's longest edge to the one that crosses it; at the end of the mesh the triangle goes.
  bool flip(int triangle)
  {
    const int i = this->cornerAcrossLongest(triangle);
    const int a = this->vertex(triangle, i + 1), b = this->vertex(triangle, i + 2);
    const int c = this->vertex(triangle, i);
    std::vector<int> both = this->trianglesOf(a, b);
    both.erase(std::remove(both.begin(), both.end(), triangle), both.end());
    if (both.size() != 1)
    {
      const bool isEnd = both.empty() && !this->isOnBoundary(c);
      this->IsGone[triangle] = static_cast<char>(isEnd);
      return isEnd;
    }
    const int other = both[0];
    const int j = 3 - this->cornerOf(other, a) - this->cornerOf(other, b);
    const int d = this->vertex(other, j);
    const Corners own = this->Triangles[triangle], across = this->Triangles[other];
    const int ofA = across[this->cornerOf(other, a)], ofB = across[this->cornerOf(other, b)];
    const int ofC = this->besideOf(c, across), ofD = across[j];
    const Corners first{ ofC, ofA, ofD }, second{ ofC, ofD, ofB };
    if (c == d || !this->trianglesOf(c, d).empty() || !this->isBetter(own, across, first, second))
    {
      return false;
    }
    this->Triangles[triangle] = first;
    this->Triangles[other] = second;
    this->leave(b, triangle);
    this->leave(a, other);
    this->At[d].push_back(triangle);
    this->At[c].push_back(other);
    return true;
  }

  /// Whether two triangles with a short edge between them are better than two with a long one. Where all are flat, as
  /// where two curves have come to lie on each other, the shorter edge is.
  bool isBetter(
    const Corners& own, const Corners& across, const Corners& first, const Corners& second) const
  {
    const double lower = std::min(this->heightOf(first), this->heightOf(second));
    const bool isFlat = std::max(this->heightOf(first), this->heightOf(second)) < None &&
      this->heightOf(across) < None;
    const double before = glm::distance(this->position(first[1]), this->position(second[2]));
    const double after = glm::distance(this->position(first[0]), this->position(first[2]));
    return isFlat
      ? after < before
      : !this->isTurned(first) && !this->isTurned(second) && lower > this->heightOf(own);
  }

  void leave(int vertex, int triangle)
  {
    std::vector<int>& at = this->At[vertex];
    at.erase(std::remove(at.begin(), at.end(), triangle), at.end());
  }

  /// \return whether there were any
  bool flipLongEdges()
  {
    bool isChanged = false;
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      isChanged = (!this->IsGone[t] && this->heightOf(this->Triangles[t]) < None &&
                    this->flip(static_cast<int>(t))) ||
        isChanged;
    }
    return isChanged;
  }

  const ConstrainedEdges& Edges;
  Buffer<Particle>& Particles;
  std::vector<int>& Vertices;
  std::vector<Corners>& Triangles;
  std::vector<char> IsGone;
  /// By vertex: its triangles, those that are gone among them.
  std::vector<std::vector<int>> At;
  /// The particles of each place with several.
  std::map<int, std::vector<int>> Shared;
};

} // namespace

void removeSlivers(const ConstrainedEdges& edges, Buffer<Particle>& particles,
  std::vector<int>& vertices, std::vector<std::array<int, 3>>& triangles)
{
  SliverRemoval(edges, particles, vertices, triangles).remove();
}

} // namespace hop
