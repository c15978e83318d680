#pragma once

#include "Conversion/CellBases.h"
#include "Conversion/CellCensus.h"
#include "Input/InputBlocks.h"

#include "vtkIdList.h"
#include "vtkNew.h"

#include <vector>

namespace hop
{

/// What is read of one cell. Each thread has one CellValues and uses its memory again for the next cell.
struct CellValues
{
  /// Number of the cell's points.
  vtkIdType count = 0;
  /// Ids of the points.
  const vtkIdType* ids = nullptr;
  /// Holds the ids if the grid stores them in another form.
  vtkNew<vtkIdList> copiedIds;
  /// Components of the field: one, or all components of a vector.
  int components = 1;
  /// Nodal values of the field: `components` numbers a node.
  std::vector<double> field;
  /// Nodal weights; empty unless the cell is rational.
  std::vector<double> weights;
};

/// Reads the ids of a cell's points.
/// \return whether all ids are in the grid
bool readIds(vtkUnstructuredGrid* grid, vtkIdType cell, CellValues& values);

/// The point array with the weights of a block's cells of one kind; nullptr where these cells are not rational.
vtkDataArray* rationalWeights(const InputBlock& block, const CellBasis& cell);

/// Reads a cell's ids, field and weights, not its coordinates.
/// \return Keep, or what is wrong with the cell; then `values` are not complete
Verdict readCell(
  const InputBlocks& blocks, const BlockCell& where, const CellBasis& cell, CellValues& values);

} // namespace hop
