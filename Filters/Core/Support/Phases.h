#pragma once

#include "Common/Monitor.h"
#include "Support/SharedPieces.h"

#include <atomic>
#include <thread>
#include <vector>

namespace hop
{

/// Runs phases of work one after the other: all pieces of one, in any order, before the first of the next.
/// Threads are started once for all phases, which pays where a phase takes no longer than that.
///
/// Threads take pieces as they come and wait only for pieces that another thread is at work on, so that nothing depends
/// on how many threads there are or when they start.
/// \param pieceCount pieceCount(phase)
/// \param body body(phase, piece)
template <class PieceCount, class Body>
void runPhases(
  const ParallelFor& parallelFor, int phases, const PieceCount& pieceCount, const Body& body)
{
  // Pieces of the loop that starts the threads: as many threads as take one of them work on the phases. With fewer,
  // large machines would not be used; each further one costs a call that finds nothing to do.
  constexpr std::ptrdiff_t mostThreads = 64;
  std::vector<SharedPieces> pieces(phases);
  std::vector<std::atomic<std::ptrdiff_t>> done(phases);
  std::atomic<int> current{ 0 };
  std::atomic<int> workers{ 0 };
  std::atomic<bool> failed{ false };
  const auto run = [&](int phase, std::ptrdiff_t piece)
  {
    try
    {
      body(phase, piece);
    }
    catch (...)
    {
      failed = true; // or other threads would wait for this piece
      throw;
    }
  };
  const auto work = [&](std::ptrdiff_t, std::ptrdiff_t)
  {
    const int worker = workers++;
    for (int phase = current; phase < phases; ++phase)
    {
      const std::ptrdiff_t count = pieceCount(phase);
      std::ptrdiff_t mine = 0;
      pieces[phase].take(worker, count,
        [&](std::ptrdiff_t piece)
        {
          if (!failed)
          {
            run(phase, piece);
            ++mine;
          }
          return !failed;
        });
      done[phase] += mine;
      while (done[phase] < count && !failed)
      {
        std::this_thread::yield();
      }
      current = phase + 1;
    }
  };
  runInThreads(parallelFor, mostThreads, work);
}

} // namespace hop
