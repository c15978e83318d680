#pragma once

#include "Kernel/Kernels.h"
#include "Support/SpacingGrid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hop
{

/// Finds what points see, one cell of a grid after the other: the points around a cell are gathered once for all points
/// in it. Each thread needs one of its own.
class SeenPoints
{
public:
  /// \param inverseSpacings 1/h
  /// \param reach of the grid: two points see each other within this times the harmonic mean of their spacings
  /// \pre the grid and its points outlive it
  SeenPoints(const SpacingGrid& grid, Span<glm::dvec3> positions, Span<double> inverseSpacings,
    double reach);

  /// Gathers the points around a cell.
  void lookAround(const SpacingGrid::Points& cell);

  /// Most numbers that list() writes.
  std::size_t most() const { return this->Around.count; }

  /// Lists what a point of the cell sees, without itself, in a fixed order.
  /// \param first room for most() numbers
  /// \return the end of the list
  int* list(int point, int* first) const;

private:
  void add(const glm::dvec3& position, double inverseSpacing, int index);
  void grow();
  void fillUp();

  const SpacingGrid& Grid;
  Span<glm::dvec3> Positions;
  Span<double> InverseSpacings;
  /// Of d^2 (1/h + 1/h')^2.
  double Limit;
  kernel::NearFunction FindNear;
  /// Rows as the kernel takes them: x, y, z, 1/h.
  std::array<std::vector<double>, 4> Rows;
  std::vector<std::int32_t> Index;
  std::size_t Count = 0;
  kernel::Candidates Around{};
};

} // namespace hop
