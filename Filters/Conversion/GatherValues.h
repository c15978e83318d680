#pragma once

#include "vtkType.h"

class vtkDataArray;

namespace hop
{

/// One component of some tuples of an array, as doubles.
/// \param ids `count` tuples, all of them valid
/// \param stride distance between two results
void gatherComponent(vtkDataArray* array, const vtkIdType* ids, vtkIdType count, int component,
  double* result, int stride = 1);

} // namespace hop
