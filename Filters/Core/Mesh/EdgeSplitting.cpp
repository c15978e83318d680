#include "Mesh/EdgeSplitting.h"

#include "Edges/BoundaryChords.h"
#include "Mesh/TangentPlane.h"
#include "Support/SpacedPoints.h"
#include "Support/SpacingGrid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace hop
{
namespace
{

using Edge = std::array<int, 2>;

/// Distance from the boundary of the surface, as far as the particle knows of one; infinite if it does not.
double distanceFromBoundary(const Particle& particle)
{
  double least = std::numeric_limits<double>::infinity();
  for (const ClipPlane& plane : particle.clips)
  {
    least = plane.isBoundary() ? std::min(least, static_cast<double>(plane.distance)) : least;
  }
  return least;
}

/// When a particle stands on an edge, lengths in units of its spacing. Chosen by experiment.
struct OnEdge
{
  /// Largest distance from the boundary of a particle to the left of the chord, and from the chord. Larger: edges go back
  /// from the boundary; smaller: triangles there are turned away where the surface bends.
  static constexpr double Near = 0.05;
  /// Largest distance from the boundary, and to the right of the chord: how far curves bulge.
  static constexpr double Beyond = 0.3;
  /// Least cosine between the normals, as of neighbours in a star.
  static constexpr double Cosine = 0.3;
  /// Longest edge.
  static constexpr double Reach = 2.4;
};

class EdgeSplitter
{
public:
  EdgeSplitter(const Distribution& distribution, std::vector<Edge>& edges)
    : Particles(distribution.particles)
    , Pieces(distribution.pieces)
    , Edges(edges)
    , IsOnEdge(distribution.particles.size(), 0)
    , IsDouble(distribution.particles.size(), 0)
  {
    mark(edges, this->IsOnEdge);
    for (const int replaced : distribution.edges.replaced)
    {
      this->IsOnEdge[replaced] = 1;
    }
    mark(distribution.edges.coincident, this->IsDouble);
  }

  void run()
  {
    this->findCandidates();
    if (!this->Candidates.empty())
    {
      this->findEdges();
      this->split();
    }
  }

private:
  /// Where a particle stands.
  struct Place
  {
    double aside = std::numeric_limits<double>::infinity();
    Edge edge{ -1, -1 };
    /// Share of the way along the edge.
    double share = 0.0;
  };

  static void mark(const std::vector<Edge>& pairs, std::vector<char>& marks)
  {
    for (const auto& [a, b] : pairs)
    {
      marks[a] = marks[b] = 1;
    }
  }

  void findCandidates()
  {
    for (std::size_t i = 0; i < this->Particles.size(); ++i)
    {
      const Particle& particle = this->Particles[i];
      if (!this->IsOnEdge[i] && distanceFromBoundary(particle) <= OnEdge::Beyond * particle.spacing)
      {
        this->Candidates.push_back(static_cast<int>(i));
      }
    }
  }

  bool mayBeSplit(const Edge& edge) const
  {
    return !(this->IsDouble[edge[0]] && this->IsDouble[edge[1]]) &&
      !std::binary_search(this->Edges.begin(), this->Edges.end(), Edge{ edge[1], edge[0] });
  }

  void findEdges()
  {
    this->Places.resize(this->Candidates.size());
    const auto particleAt = [this](std::size_t c) -> const Particle&
    { return this->Particles[this->Candidates[c]]; };
    const SpacedPoints points(
      this->Candidates.size(), [&](std::size_t c) { return particleAt(c).position.xyz; },
      [&](std::size_t c) { return particleAt(c).spacing; }, {});
    const SpacingGrid grid(points.positions, points.spacings, OnEdge::Reach);
    for (const Edge& edge : this->Edges)
    {
      if (this->mayBeSplit(edge))
      {
        const Particle& first = this->Particles[edge[0]];
        grid.visit(first.position.xyz, first.spacing, [&](int c) { this->offer(c, edge); });
      }
    }
  }

  /// Takes the edge for a candidate if it is the nearest so far.
  void offer(int candidate, const Edge& edge)
  {
    const Particle& here = this->Particles[this->Candidates[candidate]];
    const Particle& first = this->Particles[edge[0]];
    const Particle& last = this->Particles[edge[1]];
    if (std::min(dot(here.normal, first.normal), dot(here.normal, last.normal)) < OnEdge::Cosine ||
      !this->Pieces.areSame(here.location, first.location))
    {
      return;
    }
    const TangentPlane plane(here.position.xyz, glm::vec3(here.normal.xyz), here.spacing);
    const glm::dvec2 start = plane.flat(first.position.xyz);
    const glm::dvec2 along = plane.flat(last.position.xyz) - start;
    const double length = glm::length(along);
    const double share = glm::dot(-start, along) / (length * length);
    const double left = crossOf(along, -start) / length;
    const double most =
      distanceFromBoundary(here) <= OnEdge::Near * here.spacing ? OnEdge::Near : 0.0;
    const bool isOn = share > 0.0 && share < 1.0 && length <= OnEdge::Reach && left <= most &&
      left >= -OnEdge::Beyond;
    if (isOn && std::abs(left) < this->Places[candidate].aside)
    {
      this->Places[candidate] = { std::abs(left), edge, share };
    }
  }

  void split()
  {
    std::map<Edge, std::vector<std::pair<double, int>>> passed;
    for (std::size_t c = 0; c < this->Candidates.size(); ++c)
    {
      if (this->Places[c].edge[0] >= 0)
      {
        passed[this->Places[c].edge].emplace_back(this->Places[c].share, this->Candidates[c]);
      }
    }
    const auto isSplit = [&](const Edge& edge) { return passed.count(edge) > 0; };
    this->Edges.erase(
      std::remove_if(this->Edges.begin(), this->Edges.end(), isSplit), this->Edges.end());
    for (auto& [edge, particles] : passed)
    {
      std::sort(particles.begin(), particles.end());
      int before = edge[0];
      for (const auto& [share, particle] : particles)
      {
        this->Edges.push_back({ before, particle });
        before = particle;
      }
      this->Edges.push_back({ before, edge[1] });
    }
    std::sort(this->Edges.begin(), this->Edges.end());
  }

  const Buffer<Particle>& Particles;
  const SurfacePieces& Pieces;
  std::vector<Edge>& Edges;
  /// By particle: whether it, or the one that replaces it, is on an edge, and whether there is another one in its place.
  std::vector<char> IsOnEdge, IsDouble;
  std::vector<int> Candidates;
  /// By candidate.
  std::vector<Place> Places;
};

/// Whether two other edges lead the same way over a particle that is on the edge.
bool isShortcut(const Buffer<Particle>& particles, const std::vector<Edge>& edges, const Edge& edge)
{
  const auto has = [&edges](int from, int to) {
    return std::binary_search(edges.begin(), edges.end(), Edge{ from, to });
  };
  const auto [from, to] = edge;
  const glm::dvec3& start = particles[from].position.xyz;
  const glm::dvec3& end = particles[to].position.xyz;
  for (auto first = std::lower_bound(edges.begin(), edges.end(), Edge{ from, 0 });
       first != edges.end() && (*first)[0] == from; ++first)
  {
    const Particle& over = particles[(*first)[1]];
    if ((*first)[1] != to && has((*first)[1], to) && !has(to, from) &&
      distanceToSegment(over.position.xyz, start, end) <= OnEdge::Near * over.spacing)
    {
      return true;
    }
  }
  return false;
}

/// Drops such edges: where a strip is narrower than its particles can tell, the other side's curve has lost some of its
/// own, and leads over them.
void dropShortcuts(const Buffer<Particle>& particles, std::vector<Edge>& edges)
{
  std::vector<Edge> kept;
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(kept),
    [&](const Edge& edge) { return !isShortcut(particles, edges, edge); });
  edges = std::move(kept);
}

} // namespace

void splitAtParticles(const Distribution& distribution, std::vector<Edge>& edges)
{
  if (!edges.empty())
  {
    EdgeSplitter(distribution, edges).run();
    dropShortcuts(distribution.particles, edges);
  }
}

} // namespace hop
