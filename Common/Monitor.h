#pragma once

#include <cstddef>
#include <functional>

namespace hop
{

/// By this, work that takes long reports its progress and learns that it should stop. Called only from the thread that
/// started the work.
struct Monitor
{
  /// Receives the fraction done, 0 to 1; returns false to ask for an early end.
  std::function<bool(double)> report;
  /// Receives the number of particles that there will be, about, before they take their time.
  std::function<void(double)> expect = {};

  bool proceed(double fraction) const { return !this->report || this->report(fraction); }
};

/// Runs a piece of a loop: the items from begin to end - 1.
using LoopBody = std::function<void(std::ptrdiff_t begin, std::ptrdiff_t end)>;

/// The seam to the caller's threads: runs body(begin, end) for pieces that make up [0, count). Results must depend
/// neither on the order of the pieces nor on their number. Where it is empty, loops run in the thread that asks.
using ParallelFor = std::function<void(std::ptrdiff_t count, const LoopBody& body)>;

/// Runs a loop in the caller's threads, or here if there are none.
/// \throw what a piece of it has thrown, when all threads are done: an exception must not leave a thread
void runInThreads(const ParallelFor& parallelFor, std::ptrdiff_t count, const LoopBody& body);

/// Runs a loop in this thread, in growing pieces, until all of it seems to take longer than threads take to start.
/// \return how many items are done: the first ones
std::ptrdiff_t runAlone(std::ptrdiff_t count, const LoopBody& body);

/// Runs a loop in this thread as long as that is faster, and the rest of it in the caller's threads.
void runParallel(const ParallelFor& parallelFor, std::ptrdiff_t count, const LoopBody& body);

/// To be called now and then by long work in one thread: the caller may end it here, as it may between loops.
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
