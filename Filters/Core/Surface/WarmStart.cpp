#include "Surface/WarmStart.h"

#include <algorithm>
#include <numeric>

namespace hop
{

Buffer<CellPlace> cellPlaces(
  const ElementMesh& mesh, const Buffer<Particle>& particles, const ParallelFor& parallelFor)
{
  Buffer<CellPlace> places(particles.size());
  forAll(parallelFor, particles.size(),
    [&](std::size_t i)
    {
      const Particle& particle = particles[i];
      const bool onBoundary = particle.clips[0].isBoundary() && particle.clips[0].distance == 0.0;
      const std::int64_t cell = mesh.elements[particle.location.element].cell;
      places[i] = { onBoundary ? -1 : cell, particle.location.u };
    });
  places.erase(std::remove_if(places.begin(), places.end(),
                 [](const CellPlace& place) { return place.cell < 0; }),
    places.end());
  return places;
}

std::vector<Location> findPlaces(const ElementMesh& mesh, const Buffer<CellPlace>& places)
{
  const auto cellOf = [&](int element) { return mesh.elements[element].cell; };
  std::vector<int> byCell(mesh.elements.size());
  std::iota(byCell.begin(), byCell.end(), 0);
  std::sort(byCell.begin(), byCell.end(), [&](int a, int b) { return cellOf(a) < cellOf(b); });
  std::vector<Location> found;
  for (const CellPlace& place : places)
  {
    const auto element = std::lower_bound(byCell.begin(), byCell.end(), place.cell,
      [&](int e, std::int64_t cell) { return cellOf(e) < cell; });
    if (element != byCell.end() && cellOf(*element) == place.cell &&
      insideMargin(mesh.elements[*element].domain, place.u) >= 0.0)
    {
      found.push_back({ *element, place.u });
    }
  }
  return found;
}

} // namespace hop
