#pragma once

#include "Common/Monitor.h"

namespace hop
{

/// A part of a run, as far as progress and threads are concerned.
struct Work
{
  Monitor monitor;
  const ParallelFor& parallelFor;

  /// \param begin, end fractions of this work
  Work part(double begin, double end) const
  {
    return { { [this, begin, end](double fraction)
               { return this->monitor.proceed(begin + (end - begin) * fraction); },
               this->monitor.expect },
      this->parallelFor };
  }
};

} // namespace hop
