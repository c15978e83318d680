#pragma once

#include "Common/Monitor.h"
#include "Elements/ElementMesh.h"

#include <vtkSmartPointer.h>

class vtkUnstructuredGrid;

namespace hop::testing
{

/// What experts do by hand for a filter of linear cells: every element cut into pieces^3 linear cells of
/// its own kind, with points of its own, at which its polynomials are sampled.
/// \return a grid whose point array 'f' is the field
vtkSmartPointer<vtkUnstructuredGrid> subdividedGrid(
  const ElementMesh& mesh, int pieces, const ParallelFor& parallelFor);

} // namespace hop::testing
