#pragma once

#include "vtkType.h"

class vtkDataArray;

namespace hop
{

/// Reads one component of some tuples of an array, as doubles.
/// \param ids numbers of `count` tuples, all of them valid
/// \param result receives the numbers, each `stride` doubles after the one before
void gatherComponent(vtkDataArray* array, const vtkIdType* ids, vtkIdType count, int component,
  double* result, int stride = 1);

} // namespace hop
