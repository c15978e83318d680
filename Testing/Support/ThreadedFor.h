#pragma once

#include "Common/Monitor.h"

namespace hop::testing
{

/// A ParallelFor on threads of its own that deals out small pieces in whatever order the threads
/// ask for them: results that depend on order or number of the pieces come out differently.
ParallelFor threadedFor(int threads);

} // namespace hop::testing
