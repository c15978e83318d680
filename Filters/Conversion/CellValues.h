#pragma once

#include "Conversion/CellBases.h"
#include "Conversion/CellCensus.h"
#include "Input/InputBlocks.h"

#include "vtkIdList.h"
#include "vtkNew.h"

#include <vector>

namespace hop
{

/// What is read of one cell. To be used again for the next one, so that memory is: one a thread.
struct CellValues
{
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  /// Where the ids are if the grid stores them otherwise.
  vtkNew<vtkIdList> copiedIds;
  /// Of the field: one, or all of a vector's for its magnitude.
  int components = 1;
  /// Nodal values of the field, `components` a node.
  std::vector<double> field;
  /// Empty unless the cell is rational.
  std::vector<double> weights;
};

/// The weights of a block's cells of one kind, nullptr where these are not rational.
vtkDataArray* rationalWeights(const InputBlock& block, const CellBasis& cell);

/// Reads a cell's values, not its coordinates.
/// \return Keep, or what is wrong with the cell; `values` are not complete then
Verdict readCell(
  const InputBlocks& blocks, const BlockCell& where, const CellBasis& cell, CellValues& values);

} // namespace hop
