#pragma once

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

/// Whether a user, or the pipeline, wants the algorithm to stop. Releases before VTK 9.3 have no
/// CheckAbort, which also looks upstream; ParaView 5.11's VTK, in between, does.
inline bool isAborted(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220801)
  return algorithm->CheckAbort();
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}
