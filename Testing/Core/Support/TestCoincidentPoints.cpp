#include "Support/CoincidentPoints.h"

#include "Support/Random.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace hop::testing
{
namespace
{

Buffer<RoundedPoint> onLine(const std::vector<double>& places, const std::vector<double>& reaches)
{
  Buffer<RoundedPoint> points;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    points.push_back({ { places[i], 5.0, -3.0 }, reaches[i] });
  }
  return points;
}

/// Places far apart, at each of them some points that differ by rounding errors.
Buffer<RoundedPoint> roundedCloud(int places, double extent, double rounding)
{
  constexpr int copies = 5;
  Random random(3);
  const auto anywhere = [&](double size)
  { return size * (glm::dvec3(random.uniform(), random.uniform(), random.uniform()) - 0.5); };
  Buffer<RoundedPoint> points(static_cast<std::size_t>(places) * copies);
  for (int i = 0; i < places; ++i)
  {
    const glm::dvec3 place = anywhere(extent);
    for (int copy = 0; copy < copies; ++copy)
    {
      // Copies of a place stand far apart in the list.
      points[copy * places + i] = { place + anywhere(rounding), 2.0 * rounding };
    }
  }
  return points;
}

TEST(CoincidentPoints, AreNamedByTheFirstOfThem)
{
  const double r = 0.1;
  EXPECT_EQ(coincidentPoints(onLine({ 1, 2, 1, 1.05, 2.2, 0.99 }, { r, r, r, r, r, r })),
    (std::vector<int>{ 0, 1, 0, 0, 4, 0 }));
  EXPECT_TRUE(coincidentPoints({}).empty());
}

TEST(CoincidentPoints, ZeroHasNoSign)
{
  EXPECT_EQ(
    coincidentPoints(onLine({ 0.0, -0.0 }, { 1e-300, 1e-300 })), (std::vector<int>{ 0, 0 }));
}

TEST(CoincidentPoints, SidesOfAThinLayerStayApartWherePointsBesideItReachAcross)
{
  // The layer's own corners, 0 and 1, and those of the solids below and above, rounded.
  for (const double rounding : { 0.0, 1e-4 })
  {
    EXPECT_EQ(coincidentPoints(onLine({ 0, 1, rounding, 1 - rounding }, { 0.01, 0.01, 5, 5 })),
      (std::vector<int>{ 0, 1, 0, 1 }))
      << rounding;
  }
  EXPECT_EQ(coincidentPoints(onLine({ 0, 1 }, { 5, 5 })), (std::vector<int>{ 0, 0 }));
}

TEST(CoincidentPoints, DoNotDependOnTheirOrderNorOnThreads)
{
  const Buffer<RoundedPoint> points = roundedCloud(20'000, 100.0, 1e-5);
  const std::vector<int> places = coincidentPoints(points);
  for (int i = 0; i < static_cast<int>(places.size()); ++i)
  {
    ASSERT_EQ(places[i], i % 20'000);
  }
  EXPECT_EQ(coincidentPoints(points, threadedFor(3)), places);

  Buffer<RoundedPoint> reversed = points;
  std::reverse(reversed.begin(), reversed.end());
  const std::vector<int> there = coincidentPoints(reversed);
  const int last = static_cast<int>(points.size()) - 1;
  for (int i = 0; i <= last; ++i)
  {
    ASSERT_EQ(places[last - there[last - i]], places[i]);
  }
}

TEST(CoincidentPoints, ChainsAreFollowedInEitherDirection)
{
  // 1.4 and 0.6 come together last: by then the place of 0.6 reaches less.
  const std::vector<double> x{ 0.0, 0.6, 1.4, 2.1 };
  const std::vector<double> reaches{ 0.7, 0.9, 0.9, 0.9 };
  const std::vector<int> places = coincidentPoints(onLine(x, reaches));
  EXPECT_EQ(places, (std::vector<int>{ 0, 0, 2, 2 }));
  EXPECT_EQ(coincidentPoints(onLine({ 2.1, 1.4, 0.6, 0.0 }, { 0.9, 0.9, 0.9, 0.7 })),
    (std::vector<int>{ 0, 0, 2, 2 }));
}

/// A fine region in a domain 1e8 times as wide: with cells of one size all of it falls into one, and
/// every point would be held against every other one, which takes minutes.
TEST(CoincidentPoints, FineRegionsInLargeDomains)
{
  constexpr int side = 400;
  Buffer<RoundedPoint> points;
  for (int i = 0; i < side * side; ++i)
  {
    for (const double rounding : { 0.0, 1e-13 })
    {
      points.push_back({ { 1e-8 * (i % side) + rounding, 1e-8 * (i / side), 0.0 }, 1e-10 });
    }
  }
  for (const double x : { -1.0, 1.0 })
  {
    points.push_back({ { x, x, 0.0 }, 1e-2 });
  }
  const std::vector<int> places = coincidentPoints(points);
  for (int i = 0; i < 2 * side * side; ++i)
  {
    ASSERT_EQ(places[i], i - i % 2);
  }
}

} // namespace
} // namespace hop::testing
