#include "Surface/SurfaceEdges.h"

#include "Support/DisjointSets.h"

namespace hop
{

std::vector<int> firstInPlace(const SurfaceEdges& edges, std::size_t particles)
{
  DisjointSets places(particles);
  for (const auto& [a, b] : edges.coincident)
  {
    places.unite(a, b);
  }
  std::vector<int> first(particles);
  for (std::size_t p = 0; p < particles; ++p)
  {
    first[p] = places.root(static_cast<int>(p));
  }
  return first;
}

} // namespace hop
