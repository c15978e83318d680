#include "Mesh/ManifoldVertices.h"

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

} // namespace

bool keepOneFan(const std::vector<int>& vertices, TriangleFans& fans)
{
  std::set<int> left(vertices.begin(), vertices.end());
  bool hasChanged = false;
  while (!left.empty())
  {
    const int vertex = *left.begin();
    left.erase(left.begin());
    std::vector<TriangleFans::Fan> all = fansAt(vertex, fans);
    if (all.size() < 2)
    {
      continue;
    }
    hasChanged = true;
    const auto kept = std::max_element(all.begin(), all.end(),
      [](const TriangleFans::Fan& a, const TriangleFans::Fan& b)
      { return a.size() < b.size() || (a.size() == b.size() && leastOf(a) > leastOf(b)); });
    for (auto fan = all.begin(); fan != all.end(); ++fan)
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

} // namespace hop
