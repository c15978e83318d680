#include "Common/ThreadTeam.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace hop::testing
{
namespace
{

/// How often each piece of a loop was done.
std::vector<int> visitsOf(ThreadTeam& team, std::ptrdiff_t count)
{
  std::vector<int> visits(count, 0);
  team.run(count,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        ++visits[i];
      }
    });
  return visits;
}

TEST(ThreadTeam, DoesEverythingOnce)
{
  for (const int size : { 1, 2, 3, 8 })
  {
    ThreadTeam team(size);
    for (const std::ptrdiff_t count : { 0, 1, 2, 31, 32, 33, 1'000, 100'003 })
    {
      EXPECT_EQ(visitsOf(team, count), std::vector<int>(count, 1)) << size << " threads";
    }
  }
}

TEST(ThreadTeam, IsReadyForTheNextLoopAtOnce)
{
  ThreadTeam team(4);
  std::atomic<std::ptrdiff_t> done{ 0 };
  constexpr std::ptrdiff_t loops = 20'000;
  for (std::ptrdiff_t n = 0; n < loops; ++n)
  {
    team.run(4, [&](std::ptrdiff_t begin, std::ptrdiff_t end) { done += end - begin; });
    ASSERT_EQ(done, 4 * (n + 1));
  }
}

/// Pieces that wait until there are as many threads.
TEST(ThreadTeam, RunsInAllItsThreads)
{
  constexpr int size = 3;
  ThreadTeam team(size);
  std::mutex mutex;
  std::condition_variable change;
  std::set<std::thread::id> threads;
  team.run(1'000,
    [&](std::ptrdiff_t, std::ptrdiff_t)
    {
      std::unique_lock<std::mutex> lock(mutex);
      threads.insert(std::this_thread::get_id());
      change.notify_all();
      change.wait_for(lock, std::chrono::seconds(20), [&]() { return threads.size() == size; });
    });
  EXPECT_EQ(threads.size(), size);
  EXPECT_TRUE(threads.count(std::this_thread::get_id()));
}

TEST(ThreadTeam, LoopsWithinLoopsRunWhereTheyAre)
{
  ThreadTeam team(3);
  std::atomic<int> done{ 0 };
  team.run(50,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      const auto own = std::this_thread::get_id();
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        team.run(7,
          [&](std::ptrdiff_t first, std::ptrdiff_t last)
          {
            EXPECT_EQ(std::this_thread::get_id(), own);
            done += static_cast<int>(last - first);
          });
      }
    });
  EXPECT_EQ(done, 50 * 7);
}

TEST(ThreadTeam, OutlivesALoopThatThrows)
{
  ThreadTeam team(3);
  const auto own = std::this_thread::get_id();
  std::atomic<bool> thrown{ false };
  const auto body = [&](std::ptrdiff_t, std::ptrdiff_t)
  {
    if (std::this_thread::get_id() == own)
    {
      thrown = true;
      throw std::runtime_error("no memory");
    }
    while (!thrown)
    {
      std::this_thread::yield();
    }
  };
  EXPECT_THROW(team.run(100, body), std::runtime_error);
  EXPECT_EQ(visitsOf(team, 100), std::vector<int>(100, 1));
}

} // namespace
} // namespace hop::testing
