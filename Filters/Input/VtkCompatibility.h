#pragma once

// What differs between VTK 9.1 and 9.6, and ParaView's snapshots of VTK in between.

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkVersionMacros.h"

#if __has_include("vtkCellTypeUtilities.h") // from VTK 9.6 on
#include "vtkCellTypeUtilities.h"
using CellTypeNames = vtkCellTypeUtilities;
#else
#include "vtkCellTypes.h"
using CellTypeNames = vtkCellTypes;
#endif

/// Whether a user, or the pipeline, wants the algorithm to stop.
inline bool isAborted(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220801)
  return algorithm->CheckAbort(); // also looks upstream
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

/// The ids of a cell's points: count, and where they stand, which may be in `copied`. For several threads, each
/// with a list of its own.
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
