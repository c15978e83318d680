#pragma once

// Functions that hide the differences between VTK 9.1, VTK 9.6 and ParaView's snapshots of VTK in between.

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkVersionMacros.h"

#if __has_include("vtkCellTypeUtilities.h") // VTK 9.6 and later
#include "vtkCellTypeUtilities.h"
#else
#include "vtkCellTypes.h"
#endif

namespace hop
{

/// VTK's table of the names of its cell types.
#if __has_include("vtkCellTypeUtilities.h")
using CellTypeNames = vtkCellTypeUtilities;
#else
using CellTypeNames = vtkCellTypes;
#endif

/// Whether a user or the pipeline wants the algorithm to stop.
inline bool isAborted(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220801)
  return algorithm->CheckAbort(); // also looks upstream
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

/// Finds the ids of a cell's points without a copy where VTK allows it. Several threads may call it at once, each
/// with its own `copied`.
/// \param count receives the number of points
/// \param ids receives where the ids stand: in the cell array, or in `copied`
inline void cellPoints(
  vtkCellArray* cells, vtkIdType cell, vtkIdType& count, const vtkIdType*& ids, vtkIdList* copied)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220801)
  cells->GetCellAtId(cell, count, ids, copied);
#else
  cells->GetCellAtId(cell, copied);
  count = copied->GetNumberOfIds();
  ids = copied->GetPointer(0);
#endif
}

} // namespace hop
