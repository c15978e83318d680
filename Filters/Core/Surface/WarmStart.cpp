#include "Surface/WarmStart.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hop
{

namespace
{

/// The elements in the order of their cells.
std::vector<int> elementsByCell(const ElementMesh& mesh)
{
  std::vector<int> byCell(mesh.elements.size());
  std::iota(byCell.begin(), byCell.end(), 0);
  std::sort(byCell.begin(), byCell.end(),
    [&](int a, int b)
    { return std::pair(mesh.elements[a].cell, a) < std::pair(mesh.elements[b].cell, b); });
  return byCell;
}

/// Of each element how many others of its cell come before it.
std::vector<int> numbersInCells(const ElementMesh& mesh)
{
  std::vector<int> numbers(mesh.elements.size(), 0);
  const std::vector<int> byCell = elementsByCell(mesh);
  for (std::size_t i = 1; i < byCell.size(); ++i)
  {
    const bool isSame = mesh.elements[byCell[i]].cell == mesh.elements[byCell[i - 1]].cell;
    numbers[byCell[i]] = isSame ? numbers[byCell[i - 1]] + 1 : 0;
  }
  return numbers;
}

} // namespace

Buffer<CellPlace> cellPlaces(
  const ElementMesh& mesh, const Buffer<Particle>& particles, const ParallelFor& parallelFor)
{
  const std::vector<int> numbers = numbersInCells(mesh);
  Buffer<CellPlace> places(particles.size());
  forAll(parallelFor, particles.size(),
    [&](std::size_t i)
    {
      const Particle& particle = particles[i];
      const bool onBoundary = particle.clips[0].isBoundary() && particle.clips[0].distance == 0.0;
      const int element = particle.location.element;
      places[i] = { onBoundary ? -1 : mesh.elements[element].cell, numbers[element],
        particle.location.u };
    });
  places.erase(std::remove_if(places.begin(), places.end(),
                 [](const CellPlace& place) { return place.cell < 0; }),
    places.end());
  return places;
}

std::vector<Location> findPlaces(const ElementMesh& mesh, const Buffer<CellPlace>& places)
{
  const auto cellOf = [&](int element) { return mesh.elements[element].cell; };
  const std::vector<int> byCell = elementsByCell(mesh);
  std::vector<Location> found;
  for (const CellPlace& place : places)
  {
    auto element = std::lower_bound(byCell.begin(), byCell.end(), place.cell,
      [&](int e, std::int64_t cell) { return cellOf(e) < cell; });
    element += std::min<std::ptrdiff_t>(place.ofCell, byCell.end() - element);
    if (element != byCell.end() && cellOf(*element) == place.cell &&
      insideMargin(mesh.elements[*element].domain, place.u) >= 0.0)
    {
      found.push_back({ *element, place.u });
    }
  }
  return found;
}

} // namespace hop
