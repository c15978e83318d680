#include "Surface/WarmStart.h"

#include <algorithm>

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
  std::vector<Location> found;
  for (const CellPlace& place : places)
  {
    const auto element = std::lower_bound(mesh.elements.begin(), mesh.elements.end(), place.cell,
      [](const Element& e, std::int64_t cell) { return e.cell < cell; });
    if (element != mesh.elements.end() && element->cell == place.cell &&
      insideMargin(element->domain, place.u) >= 0.0)
    {
      found.push_back({ static_cast<int>(element - mesh.elements.begin()), place.u });
    }
  }
  return found;
}

} // namespace hop
