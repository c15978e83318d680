#include "Common/Monitor.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>

namespace hop
{

void runInThreads(const ParallelFor& parallelFor, std::ptrdiff_t count, const LoopBody& body)
{
  if (!parallelFor)
  {
    if (count > 0)
    {
      body(0, count);
    }
    return;
  }
  std::atomic<bool> failed{ false };
  std::exception_ptr failure;
  parallelFor(count,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      try
      {
        body(begin, end);
      }
      catch (...)
      {
        if (!failed.exchange(true))
        {
          failure = std::current_exception();
        }
      }
    });
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

std::ptrdiff_t runAlone(std::ptrdiff_t count, const LoopBody& body)
{
  // All chosen by experiment.
  using Clock = std::chrono::steady_clock;
  // About the time that threads take to start. Longer loops are given to them; were this smaller, threads would start
  // for loops that are done before.
  constexpr std::chrono::microseconds startOfThreads{ 30 };
  // Shorter times tell nothing about the rest of the loop: the first items may take long only because they come first.
  constexpr std::chrono::microseconds leastTime{ 10 };
  // The first piece is this part of the loop, a thousandth; a larger one could take long itself.
  constexpr std::ptrdiff_t firstShare = 1000;
  // No piece is more than this part of the loop, a sixteenth: easy items at the beginning do not tell that later ones
  // are easy.
  constexpr std::ptrdiff_t largestShare = 16;
  const auto start = Clock::now();
  std::ptrdiff_t done = 0;
  std::ptrdiff_t end = std::min(count, 1 + count / firstShare);
  while (done < count)
  {
    body(done, end);
    done = end;
    const auto time = Clock::now() - start;
    if (time > leastTime && time * count / done > startOfThreads)
    {
      break;
    }
    end = std::min(count, done + std::min(done, 1 + count / largestShare));
  }
  return done;
}

void runParallel(const ParallelFor& parallelFor, std::ptrdiff_t count, const LoopBody& body)
{
  const std::ptrdiff_t done = parallelFor ? runAlone(count, body) : 0;
  runInThreads(parallelFor, count - done,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end) { body(done + begin, done + end); });
}

} // namespace hop
