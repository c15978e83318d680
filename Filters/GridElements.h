#pragma once

#include "CellBases.h"
#include "ElementMesh.h"
#include "Monitor.h"

#include <map>
#include <string>
#include <vector>

class vtkDataArray;
class vtkUnstructuredGrid;

/// What to contour by: a point array's component, or the magnitude of its tuples.
struct ScalarChoice
{
  static constexpr int Magnitude = -1;

  vtkDataArray* array = nullptr;
  int component = 0;
};

/// Cells that were left out, for one reason: how many, and the first.
struct SkippedCells
{
  vtkIdType count = 0;
  vtkIdType first = -1;

  void add(vtkIdType cell) { this->first = this->count++ == 0 ? cell : this->first; }
};

/// What became of a grid's cells.
struct CellCensus
{
  /// Cells that provably hold none of the isosurfaces.
  vtkIdType dropped = 0;
  /// By VTK cell type: no 3-D cell that the filter knows, or a point count that fits no degree.
  std::map<int, SkippedCells> unsupported;
  /// Point ids outside the grid.
  SkippedCells brokenConnectivity;
  /// Coordinates or values that are NaN or infinite.
  SkippedCells notFinite;
  /// Rational Bezier cells with weights that are not positive.
  SkippedCells badWeights;
  /// Jacobian determinant zero wherever it was looked at.
  SkippedCells collapsed;
  /// Kept, but the Jacobian determinant changes its sign: partly inverted.
  SkippedCells folded;

  vtkIdType skipped() const;
  /// One text that names all that was skipped or is doubtful, empty if nothing.
  std::string describe() const;
};

/// A grid seen as elements: those that can hold one of the isosurfaces in Bernstein form, joined at
/// their faces, and the bases by which further arrays can be evaluated on them.
struct GridElements
{
  hop::ElementMesh mesh;
  /// One an element.
  std::vector<std::shared_ptr<const CellBasis>> bases;
  /// The grid's RationalWeights, or nullptr; they apply to Bezier cells.
  vtkDataArray* rationalWeights = nullptr;
  /// Whether the mesh's field is the square of the chosen scalar: the magnitude of a vector is no
  /// polynomial, its square is, and |v| = c where |v|^2 = c^2.
  bool squared = false;
  CellCensus census;

  /// The value of the mesh's field on the isosurface of the chosen scalar.
  double fieldIsovalue(double isovalue) const
  {
    return this->squared ? isovalue * isovalue : isovalue;
  }
};

/// \param isovalues of the chosen scalar, at least one
GridElements buildGridElements(vtkUnstructuredGrid* grid, const ScalarChoice& scalars,
  hop::NodeSpacing spacing, const std::vector<double>& isovalues,
  const hop::ParallelFor& parallelFor);
