#include "PointGrid.h"

#include <algorithm>

namespace hop::testing
{

PointGrid::PointGrid(std::vector<glm::dvec3> points, double cellSize)
  : Points(std::move(points))
  , CellSize(cellSize)
{
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    this->Cells[this->cellOf(this->Points[i])].push_back(static_cast<int>(i));
  }
}

std::size_t PointGrid::Hash::operator()(const Cell& cell) const
{
  // Large primes, after Teschner et al. 2003, Optimized Spatial Hashing.
  return static_cast<std::size_t>((cell.x * 73856093) ^ (cell.y * 19349663) ^ (cell.z * 83492791));
}

PointGrid::Cell PointGrid::cellOf(const glm::dvec3& place) const
{
  return Cell(glm::floor(place / this->CellSize));
}

std::vector<int> PointGrid::within(const glm::dvec3& place, double radius) const
{
  std::vector<int> found;
  const auto collect = [&](const std::vector<int>& indices)
  {
    for (const int i : indices)
    {
      if (glm::distance(this->Points[i], place) <= radius)
      {
        found.push_back(i);
      }
    }
  };
  const glm::dvec3 sides = glm::ceil(glm::dvec3(2.0 * radius / this->CellSize)) + 1.0;
  if (!(sides.x * sides.y * sides.z <= static_cast<double>(this->Cells.size())))
  {
    // There are fewer cells in all than the ball's bounding box holds.
    for (const auto& entry : this->Cells)
    {
      collect(entry.second);
    }
  }
  else
  {
    const Cell first = this->cellOf(place - radius);
    const Cell last = this->cellOf(place + radius);
    for (Cell cell = first; cell.z <= last.z; ++cell.z)
    {
      for (cell.y = first.y; cell.y <= last.y; ++cell.y)
      {
        for (cell.x = first.x; cell.x <= last.x; ++cell.x)
        {
          const auto entry = this->Cells.find(cell);
          if (entry != this->Cells.end())
          {
            collect(entry->second);
          }
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace hop::testing
