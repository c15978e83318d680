#include "WarmStart.h"

#include <algorithm>

namespace hop
{

std::vector<CellPlace> cellPlaces(const ElementMesh& mesh, const Buffer<Particle>& particles)
{
  std::vector<CellPlace> places;
  places.reserve(particles.size());
  for (const Particle& particle : particles)
  {
    const bool onRim = particle.clips[0].exists() && particle.clips[0].distance == 0.0;
    if (!onRim)
    {
      places.push_back({ mesh.elements[particle.location.element].cell, particle.location.u });
    }
  }
  return places;
}

std::vector<Location> findPlaces(const ElementMesh& mesh, const std::vector<CellPlace>& places)
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
