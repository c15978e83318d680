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

/// A ParallelFor that asks a monitor some twenty times a second whether to go on, and throws Interrupted if not.
/// Threads take chunks of the work until all is done or it is time to ask.
class Interruptible
{
public:
  Interruptible(const Monitor& monitor, const ParallelFor& parallelFor)
    : Progress(monitor)
    , Parallel(parallelFor)
  {
  }

  /// Sets the fraction that is reported from now on, unless a larger one is known: progress never falls. May be called
  /// from several threads.
  void raiseFraction(double fraction)
  {
    double known = this->Fraction;
    while (known < fraction && !this->Fraction.compare_exchange_weak(known, fraction))
    {
    }
  }

  /// Sets the number of particles of which the user is told at the next question, unless not many more are known: those
  /// found so far. May be called from several threads.
  void raiseExpected(double particles)
  {
    double known = this->Expected;
    while (known < particles && !this->Expected.compare_exchange_weak(known, particles))
    {
    }
  }

  void operator()(std::ptrdiff_t count, const LoopBody& body)
  {
    // So many chunks that many threads finish together, so small ones that each is short beside the period. Chosen by
    // experiment: larger chunks make the caller wait for an answer, smaller ones cost time to take.
    constexpr std::ptrdiff_t chunkCount = 64;
    constexpr std::ptrdiff_t largestChunk = 4096;
    // The first chunk of a thread is an eighth: how long an item takes is not known yet.
    constexpr std::ptrdiff_t unknown = 8;
    const std::ptrdiff_t largest = std::clamp<std::ptrdiff_t>(count / chunkCount, 1, largestChunk);
    std::atomic<std::ptrdiff_t> next{ 0 };
    this->askAtTimes();
    while (next < count)
    {
      const auto pause = Clock::now() + period;
      const auto work = [&](std::ptrdiff_t, std::ptrdiff_t)
      {
        std::ptrdiff_t chunk = std::max<std::ptrdiff_t>(1, largest / unknown);
        for (auto now = Clock::now(); next < count && now < pause;)
        {
          const std::ptrdiff_t begin = next.fetch_add(chunk);
          if (begin < count)
          {
            body(begin, std::min(count, begin + chunk));
          }
          const auto end = Clock::now();
          chunk = end - now > shortTime ? std::max<std::ptrdiff_t>(1, chunk / 2)
                                        : std::min(largest, 2 * chunk);
          now = end;
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

  /// See Monitor::expect.
  void expect(double particles) const
  {
    if (this->Progress.expect)
    {
      this->Progress.expect(particles);
    }
  }

private:
  using Clock = std::chrono::steady_clock;
  /// Between two questions: a user takes 0.05 s for at once. Threads start anew after each, which a shorter one would
  /// make noticeable.
  static constexpr std::chrono::milliseconds period{ 50 };
  /// Chunks that take longer are halved: a tenth of the period, so that the last one before a question does not delay it.
  /// Shorter: more chunks than the work needs.
  static constexpr std::chrono::milliseconds shortTime{ 5 };

  void tellExpected()
  {
    constexpr double many = 1.2; // times as many as before are worth a word
    const double expected = this->Expected;
    if (expected > many * this->Told)
    {
      this->Told = expected;
      this->expect(expected);
    }
  }

  void askAtTimes()
  {
    if (Clock::now() - this->LastAsked > period)
    {
      this->LastAsked = Clock::now();
      this->tellExpected();
      this->ask();
    }
  }

  const Monitor& Progress;
  const ParallelFor& Parallel;
  std::atomic<double> Fraction{ 0.0 };
  std::atomic<double> Expected{ 0.0 };
  double Told = 0.0;
  Clock::time_point LastAsked{};
};

/// What run() returns; where it was interrupted, an empty result whose report says so.
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
