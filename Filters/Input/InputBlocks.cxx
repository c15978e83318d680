#include "Input/InputBlocks.h"

#include "Input/VtkCompatibility.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hop
{

namespace
{

/// A mark for each point that a cell of this rank has; empty where no cell is a ghost: then all points count. So it is
/// with marks that are too few, which are ignored later.
std::vector<char> pointsOfOwnCells(vtkUnstructuredGrid* grid)
{
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  const bool areAll = ghosts && ghosts->GetNumberOfTuples() >= grid->GetNumberOfCells();
  const vtkIdType cells = areAll ? grid->GetNumberOfCells() : 0;
  vtkIdType first = 0;
  while (first < cells && !isGhostCell(ghosts, first))
  {
    ++first;
  }
  if (first == cells)
  {
    return {};
  }
  std::vector<char> marks(grid->GetNumberOfPoints(), 0);
  vtkNew<vtkIdList> room;
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cellPoints(grid->GetCells(), cell, count, ids, room);
    for (vtkIdType i = 0; i < count && !isGhostCell(ghosts, cell); ++i)
    {
      if (ids[i] >= 0 && ids[i] < grid->GetNumberOfPoints())
      {
        marks[ids[i]] = 1;
      }
    }
  }
  return marks;
}

} // namespace

InputBlocks::InputBlocks(std::vector<InputBlock> blocks, int component, Quantity quantity,
  std::shared_ptr<const FieldExpression> expression)
  : Blocks(std::move(blocks))
  , Component(component)
  , ItsQuantity(quantity)
  , Expression(std::move(expression))
  , FirstCells{ 0 }
{
  for (const InputBlock& block : this->Blocks)
  {
    this->FirstCells.push_back(this->FirstCells.back() + block.grid->GetNumberOfCells());
  }
}

BlockCell InputBlocks::locate(std::int64_t number) const
{
  const auto next = std::upper_bound(this->FirstCells.begin(), this->FirstCells.end(), number);
  const auto block = static_cast<std::size_t>(next - this->FirstCells.begin()) - 1;
  return { block, number - this->FirstCells[block] };
}

std::string InputBlocks::describe(std::int64_t number) const
{
  const BlockCell where = this->locate(number);
  const std::string& name = this->Blocks[where.block].name;
  return "cell " + std::to_string(where.cell) + (name.empty() ? "" : " of " + name);
}

int componentOf(const std::vector<InputBlock>& blocks, int asked, Quantity quantity)
{
  if (needsVector(quantity) || quantity == Quantity::Expression)
  {
    return InputBlocks::Magnitude;
  }
  const int components = blocks.empty() ? 1 : blocks[0].scalars->GetNumberOfComponents();
  return components == 1 ? 0 : asked < components ? asked : InputBlocks::Magnitude;
}

bool isGhostCell(vtkUnsignedCharArray* ghosts, vtkIdType cell)
{
  constexpr int notOwned = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL |
    vtkDataSetAttributes::HIDDENCELL;
  return ghosts && (ghosts->GetValue(cell) & notOwned) != 0;
}

vtkBoundingBox finiteBounds(vtkUnstructuredGrid* grid)
{
  const auto isFinite = [](double x) { return std::isfinite(x); };
  const std::vector<char> owned = pointsOfOwnCells(grid);
  double bounds[6];
  grid->GetBounds(bounds);
  if (owned.empty() && std::all_of(bounds, bounds + 6, isFinite))
  {
    return vtkBoundingBox(bounds);
  }
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double x[3];
    grid->GetPoint(i, x);
    if ((owned.empty() || owned[i]) && std::all_of(x, x + 3, isFinite))
    {
      box.AddPoint(x);
    }
  }
  return box;
}

std::array<double, 2> finiteRange(vtkUnstructuredGrid* grid, vtkDataArray* values, int component)
{
  constexpr int magnitude = -1; // as VTK numbers it
  const int asVtk = component == InputBlocks::Magnitude ? magnitude : component;
  const std::vector<char> owned = pointsOfOwnCells(grid);
  std::array<double, 2> range;
  if (owned.empty())
  {
    values->GetFiniteRange(range.data(), asVtk);
    return range;
  }
  const auto some = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(values->GetDataType()));
  some->SetNumberOfComponents(values->GetNumberOfComponents());
  for (vtkIdType i = 0; i < std::min(grid->GetNumberOfPoints(), values->GetNumberOfTuples()); ++i)
  {
    if (owned[i])
    {
      some->InsertNextTuple(i, values);
    }
  }
  some->GetFiniteRange(range.data(), asVtk);
  return range;
}

} // namespace hop
