#pragma once

#include "Monitor.h"

#include <functional>

/// Runs `work` with the best threaded back end of vtkSMPTools that this VTK was built with, unless
/// the caller has already chosen one other than Sequential; restores the caller's choice.
void withThreads(const std::function<void()>& work);

/// vtkSMPTools::For behind the core's seam.
hop::ParallelFor smpParallelFor();
