#pragma once

#include "Common/Monitor.h"

#include <functional>

/// Runs `work` with the best threaded back end of vtkSMPTools that this VTK was built with, unless
/// the caller has already chosen one other than Sequential; restores the caller's choice.
/// \param work receives loops that run in as many threads as vtkSMPTools takes; threads end when it returns
void withThreads(const std::function<void(const hop::ParallelFor&)>& work);
