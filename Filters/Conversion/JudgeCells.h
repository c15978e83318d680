#pragma once

#include "Common/Monitor.h"
#include "Conversion/CellBases.h"
#include "Conversion/CellCensus.h"
#include "Conversion/DerivedCell.h"
#include "Input/InputBlocks.h"

#include <vector>

namespace hop
{

/// A cell that can hold surface.
struct KeptCell
{
  vtkIdType cell = 0;
  const CellBasis* basis = nullptr;
  /// Largest difference of two nodal values; of a vector its largest component; of a derived field how much it changes.
  double change = 0.0;
};

/// Cells `begin` to `end` - 1 of a block, and what one thread found out about them.
struct JudgedCells
{
  std::size_t block = 0;
  vtkIdType begin = 0;
  vtkIdType end = 0;
  /// In ascending order.
  std::vector<KeptCell> kept;
  /// One a kept cell where a derived field is contoured, else empty.
  std::vector<DerivedCell> derived;
  /// Of the cells that are not kept.
  CellCensus census;
};

/// Finds the cells that can hold surface. Only values are read here, not coordinates: of a derived field all sound cells
/// are kept in which the array is not constant.
/// \param isovalues of the chosen scalar, at least one
/// \param kinds receives the bases of the cells
/// \return all cells in ranges, in ascending order
std::vector<JudgedCells> judgeCells(const InputBlocks& blocks, const std::vector<double>& isovalues,
  CellBases& kinds, const ParallelFor& parallelFor);

} // namespace hop
