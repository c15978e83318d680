#include "Surface/SpacingSearch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hop::testing
{
namespace
{

/// Hexagonal packing on an area: A / (sqrt(3)/2 h^2) particles.
double hexagonalCount(double area, double spacing)
{
  return area / (std::sqrt(0.75) * spacing * spacing);
}

TEST(SpacingSearch, FlatSurfaceIsFoundInTwoTries)
{
  for (const double area : { 1e-10, 1.0, 1e12 })
  {
    for (const std::int64_t given : { 1, 7, 1000, 100'000'000 })
    {
      for (const double firstPerRight : { 1e-3, 0.5, 0.9, 30.0 })
      {
        const double right = std::sqrt(hexagonalCount(area, 1.0) / static_cast<double>(given));
        int tries = 0;
        const double spacing = findSpacing(given, firstPerRight * right,
          [&](double h)
          {
            ++tries;
            return hexagonalCount(area, h);
          });
        EXPECT_EQ(tries, 2);
        EXPECT_NEAR(spacing / right, 1.0, 1e-12);
      }
    }
  }
}

TEST(SpacingSearch, BoundaryCurvesAndCurvatureTakeAFewTries)
{
  // Half a particle a spacing on a boundary curve of length 8, and closer spacings where the surface bends.
  const auto count = [](double h)
  { return hexagonalCount(4.0, h / (1.0 + 3.0 * std::min(1.0, h))) + 0.5 * 8.0 / h; };
  for (const std::int64_t given : { 50, 1000, 100'000 })
  {
    for (const double first : { 0.001, 0.02, 2.0 })
    {
      int tries = 0;
      const double spacing = findSpacing(given, first,
        [&](double h)
        {
          ++tries;
          return count(h);
        });
      EXPECT_LE(tries, 6);
      EXPECT_NEAR(count(spacing) / static_cast<double>(given), 1.0, SpacingSearch::Tolerance);
    }
  }
}

TEST(SpacingSearch, NumberWithinTheToleranceKeepsTheFirstSpacing)
{
  for (const double counted : { 99.5, 100.0, 100.5 })
  {
    EXPECT_EQ(findSpacing(100, 0.3, [&](double) { return counted; }), 0.3);
  }
  SpacingSearch search(100, 0.3);
  search.update(101.5);
  EXPECT_FALSE(search.isOver());
  EXPECT_DOUBLE_EQ(search.spacing(), 0.3 * std::sqrt(1.015));
}

TEST(SpacingSearch, EndsWhereThereIsNoSurface)
{
  for (const double counted : { 0.0, std::nan("") })
  {
    int tries = 0;
    EXPECT_EQ(findSpacing(100, 0.3,
                [&](double)
                {
                  ++tries;
                  return counted;
                }),
      0.3);
    EXPECT_EQ(tries, 1);
  }
}

TEST(SpacingSearch, EndsAfterEightTriesAtASpacingThatWasCounted)
{
  // Components smaller than any spacing: the number does not follow the spacing.
  std::vector<double> tried;
  const double spacing = findSpacing(100, 0.3,
    [&](double h)
    {
      tried.push_back(h);
      return 50.0;
    });
  ASSERT_EQ(tried.size(), 8u);
  EXPECT_EQ(spacing, tried.back());
  EXPECT_LT(spacing, tried[6]);
}

TEST(SpacingSearch, TriesNothingLargerThanTheLargest)
{
  // Four corners, and boxes that have a particle each: no spacing gives one particle.
  std::vector<double> tried;
  const auto count = [&](double h)
  {
    tried.push_back(h);
    return 4.0 + 60.0 / h;
  };
  EXPECT_EQ(findSpacing(1, 0.3, count, SpacingSearch::Tolerance, 2.0), 2.0);
  EXPECT_EQ(tried, (std::vector<double>{ 0.3, 2.0 }));
  tried.clear();
  EXPECT_EQ(findSpacing(1, 90.0, count, SpacingSearch::Tolerance, 2.0), 2.0);
  EXPECT_EQ(tried, std::vector<double>{ 2.0 });
  // What is found below it is found as without it.
  const auto flat = [](double h) { return hexagonalCount(1.0, h); };
  EXPECT_EQ(
    findSpacing(100, 0.3, flat, SpacingSearch::Tolerance, 2.0), findSpacing(100, 0.3, flat));
}

TEST(SpacingSearch, StaysAsItIsOnceItIsOver)
{
  SpacingSearch search(100, 0.3);
  search.update(100.0);
  ASSERT_TRUE(search.isOver());
  search.update(400.0);
  EXPECT_TRUE(search.isOver());
  EXPECT_EQ(search.spacing(), 0.3);
}

} // namespace
TEST(SpacingSearch, EndsWhereCornersSetTheNumber)
{
  int tries = 0;
  const auto count = [&](double spacing)
  {
    ++tries;
    return 200.0 + 10.0 / (spacing * spacing);
  };
  findSpacing(7, 0.1, count);
  EXPECT_LE(tries, 4);
}

TEST(SpacingSearch, GoesOnAsLongAsTheNumberFalls)
{
  int tries = 0;
  const auto count = [&](double spacing)
  {
    ++tries;
    return 10.0 / spacing;
  };
  EXPECT_NEAR(count(findSpacing(7, 0.1, count)), 7.0, 0.2);
  EXPECT_GT(tries, 5);
}

} // namespace hop::testing
