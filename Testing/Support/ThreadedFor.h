#pragma once

#include "Common/Monitor.h"

namespace hop::testing
{

/// A ParallelFor on threads of its own that deals out small pieces in the order in which threads
/// ask for them: results that depend on the order or number of pieces differ from run to run.
ParallelFor threadedFor(int threads);

} // namespace hop::testing
