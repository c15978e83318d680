#include "Conversion/CellValues.h"

#include "Conversion/GatherValues.h"
#include "Conversion/RunUnits.h"
#include "Input/VtkCompatibility.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace hop
{

namespace
{

/// Whether a nodal value can be converted to Bernstein form; NaN cannot.
bool isUsable(double value)
{
  // Conversion enlarges values by 1e14 at most, at the highest degree: below the largest double, 1.8e308.
  constexpr double largest = 1e290;
  return std::abs(value) <= largest;
}

/// Whether a weight is positive and finite.
bool isGoodWeight(double weight)
{
  return weight > 0.0 && std::isfinite(weight);
}

/// \return whether all values are usable
bool readField(const InputBlocks& blocks, vtkDataArray* scalars, CellValues& values)
{
  const bool all = blocks.readsAllComponents();
  values.components = all ? scalars->GetNumberOfComponents() : 1;
  values.field.resize(values.count * values.components);
  for (int c = 0; c < values.components; ++c)
  {
    gatherComponent(scalars, values.ids, values.count, all ? c : blocks.component(),
      values.field.data() + c, values.components);
  }
  return std::all_of(values.field.begin(), values.field.end(), isUsable);
}

/// Weights of about one: only their ratios count.
/// \param weights nullptr where the cell is not rational
/// \return whether all weights are good
bool readWeights(vtkDataArray* weights, CellValues& values)
{
  values.weights.clear();
  if (weights)
  {
    values.weights.resize(values.count);
    gatherComponent(weights, values.ids, values.count, 0, values.weights.data());
  }
  if (!std::all_of(values.weights.begin(), values.weights.end(), isGoodWeight))
  {
    return false;
  }
  const auto largest = std::max_element(values.weights.begin(), values.weights.end());
  const double unit = largest == values.weights.end() ? 1.0 : unitOf(*largest);
  std::transform(values.weights.begin(), values.weights.end(), values.weights.begin(),
    [unit](double weight) { return weight / unit; });
  return true;
}

} // namespace

bool readIds(vtkUnstructuredGrid* grid, vtkIdType cell, CellValues& values)
{
  cellPoints(grid->GetCells(), cell, values.count, values.ids, values.copiedIds);
  const vtkIdType points = grid->GetNumberOfPoints();
  return std::all_of(values.ids, values.ids + values.count,
    [points](vtkIdType id) { return id >= 0 && id < points; });
}

vtkDataArray* rationalWeights(const InputBlock& block, const CellBasis& cell)
{
  return cell.bezier ? block.grid->GetPointData()->GetRationalWeights() : nullptr;
}

Verdict readCell(
  const InputBlocks& blocks, const BlockCell& where, const CellBasis& cell, CellValues& values)
{
  const InputBlock& block = blocks[where.block];
  if (!readIds(block.grid, where.cell, values))
  {
    return Verdict::BrokenConnectivity;
  }
  if (!readField(blocks, block.scalars, values))
  {
    return Verdict::NotFinite;
  }
  return readWeights(rationalWeights(block, cell), values) ? Verdict::Keep : Verdict::BadWeights;
}

} // namespace hop
