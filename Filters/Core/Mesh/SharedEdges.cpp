#include "Mesh/SharedEdges.h"

#include "Mesh/SurfaceBelow.h"
#include "Support/DisjointSets.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <tuple>

namespace hop
{
namespace
{

using Edge = std::array<int, 2>;

/// An edge that has a triangle to its left, between two places with several particles.
struct Joint
{
  int lowerPlace = 0, upperPlace = 0;
  int from = 0, to = 0;

  std::pair<int, int> places() const { return { this->lowerPlace, this->upperPlace }; }
};

/// In the order of their places, those between the same two places side by side.
std::vector<Joint> jointsOf(const std::vector<int>& places, const TriangleFans& fans)
{
  const std::vector<char> isShared = marksOfShared(places);
  std::vector<Joint> joints;
  for (std::size_t p = 0; p < places.size(); ++p)
  {
    const int from = static_cast<int>(p);
    const auto take = [&](const LinkEdge& edge)
    {
      if (isShared[edge.from])
      {
        const auto [lower, upper] = std::minmax(places[from], places[edge.from]);
        joints.push_back({ lower, upper, from, edge.from });
      }
    };
    if (isShared[p])
    {
      fans.visit(from, take);
    }
  }
  std::sort(joints.begin(), joints.end(),
    [](const Joint& a, const Joint& b)
    {
      return std::tie(a.lowerPlace, a.upperPlace, a.from, a.to) <
        std::tie(b.lowerPlace, b.upperPlace, b.from, b.to);
    });
  return joints;
}

/// The edges inside of a sheet that are to be split, of all between the same two places.
void findShared(
  const Joint* begin, const Joint* end, const TriangleFans& fans, std::vector<Edge>& shared)
{
  constexpr std::ptrdiff_t sides = 2;
  if (end - begin <= sides)
  {
    return;
  }
  const auto isInside = [&](const Joint& joint) { return fans.apexOf(joint.to, joint.from) >= 0; };
  bool mayKeep = std::all_of(begin, end, isInside);
  for (const Joint* joint = begin; joint != end; ++joint)
  {
    if (joint->from < joint->to && isInside(*joint))
    {
      if (!mayKeep)
      {
        shared.push_back({ joint->from, joint->to });
      }
      mayKeep = false;
    }
  }
}

/// Puts the last vertex between the two ends of an edge.
void split(const Edge& edge, TriangleFans& fans)
{
  const auto [a, b] = edge;
  const int middle = static_cast<int>(fans.vertexCount()) - 1;
  const int left = fans.apexOf(a, b);
  const int right = fans.apexOf(b, a);
  fans.remove({ a, b, left });
  fans.remove({ b, a, right });
  fans.add({ a, middle, left });
  fans.add({ middle, b, left });
  fans.add({ b, middle, right });
  fans.add({ middle, a, right });
}

/// Edges along boundary curves and creases between two particles in one place.
std::vector<Edge> edgesWithoutLength(const Distribution& distribution)
{
  // Distance that is none, in units of the spacing.
  constexpr double none = 1e-9;
  std::vector<Edge> found;
  for (const auto* list : { &distribution.edges.segments, &distribution.edges.directed })
  {
    std::copy_if(list->begin(), list->end(), std::back_inserter(found),
      [&](const Edge& edge)
      {
        const Particle& a = distribution.particles[edge[0]];
        const Particle& b = distribution.particles[edge[1]];
        return edge[0] != edge[1] && length(b.position - a.position) <= none * a.spacing;
      });
  }
  return found;
}

/// Where creases end in the midst of the surface: pairs of a particle at which the edges along one side end, and one in
/// the same place from which those along the other side begin.
std::vector<Edge> tipsOfCreases(const Distribution& distribution)
{
  // Least cosine between their normals: those of one sheet in a star.
  constexpr double sameSheet = 0.3;
  std::vector<int> surplus(distribution.particles.size(), 0);
  for (const auto& [from, to] : distribution.edges.directed)
  {
    --surplus[from];
    ++surplus[to];
  }
  std::vector<Edge> tips;
  for (const auto& [a, b] : distribution.edges.coincident)
  {
    if (surplus[a] * surplus[b] < 0 &&
      dot(distribution.particles[a].normal, distribution.particles[b].normal) > sameSheet)
    {
      tips.push_back({ a, b });
      surplus[a] = surplus[b] = 0;
    }
  }
  return tips;
}

} // namespace

std::vector<char> marksOfShared(const std::vector<int>& places)
{
  std::vector<char> isShared(places.size(), 0);
  for (std::size_t p = 0; p < places.size(); ++p)
  {
    if (places[p] != static_cast<int>(p))
    {
      isShared[p] = isShared[places[p]] = 1;
    }
  }
  return isShared;
}

void uniteEnds(Distribution& distribution)
{
  SurfaceEdges& edges = distribution.edges;
  const std::vector<Edge> pairs = edgesWithoutLength(distribution);
  const std::vector<Edge> tips = tipsOfCreases(distribution);
  if (pairs.empty() && tips.empty())
  {
    return;
  }
  DisjointSets places(distribution.particles.size());
  for (const auto* list : { &pairs, &tips })
  {
    for (const auto& [a, b] : *list)
    {
      places.unite(a, b);
    }
  }
  for (auto* list : { &edges.segments, &edges.directed })
  {
    for (Edge& edge : *list)
    {
      edge = { places.root(edge[0]), places.root(edge[1]) };
    }
  }
  edges.coincident.insert(edges.coincident.end(), pairs.begin(), pairs.end());
  for (int p = 0; p < static_cast<int>(distribution.particles.size()); ++p)
  {
    if (places.root(p) != p)
    {
      edges.replaced.push_back(p);
    }
  }
}

void splitSharedEdges(const Isosurface& surface, const std::vector<int>& places,
  Distribution& distribution, TriangleFans& fans, const ParallelFor& parallelFor)
{
  const std::vector<Joint> joints = jointsOf(places, fans);
  std::vector<Edge> shared;
  for (auto begin = joints.begin(); begin != joints.end();)
  {
    const auto end = std::find_if(
      begin, joints.end(), [&](const Joint& joint) { return joint.places() != begin->places(); });
    findShared(&*begin, &*begin + (end - begin), fans, shared);
    begin = end;
  }
  if (shared.empty())
  {
    return;
  }
  SurfaceBelow below(surface, parallelFor);
  for (const Edge& edge : shared)
  {
    const Particle& a = distribution.particles[edge[0]];
    const Particle& b = distribution.particles[edge[1]];
    const auto particle = below.particleBelow(
      0.5 * (a.position.xyz + b.position.xyz), a, 0.5 * (a.spacing + b.spacing));
    if (particle)
    {
      distribution.particles.push_back(Particle(*particle));
      fans.appendVertex();
      split(edge, fans);
    }
  }
}

} // namespace hop
