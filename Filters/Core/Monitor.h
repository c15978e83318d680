#pragma once

#include <cstddef>
#include <functional>

namespace hop
{

/// How long work reports its progress and learns that it should stop. Called from the thread that
/// started the work only.
struct Monitor
{
  /// Receives the fraction done, 0 to 1; returns false to ask for an early end.
  std::function<bool(double)> report;

  bool proceed(double fraction) const { return !this->report || this->report(fraction); }
};

/// The seam to the caller's threads: runs body(begin, end) over pieces of [0, count), in any order
/// and number. Results must not depend on either. Serial when empty.
using ParallelFor = std::function<void(
  std::ptrdiff_t count, const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body)>;

inline void runParallel(const ParallelFor& parallelFor, std::ptrdiff_t count,
  const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body)
{
  if (parallelFor)
  {
    parallelFor(count, body);
  }
  else if (count > 0)
  {
    body(0, count);
  }
}

/// Calls use(i) for every i in [0, count), in the caller's threads.
template <class Use>
void forAll(const ParallelFor& parallelFor, std::size_t count, const Use& use)
{
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(count),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        use(static_cast<std::size_t>(i));
      }
    });
}

} // namespace hop
