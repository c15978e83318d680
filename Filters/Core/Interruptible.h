#pragma once

#include "Monitor.h"

#include <algorithm>
#include <chrono>

namespace hop
{

/// Thrown where the monitor asked for an early end.
struct Interrupted
{
};

/// A ParallelFor that asks a monitor between pieces of the work, about ten times a second, and throws
/// Interrupted where it should stop. The pieces grow until each takes its share of time, so that short
/// loops run undivided.
class Interruptible
{
public:
  Interruptible(const Monitor& monitor, const ParallelFor& parallelFor)
    : Progress(monitor)
    , Parallel(parallelFor)
  {
  }

  /// What is reported from now on.
  void setFraction(double fraction) { this->Fraction = fraction; }
  double fraction() const { return this->Fraction; }

  void operator()(
    std::ptrdiff_t count, const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& body)
  {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds longEnough{ 20 };
    constexpr std::chrono::milliseconds period{ 50 };
    std::ptrdiff_t piece = 1024;
    for (std::ptrdiff_t begin = 0; begin < count;)
    {
      const std::ptrdiff_t end = std::min(count, begin + piece);
      const auto start = Clock::now();
      runParallel(this->Parallel, end - begin,
        [&](std::ptrdiff_t first, std::ptrdiff_t last) { body(begin + first, begin + last); });
      const auto now = Clock::now();
      piece *= now - start < longEnough ? 4 : 1;
      begin = end;
      if (now - this->LastAsked > period)
      {
        this->LastAsked = now;
        this->ask();
      }
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
  const Monitor& Progress;
  const ParallelFor& Parallel;
  double Fraction = 0.0;
  std::chrono::steady_clock::time_point LastAsked{};
};

} // namespace hop
