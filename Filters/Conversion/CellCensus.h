#pragma once

#include "vtkType.h"

#include <map>
#include <string>

namespace hop
{

/// What is to become of a cell. All but Keep leave it out.
enum class Verdict : char
{
  Keep,
  Drop,
  BrokenConnectivity,
  NotFinite,
  BadWeights,
  Level,
  Unsupported,
  Hidden
};

/// Cells that were left out, for one reason: how many, and the first.
struct SkippedCells
{
  vtkIdType count = 0;
  vtkIdType first = -1;

  void add(vtkIdType cell) { this->add({ 1, cell }); }
  /// \pre those cells follow on these
  void add(const SkippedCells& others)
  {
    this->first = this->count == 0 ? others.first : this->first;
    this->count += others.count;
  }
};

/// What became of a block's cells; they are named by their numbers in the block.
struct CellCensus
{
  /// Cells that provably hold none of the isosurfaces.
  vtkIdType dropped = 0;
  /// By VTK cell type: no 3-D cell that the filter knows, or a point count that fits no degree.
  std::map<int, SkippedCells> unsupported;
  /// Point ids outside the grid.
  SkippedCells brokenConnectivity;
  /// Coordinates or values that are NaN or infinite, or values too large to be squared.
  SkippedCells notFinite;
  /// Rational Bezier cells with weights that are not positive.
  SkippedCells badWeights;
  /// The field is the same in the whole cell, and one of the isovalues: no surface.
  SkippedCells level;
  /// Jacobian determinant zero wherever it was looked at.
  SkippedCells collapsed;
  /// Kept, but the Jacobian determinant changes its sign: partly inverted.
  SkippedCells folded;

  /// Counts a cell that is left out; hidden ones are nobody's concern.
  /// \param cellType of VTK
  void count(Verdict verdict, vtkIdType cell, int cellType);
  /// Adds those of cells that follow on these.
  void add(const CellCensus& others);
  vtkIdType skipped() const;
  /// One text that names all that was skipped or is doubtful, empty if nothing.
  std::string describe() const;
};

} // namespace hop
