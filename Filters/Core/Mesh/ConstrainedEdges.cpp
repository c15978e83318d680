#include "Mesh/ConstrainedEdges.h"

#include "Mesh/EdgeChains.h"
#include "Mesh/EdgeSplitting.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hop
{
namespace
{

struct SideOfSegment
{
  /// Largest distance of the plane of an edge that a particle on the edge has, in units of its spacing: zero but for
  /// rounding. Larger: planes of other edges nearby count as well.
  static constexpr double AtEdge = 0.05;
  /// Sine of the least angle between a segment and the planes' normals, summed up over both ends, at which they tell
  /// the side; chosen by experiment.
  static constexpr double Clear = 0.2;
};

/// On which side of a segment the surface ends, as one of its particles knows: positive, to the left; negative, to the
/// right. At the tip of a slit or of a strip the particle knows of both sides, and the sum is about zero.
double endsToTheLeft(const Particle& particle, const glm::dvec3& left)
{
  double sum = 0.0;
  for (const ClipPlane& plane : particle.clips)
  {
    if (plane.distance <= SideOfSegment::AtEdge * particle.spacing)
    {
      sum += glm::dot(plane.normal.xyz, left);
    }
  }
  return sum;
}

/// Calls use(edge) for a segment, directed so that the surface is to its left.
template <class Use>
void direct(const Buffer<Particle>& particles, const std::array<int, 2>& segment, const Use& use)
{
  const auto [a, b] = segment;
  const Particle& first = particles[a];
  const Particle& second = particles[b];
  const glm::dvec3 along = (second.position - first.position).xyz;
  const glm::dvec3 across = glm::cross(first.normal.xyz + second.normal.xyz, along);
  const double length = glm::length(across);
  const glm::dvec3 left = length > 0.0 ? across / length : across;
  const double ends = endsToTheLeft(first, left) + endsToTheLeft(second, left);
  if (ends < SideOfSegment::Clear)
  {
    use(std::array<int, 2>{ a, b });
  }
  if (ends > -SideOfSegment::Clear)
  {
    use(std::array<int, 2>{ b, a });
  }
}

} // namespace

ConstrainedEdges::ConstrainedEdges(const Distribution& distribution)
{
  // A curve shorter than a spacing may have one particle, and lead from it to itself.
  std::vector<Edge> edges;
  std::copy_if(distribution.edges.directed.begin(), distribution.edges.directed.end(),
    std::back_inserter(edges), [](const Edge& edge) { return edge[0] != edge[1]; });
  std::sort(edges.begin(), edges.end());
  const auto isDirected = [known = edges](const Edge& segment)
  {
    return std::binary_search(known.begin(), known.end(), segment) ||
      std::binary_search(known.begin(), known.end(), Edge{ segment[1], segment[0] });
  };
  for (const Edge& segment : distribution.edges.segments)
  {
    if (segment[0] != segment[1] && !isDirected(segment))
    {
      direct(distribution.particles, segment, [&](const Edge& edge) { edges.push_back(edge); });
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  closeChains(distribution, edges);
  splitAtParticles(distribution, edges);
  this->set(edges, distribution.particles.size());
}

/// \param edges sorted
void ConstrainedEdges::set(const std::vector<Edge>& edges, std::size_t particleCount)
{
  this->Next = {};
  this->Previous = {};
  this->IsOnEdge.clear();
  if (!edges.empty())
  {
    this->IsOnEdge.assign(particleCount, 0);
    for (const auto& [from, to] : edges)
    {
      this->IsOnEdge[from] = this->IsOnEdge[to] = 1;
    }
    this->Next = EdgeLinks(edges, EdgeLinks::By::Beginning, particleCount);
    this->Previous = EdgeLinks(edges, EdgeLinks::By::End, particleCount);
  }
}

void ConstrainedEdges::change(
  const std::set<Edge>& removed, const std::set<Edge>& added, std::size_t particleCount)
{
  std::vector<Edge> edges(added.begin(), added.end());
  for (int particle = 0; particle < static_cast<int>(this->IsOnEdge.size()); ++particle)
  {
    for (const int next : this->after(particle))
    {
      if (removed.count({ particle, next }) == 0)
      {
        edges.push_back({ particle, next });
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  this->set(edges, particleCount);
}

bool ConstrainedEdges::has(int a, int b) const
{
  const Span<int> next = this->after(a);
  return std::find(next.begin(), next.end(), b) != next.end();
}

} // namespace hop
