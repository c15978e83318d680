#include "Support/SeenPoints.h"

#include "Kernel/InstructionSet.h"

#include <algorithm>

namespace hop
{

SeenPoints::SeenPoints(
  const SpacingGrid& grid, Span<glm::dvec3> positions, Span<double> inverseSpacings, double reach)
  : Grid(grid)
  , Positions(positions)
  , InverseSpacings(inverseSpacings)
  // Two points see each other if d <= 2 reach/(1/h + 1/h').
  , Limit(4.0 * reach * reach)
  , FindNear(kernel::current().near)
{
}

void SeenPoints::lookAround(const SpacingGrid::Points& cell)
{
  this->Count = 0;
  this->Grid.visitAround(
    cell, [this](int j) { this->add(this->Positions[j], this->InverseSpacings[j], j); });
  this->fillUp();
}

int* SeenPoints::list(int point, int* first) const
{
  const glm::dvec3& x = this->Positions[point];
  int* end = this->FindNear(
    this->Around, { x.x, x.y, x.z }, this->InverseSpacings[point], this->Limit, first);
  return std::remove(first, end, point);
}

void SeenPoints::add(const glm::dvec3& position, double inverseSpacing, int index)
{
  if (this->Count == this->Index.size())
  {
    this->grow();
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Rows[axis][this->Count] = position[axis];
  }
  this->Rows[3][this->Count] = inverseSpacing;
  this->Index[this->Count++] = index;
}

void SeenPoints::grow()
{
  const std::size_t size = 2 * this->Index.size() + 64;
  for (auto& row : this->Rows)
  {
    row.resize(size);
  }
  this->Index.resize(size);
}

/// Fills the last vector up with points out of reach.
void SeenPoints::fillUp()
{
  // Far from everything, yet its square is finite.
  constexpr double outOfReach = 1e150;
  while (this->Count % kernel::MaximumLanes != 0)
  {
    this->add(glm::dvec3(outOfReach), 1.0, 0);
  }
  this->Around = { this->Rows[0].data(), this->Rows[1].data(), this->Rows[2].data(),
    this->Rows[3].data(), this->Index.data(), static_cast<std::ptrdiff_t>(this->Count) };
}

} // namespace hop
