#include "Mesh/PolygonTriangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace hop::testing
{
namespace
{

constexpr double forbidden = std::numeric_limits<double>::infinity();

bool anyPair(int a, int b)
{
  return a != b;
}

double noCost(const Triangle&)
{
  return 1.0;
}

TEST(PolygonTriangulation, TakesTheCheaperDiagonal)
{
  const auto cost = [](const Triangle& triangle)
  { return std::set<int>(triangle.begin(), triangle.end()).count(2) > 0 ? 1.0 : 5.0; };
  // (0, 1, 2) and (0, 2, 3) cost 2; the other two cost 6.
  const std::vector<Triangle> triangles = triangulatePolygon({ 0, 1, 2, 3 }, cost, 1.0, anyPair);
  ASSERT_EQ(triangles.size(), 2u);
  for (const Triangle& triangle : triangles)
  {
    EXPECT_EQ(std::set<int>(triangle.begin(), triangle.end()).count(2), 1u);
  }
}

TEST(PolygonTriangulation, KeepsToEdgesThatAreAllowed)
{
  const auto notFromZero = [](int a, int b) { return a != 0 && b != 0; };
  const std::vector<Triangle> triangles =
    triangulatePolygon({ 0, 1, 2, 3 }, noCost, 1.0, notFromZero);
  EXPECT_EQ(triangles, (std::vector<Triangle>{ { 0, 1, 3 }, { 1, 2, 3 } }));
}

TEST(PolygonTriangulation, FindsNoneWhereThereIsNone)
{
  EXPECT_TRUE(
    triangulatePolygon({ 0, 1, 2, 3 }, noCost, 1.0, [](int, int) { return false; }).empty());
  EXPECT_TRUE(triangulatePolygon(
    { 0, 1, 2 }, [](const Triangle&) { return forbidden; }, 0.0, anyPair)
                .empty());
  EXPECT_TRUE(triangulatePolygon({ 0, 1 }, noCost, 1.0, anyPair).empty());
  EXPECT_TRUE(triangulatePolygon({}, noCost, 1.0, anyPair).empty());
}

TEST(PolygonTriangulation, PassesCornersThatOccurTwice)
{
  // A square with the particle 4 in it, to which the border runs from 0 and back.
  const auto cost = [](const Triangle& t)
  { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ? forbidden : 1.0; };
  const auto mayJoin = [](int a, int b) {
    return a != b && std::set<int>{ a, b } != std::set<int>{ 0, 2 };
  };
  const std::vector<Triangle> triangles =
    triangulatePolygon({ 0, 1, 2, 3, 0, 4 }, cost, 1.0, mayJoin);
  ASSERT_EQ(triangles.size(), 4u);
  for (const Triangle& triangle : triangles)
  {
    EXPECT_EQ(std::set<int>(triangle.begin(), triangle.end()).size(), 3u);
  }
}

TEST(PolygonTriangulation, IsTheDelaunayTriangulationForTheHarmonicIndex)
{
  // Corners of a flat polygon on an ellipse; no corner is within a triangle's circle.
  constexpr int count = 20;
  std::vector<std::array<double, 2>> x;
  std::vector<int> polygon;
  for (int n = 0; n < count; ++n)
  {
    const double angle = 6.283185307179586 * (n + 0.3 * std::sin(7.0 * n)) / count;
    x.push_back({ 2.0 * std::cos(angle), std::sin(angle) });
    polygon.push_back(n);
  }
  const auto twiceArea = [&](int a, int b, int c)
  { return (x[b][0] - x[a][0]) * (x[c][1] - x[a][1]) - (x[b][1] - x[a][1]) * (x[c][0] - x[a][0]); };
  const auto squared = [&](int a, int b)
  { return std::pow(x[a][0] - x[b][0], 2) + std::pow(x[a][1] - x[b][1], 2); };
  const auto cost = [&](const Triangle& t)
  {
    return (squared(t[0], t[1]) + squared(t[1], t[2]) + squared(t[2], t[0])) /
      twiceArea(t[0], t[1], t[2]);
  };
  const std::vector<Triangle> triangles = triangulatePolygon(polygon, cost, 0.0, anyPair);
  ASSERT_EQ(triangles.size(), static_cast<std::size_t>(count - 2));
  // That none costs less than an equilateral triangle saves time alone.
  int asked = 0;
  const auto countedCost = [&](const Triangle& t) { return ++asked, cost(t); };
  triangulatePolygon(polygon, countedCost, 0.0, anyPair);
  const int without = std::exchange(asked, 0);
  EXPECT_EQ(
    triangulatePolygon(polygon, countedCost, 2.0 * std::sqrt(3.0) - 1e-9, anyPair), triangles);
  EXPECT_LT(asked, 0.95 * without);
  for (const auto& [a, b, c] : triangles)
  {
    for (int d = 0; d < count; ++d)
    {
      // Positive inside the circle through a, b, c.
      const double inside = twiceArea(a, b, c) * squared(d, d) +
        twiceArea(d, b, c) * squared(a, d) + twiceArea(a, d, c) * squared(b, d) +
        twiceArea(a, b, d) * squared(c, d);
      EXPECT_LE(inside, 1e-9);
    }
  }
}

} // namespace
} // namespace hop::testing
