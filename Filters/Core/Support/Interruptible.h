#pragma once

#include "Common/Monitor.h"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace hop
{

/// Thrown where the monitor asked for an early end.
struct Interrupted
{
};

/// A ParallelFor that asks a monitor some twenty times a second, and throws Interrupted where it should
/// stop. Threads take chunks of the work as they come, until all is done or it is time to ask.
class Interruptible
{
public:
  Interruptible(const Monitor& monitor, const ParallelFor& parallelFor)
    : Progress(monitor)
    , Parallel(parallelFor)
  {
  }

  /// What is reported from now on, unless that is less than before: progress never falls. May be called
  /// from several threads.
  void raiseFraction(double fraction)
  {
    double known = this->Fraction;
    while (known < fraction && !this->Fraction.compare_exchange_weak(known, fraction))
    {
    }
  }

  void operator()(std::ptrdiff_t count, const LoopBody& body)
  {
    // Chunks enough for many threads to finish together, each short beside the period.
    constexpr std::ptrdiff_t chunkCount = 64;
    constexpr std::ptrdiff_t largestChunk = 4096;
    const std::ptrdiff_t chunk = std::clamp<std::ptrdiff_t>(count / chunkCount, 1, largestChunk);
    std::atomic<std::ptrdiff_t> next{ 0 };
    this->askAtTimes();
    while (next < count)
    {
      const auto pause = Clock::now() + period;
      const auto work = [&](std::ptrdiff_t, std::ptrdiff_t)
      {
        while (next < count && Clock::now() < pause)
        {
          const std::ptrdiff_t begin = next.fetch_add(chunk);
          if (begin < count)
          {
            body(begin, std::min(count, begin + chunk));
          }
        }
      };
      runInThreads(this->Parallel, std::min(count, chunkCount), work);
      this->askAtTimes();
    }
  }

  /// \throw Interrupted if the monitor asks for it
  void ask() const
  {
    if (!this->Progress.proceed(this->Fraction))
    {
      throw Interrupted();
    }
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds period{ 50 };

  void askAtTimes()
  {
    if (Clock::now() - this->LastAsked > period)
    {
      this->LastAsked = Clock::now();
      this->ask();
    }
  }

  const Monitor& Progress;
  const ParallelFor& Parallel;
  std::atomic<double> Fraction{ 0.0 };
  Clock::time_point LastAsked{};
};

/// What `run` returns; where it was interrupted, nothing but a report that says so.
template <class Run>
auto unlessInterrupted(const Run& run)
{
  try
  {
    return run();
  }
  catch (const Interrupted&)
  {
    decltype(run()) nothing;
    nothing.report.aborted = true;
    return nothing;
  }
}

} // namespace hop
