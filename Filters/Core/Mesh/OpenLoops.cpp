#include "Mesh/OpenLoops.h"

#include "Mesh/TangentPlane.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hop
{
namespace
{

/// Ends of the edges that begin at a particle and lack a triangle to their left, ascending.
std::vector<int> openEdgesOf(int particle, const ConstrainedEdges& edges, const TriangleFans& fans)
{
  std::vector<int> ends;
  if (edges.after(particle).empty() && fans.isRing(particle))
  {
    return ends;
  }
  // The triangle to the right of an edge sees the edge's end as the end of the edge opposite to the particle.
  fans.visit(particle,
    [&](const LinkEdge& edge)
    {
      const bool endsHere = edges.has(edge.to, particle) && !edges.has(particle, edge.to);
      if (!endsHere && fans.apexOf(particle, edge.to) < 0)
      {
        ends.push_back(edge.to);
      }
    });
  for (const int next : edges.after(particle))
  {
    if (fans.apexOf(particle, next) < 0)
    {
      ends.push_back(next);
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

/// Whether a row of edges leads along edges of which the particles do not tell on which side the surface is: it ends on
/// the side that has no triangles.
bool isAlongSlit(const OpenLoop& loop, const ConstrainedEdges& edges)
{
  for (std::size_t n = 0; n < loop.edgeCount(); ++n)
  {
    const int a = loop.particles[n];
    const int b = loop.particles[n + 1];
    if (!edges.has(a, b) || !edges.has(b, a))
    {
      return false;
    }
  }
  return true;
}

/// Whether a closed loop follows each of its edges in both directions, as around strips without width.
bool leadsThereAndBack(const Buffer<Particle>& particles, const OpenLoop& loop)
{
  const auto placeOf = [&](std::size_t n)
  {
    return *std::find_if(loop.particles.begin(), loop.particles.end(),
      [&](int particle)
      { return particles[particle].position.xyz == particles[loop.particles[n]].position.xyz; });
  };
  std::set<std::array<int, 2>> edges;
  for (std::size_t n = 0; n < loop.edgeCount(); ++n)
  {
    edges.insert({ placeOf(n), placeOf((n + 1) % loop.particles.size()) });
  }
  return std::all_of(edges.begin(), edges.end(),
    [&](const std::array<int, 2>& edge) {
      return edges.count({ edge[1], edge[0] }) > 0;
    });
}

/// Joins edges to loops.
class LoopWalker
{
public:
  explicit LoopWalker(const Buffer<Particle>& particles)
    : Particles(particles)
  {
  }

  void add(int particle, std::vector<int> ends) { this->Ends.emplace(particle, std::move(ends)); }

  std::vector<OpenLoop> walk()
  {
    // Where edges do not close, a loop begins at an edge that nothing leads to.
    std::map<int, int> arriving;
    for (const auto& [particle, ends] : this->Ends)
    {
      for (const int end : ends)
      {
        ++arriving[end];
      }
    }
    std::vector<OpenLoop> loops;
    for (const auto& [particle, ends] : this->Ends)
    {
      const auto arrived = arriving.find(particle);
      const int there = arrived == arriving.end() ? 0 : arrived->second;
      for (int surplus = static_cast<int>(ends.size()) - there; surplus > 0; --surplus)
      {
        loops.push_back(this->walkFrom(particle));
      }
    }
    for (const auto& [particle, ends] : this->Ends)
    {
      while (!ends.empty())
      {
        loops.push_back(this->walkFrom(particle));
      }
    }
    return loops;
  }

private:
  OpenLoop walkFrom(int start)
  {
    OpenLoop loop;
    int before = -1;
    int at = start;
    do
    {
      loop.particles.push_back(at);
      const auto next = this->Ends.find(at);
      if (next == this->Ends.end() || next->second.empty())
      {
        loop.isClosed = false;
        break;
      }
      const auto end = this->choose(before, at, next->second);
      before = at;
      at = *end;
      next->second.erase(end);
    } while (at != start);
    return loop;
  }

  /// Of several edges, the next one clockwise from the edge by which the loop has come: what lies between them is open.
  std::vector<int>::iterator choose(int before, int at, std::vector<int>& ends) const
  {
    if (before < 0 || ends.size() == 1)
    {
      return ends.begin();
    }
    const Particle& here = this->Particles[at];
    const TangentPlane plane(here.position.xyz, glm::vec3(here.normal.xyz), here.spacing);
    const glm::dvec2 back = plane.flat(this->Particles[before].position.xyz);
    const auto turn = [&](int end)
    { return turnAround(plane.flat(this->Particles[end].position.xyz), back); };
    return std::min_element(
      ends.begin(), ends.end(), [&](int a, int b) { return turn(a) < turn(b); });
  }

  const Buffer<Particle>& Particles;
  std::map<int, std::vector<int>> Ends;
};

/// Takes a part of a loop that begins and ends at the same particle, if this part and the rest are holes.
std::optional<std::vector<int>> takePinched(
  const Buffer<Particle>& particles, std::vector<int>& loop)
{
  for (auto last = loop.begin(); last != loop.end(); ++last)
  {
    const auto first = std::find(loop.begin(), last, *last);
    std::vector<int> part(first, last);
    std::vector<int> rest(loop.begin(), first);
    rest.insert(rest.end(), last, loop.end());
    if (part.size() >= 3 && rest.size() >= 3 && areaInside(particles, part) > 0.0 &&
      areaInside(particles, rest) > 0.0)
    {
      loop = std::move(rest);
      return part;
    }
  }
  return std::nullopt;
}

} // namespace

double areaInside(const Buffer<Particle>& particles, const std::vector<int>& loop)
{
  const auto at = [&](int particle) { return particles[particle].position.xyz; };
  glm::dvec3 area(0.0), normal(0.0);
  for (std::size_t n = 0; n < loop.size(); ++n)
  {
    const glm::dvec3 a = at(loop[n]) - at(loop[0]);
    const glm::dvec3 b = at(loop[n + 1 < loop.size() ? n + 1 : 0]) - at(loop[0]);
    area += glm::cross(a, b);
    normal += particles[loop[n]].normal.xyz;
  }
  return glm::dot(area, normal);
}

void cutAtPinches(const Buffer<Particle>& particles, std::vector<OpenLoop>& loops)
{
  for (std::size_t n = 0; n < loops.size(); ++n)
  {
    while (loops[n].isClosed)
    {
      auto part = takePinched(particles, loops[n].particles);
      if (!part)
      {
        break;
      }
      loops.push_back({ std::move(*part), true });
    }
  }
}

bool isAlongEnds(const ElementMesh& mesh, const Distribution& distribution, const OpenLoop& loop,
  const ConstrainedEdges& edges)
{
  const auto placeOf = [&](int particle) -> const Location&
  { return distribution.particles[particle].location; };
  bool areConstrained = true;
  for (std::size_t n = 0; n < loop.edgeCount(); ++n)
  {
    const int a = loop.particles[n];
    const int b = loop.particles[(n + 1) % loop.particles.size()];
    const bool isConstrained = edges.joins(a, b);
    if (!isConstrained && !distribution.pieces.areOnEnd(mesh, placeOf(a), placeOf(b)))
    {
      return false;
    }
    areConstrained = areConstrained && isConstrained;
  }
  return !areConstrained;
}

std::vector<OpenLoop> findOpenLoops(const Buffer<Particle>& particles,
  const ConstrainedEdges& edges, const TriangleFans& fans, const ParallelFor& parallelFor)
{
  std::vector<char> isOpen(particles.size());
  forAll(parallelFor, particles.size(),
    [&](std::size_t i) { isOpen[i] = !openEdgesOf(static_cast<int>(i), edges, fans).empty(); });
  LoopWalker walker(particles);
  for (const int particle : markedIndices(isOpen, particles.size()))
  {
    walker.add(particle, openEdgesOf(particle, edges, fans));
  }
  std::vector<OpenLoop> loops = walker.walk();
  const auto enclosesNothing = [&](const OpenLoop& loop)
  { return loop.isClosed ? leadsThereAndBack(particles, loop) : isAlongSlit(loop, edges); };
  loops.erase(std::remove_if(loops.begin(), loops.end(), enclosesNothing), loops.end());
  return loops;
}

} // namespace hop
