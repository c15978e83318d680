#include "Support/SpacingGrid.h"

#include "Support/Random.h"
#include "Support/SpacedPoints.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace hop::testing
{
namespace
{

/// Somewhat more than the distance of second neighbours in hexagonal packing.
constexpr double reach = 1.8;

/// Points in a slab, whose spacing doubles from one end to the other so often; so slowly that it differs by less than a
/// factor of two among points that see each other.
SpacedPoints slab(std::size_t count, double doublings, const ParallelFor& parallelFor = {})
{
  Random random(11);
  std::vector<glm::dvec3> places(count);
  for (glm::dvec3& x : places)
  {
    x = { random.uniform() - 5.0, 0.3 * random.uniform(), 0.05 * random.uniform() + 3.0 };
  }
  return SpacedPoints(
    count, [&](std::size_t i) { return places[i]; },
    [&](std::size_t i) { return 0.02 * std::exp2(doublings * (places[i].x + 5.0)); }, parallelFor);
}

bool seeEachOther(const SpacedPoints& points, std::size_t i, std::size_t j)
{
  const double sum = 1.0 / points.spacings[i] + 1.0 / points.spacings[j];
  return glm::distance(points.positions[i], points.positions[j]) * sum <= 2.0 * reach;
}

/// What a visit comes to, in its order.
template <class Visit>
std::vector<int> visited(const Visit& visit)
{
  std::vector<int> all;
  visit([&](int j) { all.push_back(j); });
  return all;
}

/// Each of `expected` was visited, and none twice.
void expectAmong(const std::vector<int>& expected, std::vector<int> all)
{
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
  EXPECT_TRUE(std::includes(all.begin(), all.end(), expected.begin(), expected.end()));
}

template <class IsExpected>
std::vector<int> byBruteForce(std::size_t count, const IsExpected& isExpected)
{
  std::vector<int> found;
  for (std::size_t j = 0; j < count; ++j)
  {
    if (isExpected(j))
    {
      found.push_back(static_cast<int>(j));
    }
  }
  return found;
}

TEST(SpacingGrid, VisitsAllThatAPointSees)
{
  for (const double doublings : { 0.0, 1.0, 3.0 })
  {
    const SpacedPoints points = slab(1500, doublings);
    for (const double cellsPerReach : { 0.5, 1.0 })
    {
      const SpacingGrid grid(points.positions, points.spacings, reach, cellsPerReach);
      std::size_t seen = 0, looked = 0;
      for (std::size_t i = 0; i < points.positions.size(); ++i)
      {
        const auto all = visited(
          [&](const auto& use) { grid.visit(points.positions[i], points.spacings[i], use); });
        const auto expected = byBruteForce(
          points.positions.size(), [&](std::size_t j) { return seeEachOther(points, i, j); });
        expectAmong(expected, all);
        seen += expected.size();
        looked += all.size();
      }
      // In space, a sphere is a sixth of the cells that hold it in the worst place; a slab has fewer cells.
      EXPECT_LT(looked, 12 * seen) << doublings << ' ' << cellsPerReach;
      EXPECT_GT(seen, 5 * points.positions.size());
    }
  }
}

TEST(SpacingGrid, AnswersForPlacesThatAreNoPointsToo)
{
  const SpacedPoints points = slab(1500, 0.0);
  const SpacingGrid grid(points.positions, points.spacings, reach);
  const double radius = reach * points.spacings[0];
  // Inside, at an edge of the bounds, beside them, and far off on either side.
  for (const glm::dvec3& x : { glm::dvec3(-4.5, 0.15, 3.025), glm::dvec3(-4.0, 0.15, 3.05),
         glm::dvec3(-5.01, 0.15, 3.02), glm::dvec3(-1e9), glm::dvec3(1e9) })
  {
    const auto expected = byBruteForce(points.positions.size(),
      [&](std::size_t j) { return glm::distance(points.positions[j], x) <= radius; });
    EXPECT_EQ(expected.empty(), std::abs(x.x) > 6.0);
    expectAmong(
      expected, visited([&](const auto& use) { grid.visit(x, points.spacings[0], use); }));
  }
}

TEST(SpacingGrid, CellMatesPartThePoints)
{
  const SpacedPoints points = slab(1500, 3.0);
  const SpacingGrid grid(points.positions, points.spacings, reach);
  const double smallest = *std::min_element(points.spacings.begin(), points.spacings.end());
  std::set<int> firsts;
  std::size_t count = 0;
  for (int i = 0; i < 1500; ++i)
  {
    const SpacingGrid::Points mates = grid.cellMates(i);
    EXPECT_TRUE(std::is_sorted(mates.begin(), mates.end()));
    EXPECT_EQ(std::count(mates.begin(), mates.end(), i), 1);
    if (firsts.insert(*mates.begin()).second)
    {
      count += mates.end() - mates.begin();
    }
    const int level = std::ilogb(points.spacings[i] / smallest);
    const double edge = reach * std::ldexp(smallest, level + 1);
    for (const int j : mates)
    {
      EXPECT_EQ(std::ilogb(points.spacings[j] / smallest), level);
      const glm::dvec3 apart = glm::abs(points.positions[i] - points.positions[j]);
      EXPECT_LE(std::max({ apart.x, apart.y, apart.z }), edge * (1.0 + 1e-12));
    }
  }
  EXPECT_EQ(count, 1500u);
  EXPECT_GT(firsts.size(), 30u);
}

TEST(SpacingGrid, VisitsAroundACellWhatItsPointsSee)
{
  const SpacedPoints points = slab(1500, 3.0);
  const SpacingGrid grid(points.positions, points.spacings, reach);
  for (int i = 0; i < 1500; i += 7)
  {
    const SpacingGrid::Points mates = grid.cellMates(i);
    const auto all = visited([&](const auto& use) { grid.visitAround(mates, use); });
    for (const int mate : mates)
    {
      expectAmong(
        byBruteForce(1500, [&](std::size_t j) { return seeEachOther(points, mate, j); }), all);
    }
  }
}

TEST(SpacingGrid, MayBeEmptyOrHaveAllPointsInOnePlace)
{
  const SpacingGrid none(Buffer<glm::dvec3>(), Buffer<float>(), reach);
  none.visit(glm::dvec3(0.0), 1.0, [](int) { ADD_FAILURE(); });

  const Buffer<glm::dvec3> positions(20, glm::dvec3(2.0));
  const Buffer<float> spacings(20, 0.5f);
  const SpacingGrid grid(positions, spacings, reach);
  EXPECT_EQ(visited([&](const auto& use) { grid.visit(glm::dvec3(2.0), 0.5, use); }).size(), 20u);
  EXPECT_TRUE(visited([&](const auto& use) { grid.visit(glm::dvec3(9.0), 0.5, use); }).empty());
  EXPECT_EQ(grid.cellMates(7).end() - grid.cellMates(7).begin(), 20);
}

TEST(SpacingGrid, HoldsSpacingsOfMoreLevelsThanItHas)
{
  // Two pairs that see each other, 2^18 apart in spacing.
  const Buffer<glm::dvec3> positions{ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 1e6, 0.0, 0.0 },
    { 1e6, 262144.0, 0.0 } };
  const Buffer<float> spacings{ 1.0f, 1.0f, 262144.0f, 262144.0f };
  const SpacingGrid grid(positions, spacings, reach);
  for (int i = 0; i < 4; ++i)
  {
    expectAmong({ i / 2 * 2, i / 2 * 2 + 1 },
      visited([&](const auto& use) { grid.visit(positions[i], spacings[i], use); }));
  }
}

TEST(SpacingGrid, VisitsInTheSameOrderWhateverTheThreads)
{
  const SpacedPoints points = slab(20000, 3.0);
  const SpacingGrid alone(points.positions, points.spacings, reach);
  const SpacingGrid together(points.positions, points.spacings, reach, 1.0, threadedFor(4));
  for (std::size_t i = 0; i < points.positions.size(); i += 101)
  {
    const auto visit = [&](const SpacingGrid& grid)
    {
      return visited(
        [&](const auto& use) { grid.visit(points.positions[i], points.spacings[i], use); });
    };
    EXPECT_EQ(visit(together), visit(alone));
  }
}

TEST(SeenLists, HoldWhatPointsSeeAndNothingElse)
{
  const SpacedPoints points = slab(1500, 3.0);
  const SeenLists lists(points.positions, points.spacings, reach, {});
  ASSERT_EQ(lists.size(), 1500u);
  for (std::size_t i = 0; i < lists.size(); ++i)
  {
    std::vector<int> found(lists.begin(i), lists.end(i));
    ASSERT_EQ(static_cast<int>(found.size()), lists.count(i));
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found,
      byBruteForce(1500, [&](std::size_t j) { return j != i && seeEachOther(points, i, j); }));
  }
}

TEST(SeenLists, AreTheSameWhateverTheThreads)
{
  const SpacedPoints points = slab(20000, 3.0);
  const SeenLists alone(points.positions, points.spacings, reach, {});
  const SeenLists together(points.positions, points.spacings, reach, threadedFor(4));
  for (std::size_t i = 0; i < alone.size(); ++i)
  {
    ASSERT_EQ(std::vector<int>(together.begin(i), together.end(i)),
      std::vector<int>(alone.begin(i), alone.end(i)));
  }
}

TEST(SeenLists, MayBeNone)
{
  EXPECT_EQ(SeenLists(Buffer<glm::dvec3>(), Buffer<float>(), reach, {}).size(), 0u);
}

} // namespace
} // namespace hop::testing
