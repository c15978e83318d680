#pragma once

#include "vtkType.h"

#include <map>
#include <string>
#include <utility>

namespace hop
{

/// What becomes of a cell. All verdicts but Keep leave it out. CellCensus explains the reasons.
enum class Verdict : char
{
  Keep,
  /// The cell provably holds no surface.
  Drop,
  BrokenConnectivity,
  NotFinite,
  BadWeights,
  Level,
  Unsupported,
  /// Of a derived field.
  Singular,
  /// Of a formula.
  Undefined,
  /// By vtkGhostType another piece's, hidden, or replaced.
  Ghost
};

/// Cells that were left out for one reason: their number, and the first of them.
struct SkippedCells
{
  vtkIdType count = 0;
  vtkIdType first = -1;

  void add(vtkIdType cell) { this->add({ 1, cell }); }
  /// \pre the others come after these cells in the block
  void add(const SkippedCells& others)
  {
    this->first = this->count == 0 ? others.first : this->first;
    this->count += others.count;
  }
};

/// What became of a block's cells. Cells are named by their numbers in the block.
struct CellCensus
{
  /// Cells that provably hold none of the isosurfaces.
  vtkIdType dropped = 0;
  /// By VTK cell type: cells that are no supported 3-D cells, or whose number of points fits no degree.
  std::map<int, SkippedCells> unsupported;
  /// Point ids outside the grid.
  SkippedCells brokenConnectivity;
  /// Coordinates or values that are NaN or infinite, or values too large to be squared in the unit of the run.
  SkippedCells notFinite;
  /// Rational Bezier cells with weights that are not positive.
  SkippedCells badWeights;
  /// The field is the same in the whole cell, and one of the isovalues: no surface.
  SkippedCells level;
  /// Cells in which a derived field may be infinite: the Jacobian determinant is not proven to be positive.
  SkippedCells singular;
  /// Cells in which a formula is not finite somewhere.
  SkippedCells undefined;
  /// The Jacobian determinant is zero everywhere, to rounding, or the cell is tiny beside the bounds: no volume.
  SkippedCells collapsed;
  /// By VTK cell type, and by what is wrong with them and what mends it (MisorderedCells::describe()): cells whose
  /// nodes seem to be in another order than VTK's. Cells without surface are counted, too.
  std::map<std::pair<int, std::string>, SkippedCells> misordered;
  /// Kept cells whose Jacobian determinant changes its sign: partly inverted.
  SkippedCells folded;
  /// Kept cells in which a derived field is interpolated with a larger error than FieldSampler's tolerance.
  SkippedCells unresolved;

  /// Counts a cell that is left out. Ghost cells are not counted: the file means them to be ignored.
  /// \param cellType VTK's type of the cell
  void count(Verdict verdict, vtkIdType cell, int cellType);
  /// Adds the census of cells that come after these in the block.
  void add(const CellCensus& others);
  vtkIdType skipped() const;
  /// A text that names all cells that were skipped or are doubtful; empty if there are none.
  std::string describe() const;
};

} // namespace hop
