#include "Common/Monitor.h"

#include "Common/ThreadTeam.h"
#include "Support/Phases.h"
#include "Support/SharedPieces.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>
#include <vector>

namespace hop::testing
{
namespace
{

void sleep(std::ptrdiff_t microseconds)
{
  std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
}

TEST(RunParallel, DoesEveryPieceOnce)
{
  for (const int microseconds : { 0, 1 })
  {
    for (const std::ptrdiff_t count : { 0, 1, 2, 64, 999, 1'000, 1'001, 5'000 })
    {
      std::vector<int> visits(count, 0);
      forAll(threadedFor(2), visits.size(),
        [&](std::size_t i)
        {
          ++visits[i];
          if (microseconds > 0)
          {
            sleep(microseconds);
          }
        });
      EXPECT_EQ(visits, std::vector<int>(count, 1)) << microseconds << " us";
    }
  }
}

TEST(RunParallel, GoesOnInThreadsWhereTheWorkTurnsOutToBeLong)
{
  const auto own = std::this_thread::get_id();
  for (const std::size_t count : { 8, 1'000 })
  {
    std::atomic<std::size_t> inOthers{ 0 };
    forAll(threadedFor(2), count,
      [&](std::size_t i)
      {
        inOthers += std::this_thread::get_id() != own;
        sleep(i < count / 2 ? 0 : 500);
      });
    EXPECT_GT(inOthers, count / 4);
  }
}

TEST(RunParallel, TellsTheSeamOfLoopsThatAreOver)
{
  // It may ask for an early end between them.
  std::vector<std::ptrdiff_t> left;
  const ParallelFor parallelFor = [&](std::ptrdiff_t count, const LoopBody&)
  { left.push_back(count); };
  forAll(parallelFor, 1, [](std::size_t) {});
  EXPECT_EQ(left, std::vector<std::ptrdiff_t>{ 0 });
}

TEST(SharedPieces, AreTakenOnceAndOnesOwnFirst)
{
  constexpr std::ptrdiff_t count = 40;
  for (const int workers : { 1, 2, 3, 10 })
  {
    SharedPieces pieces;
    std::vector<int> taken(count, 0);
    std::vector<std::ptrdiff_t> first;
    // Each takes one, then the last one all that are left.
    for (int worker = 0; worker < workers; ++worker)
    {
      pieces.take(worker, count,
        [&](std::ptrdiff_t piece)
        {
          ++taken[piece];
          first.push_back(piece);
          return worker + 1 == workers;
        });
    }
    EXPECT_EQ(taken, std::vector<int>(count, 1)) << workers;
    EXPECT_EQ(first[0], 0);
    EXPECT_EQ(first[1], workers == 1 ? 1 : count / 2);
  }
}

TEST(SharedPieces, MayBeFewOrNone)
{
  for (const std::ptrdiff_t count : { 0, 1, 3 })
  {
    SharedPieces pieces;
    std::ptrdiff_t taken = 0;
    const auto take = [&](std::ptrdiff_t)
    {
      ++taken;
      return true;
    };
    pieces.take(1, count, take);
    pieces.take(0, count, take);
    EXPECT_EQ(taken, count);
  }
}

/// Pieces that wait for each other: threads are there from the start.
TEST(RunPhases, LeavesAllPiecesToThreads)
{
  std::atomic<int> arrived{ 0 };
  std::atomic<bool> metOther{ true };
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  runPhases(
    threadedFor(2), 1, [](int) { return std::ptrdiff_t{ 2 }; },
    [&](int, std::ptrdiff_t)
    {
      ++arrived;
      while (arrived < 2 && metOther)
      {
        metOther = std::chrono::steady_clock::now() < patience;
        std::this_thread::yield();
      }
    });
  EXPECT_TRUE(metOther);
}

TEST(RunPhases, FinishesOneBeforeTheNext)
{
  constexpr int phases = 20;
  constexpr std::ptrdiff_t pieces = 5;
  for (const ParallelFor& parallelFor : { ParallelFor(), threadedFor(1), threadedFor(3) })
  {
    std::atomic<int> done{ 0 };
    std::atomic<int> early{ 0 };
    runPhases(
      parallelFor, phases, [](int) { return pieces; },
      [&](int phase, std::ptrdiff_t)
      {
        early += done < phase * pieces;
        ++done;
      });
    EXPECT_EQ(done, phases * pieces);
    EXPECT_EQ(early, 0);
  }
}

/// A loop with a piece that throws in a thread that is not the caller's.
TEST(RunInThreads, HandsOnWhatAThreadThrows)
{
  ThreadTeam team(3);
  const ParallelFor parallelFor = [&](std::ptrdiff_t count, const LoopBody& body)
  { team.run(count, body); };
  const auto own = std::this_thread::get_id();
  std::atomic<bool> thrown{ false };
  const auto body = [&](std::ptrdiff_t, std::ptrdiff_t)
  {
    if (std::this_thread::get_id() != own && !thrown.exchange(true))
    {
      throw std::bad_alloc();
    }
    while (!thrown)
    {
      std::this_thread::yield();
    }
  };
  EXPECT_THROW(runInThreads(parallelFor, 1'000, body), std::bad_alloc);
}

TEST(RunPhases, EndsWhereAPieceThrows)
{
  for (const ParallelFor& parallelFor : { ParallelFor(), threadedFor(3) })
  {
    std::atomic<int> last{ 0 };
    const auto body = [&](int phase, std::ptrdiff_t piece)
    {
      last = phase;
      if (phase == 3 && piece == 2)
      {
        throw std::bad_alloc();
      }
    };
    EXPECT_THROW(runPhases(
                   parallelFor, 20, [](int) { return std::ptrdiff_t{ 5 }; }, body),
      std::bad_alloc);
    EXPECT_EQ(last, 3);
  }
}

} // namespace
} // namespace hop::testing
