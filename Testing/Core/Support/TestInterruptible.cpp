#include "Support/Interruptible.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace hop
{
namespace
{

/// Half of the work in a thread of its own.
void inTwoThreads(std::ptrdiff_t count, const LoopBody& body)
{
  std::thread other([&]() { body(0, count / 2); });
  body(count / 2, count);
  other.join();
}

TEST(Interruptible, DoesEveryPieceOnce)
{
  const Monitor monitor;
  const ParallelFor parallelFor = inTwoThreads;
  Interruptible work(monitor, parallelFor);
  for (const bool slow : { false, true })
  {
    for (const std::ptrdiff_t count : { 0, 1, 2, 64, 100, 101, 999, 1'000, 1'001, 5'000 })
    {
      std::vector<int> visits(count, 0);
      work(count,
        [&](std::ptrdiff_t begin, std::ptrdiff_t end)
        {
          for (; begin < end; ++begin)
          {
            ++visits[begin];
            std::this_thread::sleep_for(std::chrono::microseconds(slow ? 1 : 0));
          }
        });
      EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }))
        << count << (slow ? " slow" : " fast");
    }
  }
}

TEST(Interruptible, StopsWithinAFractionOfASecond)
{
  const Monitor monitor{ [](double) { return false; } };
  const ParallelFor parallelFor = inTwoThreads;
  Interruptible work(monitor, parallelFor);
  const auto start = std::chrono::steady_clock::now();
  const auto waitForAll = [](std::ptrdiff_t begin, std::ptrdiff_t end)
  { std::this_thread::sleep_for(std::chrono::milliseconds(10) * (end - begin)); };
  EXPECT_THROW(work(1'000, waitForAll), Interrupted);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  // Many short loops ask as often as a long one.
  EXPECT_THROW(
    for (int n = 0; n < 1'000; ++n) { runParallel(std::ref(work), 1, waitForAll); }, Interrupted);
}

/// Of items that take long few are taken at a time, however many there are.
TEST(Interruptible, AsksAfterFewItemsThatTakeLong)
{
  int questions = 0;
  const Monitor monitor{ [&](double) { return ++questions < 2; } };
  const ParallelFor parallelFor = inTwoThreads;
  Interruptible work(monitor, parallelFor);
  std::atomic<std::ptrdiff_t> items{ 0 };
  EXPECT_THROW(work(2'560,
                 [&](std::ptrdiff_t begin, std::ptrdiff_t end)
                 {
                   items += end - begin;
                   std::this_thread::sleep_for(std::chrono::milliseconds(10) * (end - begin));
                 }),
    Interrupted);
  EXPECT_LT(items, 32); // two threads, of a 64th of the items each: 80
}

} // namespace
} // namespace hop
