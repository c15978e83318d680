#include "Support/KeepFirst.h"

#include "Support/Random.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

using Marks = std::vector<char>;

/// Places on a line; two are too near to each other below a distance.
Marks keepOnLine(const std::vector<double>& places, const Marks& wanted, double distance,
  const ParallelFor& parallelFor = {})
{
  return keepFirst(wanted, places.size(), parallelFor,
    [&](std::size_t i, const auto& use)
    {
      for (std::size_t j = 0; j < places.size(); ++j)
      {
        if (j != i && std::abs(places[i] - places[j]) < distance)
        {
          use(j);
        }
      }
    });
}

TEST(KeepFirst, TheFirstOfTwoStays)
{
  EXPECT_EQ(keepOnLine({ 0.0, 0.5, 1.0, 2.0 }, { 1, 1, 1, 1 }, 0.6), (Marks{ 1, 0, 1, 1 }));
  EXPECT_EQ(keepOnLine({ 2.0, 1.0, 0.5, 0.0 }, { 1, 1, 1, 1 }, 0.6), (Marks{ 1, 1, 0, 1 }));
}

TEST(KeepFirst, CandidatesWithoutMarkAreDroppedAndKeepNoneAway)
{
  EXPECT_EQ(keepOnLine({ 0.0, 0.5, 1.0 }, { 0, 1, 1 }, 0.6), (Marks{ 0, 1, 0 }));
}

TEST(KeepFirst, ItemsBehindTheCandidatesStayAndKeepThemAway)
{
  EXPECT_EQ(keepOnLine({ 0.0, 1.0, 1.5 }, { 1, 1 }, 0.6), (Marks{ 1, 0 }));
}

/// One by one, without threads, as the rule says.
TEST(KeepFirst, IsTheSameForAnyNumberOfThreads)
{
  constexpr std::size_t count = 400;
  constexpr std::size_t candidates = 350;
  constexpr double distance = 0.5;
  Random random(3);
  std::vector<double> places;
  Marks wanted;
  for (std::size_t i = 0; i < count; ++i)
  {
    places.push_back(100.0 * random.uniform());
    wanted.push_back(random.uniform() < 0.8);
  }
  Marks expected = wanted;
  std::fill(expected.begin() + candidates, expected.end(), 1);
  const auto isFree = [&](std::size_t i)
  {
    bool free = true;
    for (std::size_t j = 0; j < count; ++j)
    {
      const bool counts = j < i || j >= candidates;
      free = free && !(counts && expected[j] && std::abs(places[i] - places[j]) < distance);
    }
    return free;
  };
  for (std::size_t i = 0; i < candidates; ++i)
  {
    expected[i] = wanted[i] && isFree(i);
  }
  expected.resize(candidates);
  wanted.resize(candidates);
  EXPECT_GT(std::count(expected.begin(), expected.end(), 1), 30);
  EXPECT_LT(std::count(expected.begin(), expected.end(), 1), 200);
  EXPECT_EQ(keepOnLine(places, wanted, distance), expected);
  for (const int threads : { 2, 3, 8 })
  {
    EXPECT_EQ(keepOnLine(places, wanted, distance, threadedFor(threads)), expected) << threads;
  }
}

} // namespace
} // namespace hop::testing
