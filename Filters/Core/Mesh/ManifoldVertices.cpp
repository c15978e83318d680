#include "Mesh/ManifoldVertices.h"

#include "Mesh/SharedEdges.h"
#include "Support/KeepMarked.h"

#include <set>

namespace hop
{
namespace
{

/// The triangles of a vertex, fan by fan: each follows the one before it counterclockwise.
std::vector<TriangleFans::Fan> fansAt(int vertex, const TriangleFans& fans)
{
  TriangleFans::Fan rest;
  fans.visit(vertex, [&](const LinkEdge& edge) { rest.push_back(edge); });
  const auto take = [&](const auto& isWanted)
  {
    const auto found = std::find_if(rest.begin(), rest.end(), isWanted);
    LinkEdge edge;
    if (found != rest.end())
    {
      edge = *found;
      rest.erase(found);
    }
    return edge;
  };
  std::vector<TriangleFans::Fan> result;
  while (!rest.empty())
  {
    TriangleFans::Fan fan;
    LinkEdge next = rest.front();
    // From an end of the fan, if it has one.
    for (const LinkEdge& edge : rest)
    {
      if (std::none_of(
            rest.begin(), rest.end(), [&](const LinkEdge& other) { return other.to == edge.from; }))
      {
        next = edge;
        break;
      }
    }
    next = take([&](const LinkEdge& edge) { return edge.from == next.from; });
    while (next.from >= 0)
    {
      fan.push_back(next);
      next = take([&](const LinkEdge& edge) { return edge.from == fan.back().to; });
    }
    result.push_back(std::move(fan));
  }
  return result;
}

int leastOf(const TriangleFans::Fan& fan)
{
  int least = fan.front().from;
  for (const LinkEdge& edge : fan)
  {
    least = std::min({ least, edge.from, edge.to });
  }
  return least;
}

bool hasSeveralFans(int vertex, const TriangleFans& fans)
{
  int count = 0;
  LinkEdge first;
  fans.visit(vertex,
    [&](const LinkEdge& edge)
    {
      const bool isFirst = count == 0 || fans.apexOf(edge.from, vertex) < 0;
      first = isFirst ? edge : first;
      ++count;
    });
  // Counterclockwise from an end of the fan, if it has one.
  int reached = 0;
  for (int next = first.to; reached < count && next >= 0; ++reached)
  {
    next = next == first.from ? -1 : fans.apexOf(vertex, next);
  }
  return reached < count;
}

/// The one that stays of several fans.
std::vector<TriangleFans::Fan>::const_iterator largestOf(const std::vector<TriangleFans::Fan>& fans)
{
  return std::max_element(fans.begin(), fans.end(),
    [](const TriangleFans::Fan& a, const TriangleFans::Fan& b)
    { return a.size() < b.size() || (a.size() == b.size() && leastOf(a) > leastOf(b)); });
}

std::vector<int> verticesWithSeveralFans(const TriangleFans& fans, const ParallelFor& parallelFor)
{
  std::vector<char> isTouched(fans.vertexCount(), 0);
  forAll(parallelFor, isTouched.size(),
    [&](std::size_t vertex)
    {
      const int v = static_cast<int>(vertex);
      isTouched[vertex] = !fans.isRing(v) && hasSeveralFans(v, fans) ? 1 : 0;
    });
  return markedIndices(isTouched, isTouched.size());
}

/// Constrained edges that are exchanged one by one, and written all at once.
class ChangedEdges
{
public:
  explicit ChangedEdges(const ConstrainedEdges& edges)
    : Edges(edges)
  {
  }

  bool has(const ConstrainedEdges::Edge& edge) const
  {
    return this->Added.count(edge) > 0 ||
      (this->Edges.has(edge[0], edge[1]) && this->Removed.count(edge) == 0);
  }

  /// \pre the first edge is there
  void replace(const ConstrainedEdges::Edge& edge, const ConstrainedEdges::Edge& by)
  {
    if (this->Added.erase(edge) == 0)
    {
      this->Removed.insert(edge);
    }
    this->Added.insert(by);
  }

  void writeTo(ConstrainedEdges& edges, std::size_t particleCount) const
  {
    if (!this->Added.empty())
    {
      edges.change(this->Removed, this->Added, particleCount);
    }
  }

private:
  const ConstrainedEdges& Edges;
  std::set<ConstrainedEdges::Edge> Removed, Added;
};

/// Moves a fan of triangles, and the edges at which it begins and ends, from one vertex to another.
void moveFan(
  const TriangleFans::Fan& fan, int from, int to, ChangedEdges& edges, TriangleFans& fans)
{
  for (const LinkEdge& edge : fan)
  {
    fans.remove({ from, edge.from, edge.to });
    fans.add({ to, edge.from, edge.to });
  }
  const int begin = fan.front().from;
  const int end = fan.back().to;
  edges.replace({ from, begin }, { to, begin });
  edges.replace({ end, from }, { end, to });
}

/// \return whether triangles were removed
bool keepOneFanAt(const std::vector<int>& vertices, TriangleFans& fans)
{
  std::set<int> left(vertices.begin(), vertices.end());
  bool hasChanged = false;
  while (!left.empty())
  {
    const int vertex = *left.begin();
    left.erase(left.begin());
    const std::vector<TriangleFans::Fan> all = fansAt(vertex, fans);
    if (all.size() < 2)
    {
      continue;
    }
    hasChanged = true;
    const auto kept = largestOf(all);
    for (auto fan = all.cbegin(); fan != all.cend(); ++fan)
    {
      for (std::size_t n = 0; fan != kept && n < fan->size(); ++n)
      {
        fans.remove({ vertex, (*fan)[n].from, (*fan)[n].to });
        // Its other corners may have come to touch two fans.
        left.insert({ (*fan)[n].from, (*fan)[n].to });
      }
    }
  }
  return hasChanged;
}

/// A mesh in which particles in one place are one vertex.
class WeldedFans
{
public:
  explicit WeldedFans(const std::vector<int>& places)
    : Places(places)
    , Fans(
        places.size(), {}, []() { return 0; }, [](int, TriangleFans::Fan&, int&) {})
  {
  }

  /// \return whether the triangle has been added: it has three corners, and nothing is where it is to be
  bool add(const Triangle& triangle)
  {
    const Triangle at = this->weld(triangle);
    const auto isTaken = [&](int a, int b) { return a == b || this->Fans.apexOf(a, b) >= 0; };
    const bool fits = !isTaken(at[0], at[1]) && !isTaken(at[1], at[2]) && !isTaken(at[2], at[0]);
    if (fits)
    {
      this->Fans.add(at);
    }
    return fits;
  }

  bool keepOneFanAt(const std::vector<int>& vertices)
  {
    return hop::keepOneFanAt(vertices, this->Fans);
  }

  void keepOneFan(const ParallelFor& parallelFor) { hop::keepOneFan(this->Fans, parallelFor); }

  bool has(const Triangle& triangle) const
  {
    const Triangle at = this->weld(triangle);
    return this->Fans.apexOf(at[0], at[1]) == at[2];
  }

private:
  Triangle weld(const Triangle& triangle) const
  {
    return { this->Places[triangle[0]], this->Places[triangle[1]], this->Places[triangle[2]] };
  }

  const std::vector<int>& Places;
  TriangleFans Fans;
};

/// Looks only at the triangles around places with several particles: nearly all meshes are sound.
bool isManifold(const std::vector<int>& places, const std::vector<Triangle>& triangles)
{
  const std::vector<char> isShared = marksOfShared(places);
  WeldedFans welded(places);
  std::set<int> vertices;
  for (const Triangle& triangle : triangles)
  {
    bool touches = false;
    for (const int corner : triangle)
    {
      if (isShared[corner])
      {
        touches = true;
        vertices.insert(places[corner]);
      }
    }
    if (touches && !welded.add(triangle))
    {
      return false;
    }
  }
  return !welded.keepOneFanAt({ vertices.begin(), vertices.end() });
}

} // namespace

std::vector<std::array<int, 2>> splitFans(ConstrainedEdges& edges, Buffer<Particle>& particles,
  TriangleFans& fans, const ParallelFor& parallelFor)
{
  std::vector<std::array<int, 2>> copies;
  ChangedEdges changed(edges);
  for (const int vertex : verticesWithSeveralFans(fans, parallelFor))
  {
    const std::vector<TriangleFans::Fan> all = fansAt(vertex, fans);
    const auto kept = largestOf(all);
    for (auto fan = all.cbegin(); fan != all.cend(); ++fan)
    {
      if (fan != kept && changed.has({ vertex, fan->front().from }) &&
        changed.has({ fan->back().to, vertex }))
      {
        const int copy = static_cast<int>(particles.size());
        particles.push_back(Particle(particles[vertex]));
        fans.appendVertex();
        moveFan(*fan, vertex, copy, changed, fans);
        copies.push_back({ vertex, copy });
      }
    }
  }
  changed.writeTo(edges, fans.vertexCount());
  return copies;
}

bool keepOneFan(TriangleFans& fans, const ParallelFor& parallelFor)
{
  return keepOneFanAt(verticesWithSeveralFans(fans, parallelFor), fans);
}

std::vector<Triangle> keepManifold(
  const std::vector<int>& places, TriangleFans& fans, const ParallelFor& parallelFor)
{
  std::vector<Triangle> triangles = fans.triangles(parallelFor);
  if (isManifold(places, triangles))
  {
    return triangles;
  }
  WeldedFans welded(places);
  std::vector<char> isAdded;
  isAdded.reserve(triangles.size());
  for (const Triangle& triangle : triangles)
  {
    isAdded.push_back(welded.add(triangle) ? 1 : 0);
  }
  welded.keepOneFan(parallelFor);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (!isAdded[t] || !welded.has(triangles[t]))
    {
      fans.remove(triangles[t]);
    }
  }
  return fans.triangles(parallelFor);
}

} // namespace hop
