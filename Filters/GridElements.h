#pragma once

#include "CellBases.h"
#include "ElementMesh.h"
#include "Monitor.h"

#include <map>
#include <string>
#include <vector>

class vtkDataArray;
class vtkUnstructuredGrid;

/// Cells that were left out, for one reason: how many, and the first.
struct SkippedCells
{
  vtkIdType count = 0;
  vtkIdType first = -1;

  void add(vtkIdType cell)
  {
    this->first = this->count++ == 0 ? cell : this->first;
  }
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
  std::vector<std::shared_ptr<const hop::NodalBasis>> bases;
  CellCensus census;
};

/// \param scalars one component, one value a point
/// \param isovalues at least one
GridElements buildGridElements(vtkUnstructuredGrid* grid, vtkDataArray* scalars,
  const std::vector<double>& isovalues, const hop::ParallelFor& parallelFor);
