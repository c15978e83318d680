#pragma once

#include "GridRecipe.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkDataObject;
class vtkUnstructuredGrid;

namespace hop::testing
{

/// The grid of a recipe, with the point arrays "f", which is contoured, and "other", and the cell array "material".
/// \param change for other points and values of the same kind
vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const GridRecipe& recipe, int change = 0);

/// The grid's cells in so many blocks of about the same size; all blocks have all points.
std::vector<vtkSmartPointer<vtkUnstructuredGrid>> cutIntoPieces(
  vtkUnstructuredGrid& grid, int count);

} // namespace hop::testing
