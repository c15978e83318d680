#pragma once

#include "CellBases.h"
#include "ElementMesh.h"
#include "InputBlocks.h"
#include "Monitor.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

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

  /// Adds those of cells that follow on these.
  void add(const CellCensus& others);
  vtkIdType skipped() const;
  /// One text that names all that was skipped or is doubtful, empty if nothing.
  std::string describe() const;
};

/// Grids seen as elements: those that can hold one of the isosurfaces in Bernstein form, joined at
/// their faces within and across blocks, and the bases by which further arrays can be evaluated on them.
struct GridElements
{
  /// Its elements name their cells by the number that InputBlocks gives them.
  hop::ElementMesh mesh;
  /// Of all kinds of cells.
  std::unique_ptr<CellBases> kinds;
  /// One an element, of those.
  std::vector<const CellBasis*> bases;
  /// Whether the mesh's field is the square of the chosen scalar: the magnitude of a vector is no
  /// polynomial, its square is, and |v| = c where |v|^2 = c^2.
  bool squared = false;
  /// One a block.
  std::vector<CellCensus> census;

  /// Whether the chosen scalar can have a value at all: a magnitude is never negative.
  bool canBe(double isovalue) const { return !this->squared || isovalue >= 0.0; }

  /// The value of the mesh's field on the isosurface of the chosen scalar.
  /// \pre canBe(isovalue)
  double fieldIsovalue(double isovalue) const
  {
    return this->squared ? isovalue * isovalue : isovalue;
  }
};

/// \param isovalues of the chosen scalar, at least one
/// \param reached is told what share of the work is done, 0 to 1; may throw to end it early
GridElements buildGridElements(
  const InputBlocks& blocks, hop::NodeSpacing spacing, const std::vector<double>& isovalues,
  const hop::ParallelFor& parallelFor, const std::function<void(double)>& reached = [](double) {});
