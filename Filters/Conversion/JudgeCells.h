#pragma once

#include "Common/Monitor.h"
#include "Conversion/CellBases.h"
#include "Conversion/CellCensus.h"
#include "Input/InputBlocks.h"

#include <vector>

namespace hop
{

/// A cell that can hold surface.
struct KeptCell
{
  vtkIdType cell = 0;
  const CellBasis* basis = nullptr;
};

/// Cells `begin` to `end` - 1 of a block, looked at by one thread, and what it found.
struct JudgedCells
{
  std::size_t block = 0;
  vtkIdType begin = 0;
  vtkIdType end = 0;
  /// In order.
  std::vector<KeptCell> kept;
  /// Of the others.
  CellCensus census;
};

/// Sorts out which cells can hold surface. Only values are read here, not coordinates.
/// \param isovalues of the chosen scalar, at least one
/// \param kinds those of the cells are added
/// \return all cells, in order
std::vector<JudgedCells> judgeCells(const InputBlocks& blocks, const std::vector<double>& isovalues,
  CellBases& kinds, const ParallelFor& parallelFor);

} // namespace hop
