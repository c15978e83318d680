#pragma once

#include <glm/glm.hpp>

#include <unordered_map>
#include <vector>

namespace hop::testing
{

/// Points sorted into cubic cells, for searches around a place. It shares no code with the grids of the distributions,
/// so that measures do not repeat their mistakes.
class PointGrid
{
public:
  /// \param cellSize > 0; queries cost least at about their radius
  PointGrid(std::vector<glm::dvec3> points, double cellSize);

  /// Indices of the points within `radius` of a place, ascending.
  std::vector<int> within(const glm::dvec3& place, double radius) const;

private:
  using Cell = glm::i64vec3;
  struct Hash
  {
    std::size_t operator()(const Cell& cell) const;
  };

  Cell cellOf(const glm::dvec3& place) const;

  std::vector<glm::dvec3> Points;
  double CellSize;
  std::unordered_map<Cell, std::vector<int>, Hash> Cells;
};

} // namespace hop::testing
