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

/// What runs over pieces of a loop, each from begin to end - 1.
using LoopBody = std::function<void(std::ptrdiff_t begin, std::ptrdiff_t end)>;

/// The seam to the caller's threads: runs body(begin, end) over pieces of [0, count), in any order
/// and number. Results must not depend on either. Serial when empty.
using ParallelFor = std::function<void(std::ptrdiff_t count, const LoopBody& body)>;

/// Runs a loop in the caller's threads, or here if there are none. What a piece of it throws is thrown here when all
/// threads are done: none would outlive it.
void runInThreads(const ParallelFor& parallelFor, std::ptrdiff_t count, const LoopBody& body);

/// Runs a loop alone, in growing pieces, until all of it seems to take longer than threads do to start.
/// \return where it has got to
std::ptrdiff_t runAlone(std::ptrdiff_t count, const LoopBody& body);

/// Runs a loop alone as long as that is faster, the rest of it in the caller's threads.
void runParallel(const ParallelFor& parallelFor, std::ptrdiff_t count, const LoopBody& body);

/// For long work on one thread, now and then: the caller may end it as between loops.
inline void askCaller(const ParallelFor& parallelFor)
{
  runInThreads(parallelFor, 0, [](std::ptrdiff_t, std::ptrdiff_t) {});
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
