#include "Input/InputBlocks.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hop
{

InputBlocks::InputBlocks(std::vector<InputBlock> blocks, int component)
  : Blocks(std::move(blocks))
  , Component(component)
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

bool InputBlocks::isGhost(const BlockCell& cell) const
{
  return isGhostCell(this->Blocks[cell.block].grid->GetCellGhostArray(), cell.cell);
}

std::string InputBlocks::describe(std::int64_t number) const
{
  const BlockCell where = this->locate(number);
  const std::string& name = this->Blocks[where.block].name;
  return "cell " + std::to_string(where.cell) + (name.empty() ? "" : " of " + name);
}

int componentOf(const std::vector<InputBlock>& blocks, int asked)
{
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
  double bounds[6];
  grid->GetBounds(bounds);
  if (std::all_of(bounds, bounds + 6, isFinite))
  {
    return vtkBoundingBox(bounds);
  }
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double x[3];
    grid->GetPoint(i, x);
    if (std::all_of(x, x + 3, isFinite))
    {
      box.AddPoint(x);
    }
  }
  return box;
}

} // namespace hop
