#include "Mesh/ConvexHull.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace hop::testing
{
namespace
{

/// Points on an ellipsoid with half axes 4, 1 and 2.
std::vector<glm::dvec3> onEllipsoid(int count)
{
  std::vector<glm::dvec3> points;
  for (int n = 0; n < count; ++n)
  {
    const double z = 1.0 - (2.0 * n + 1.0) / count;
    const double angle = n * glm::pi<double>() * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    points.push_back({ 4.0 * r * std::cos(angle), r * std::sin(angle), 2.0 * z });
  }
  return points;
}

double volumeOf(const std::vector<glm::dvec3>& points, const std::vector<Triangle>& triangles)
{
  double six = 0.0;
  for (const auto& [a, b, c] : triangles)
  {
    six += glm::dot(points[a], glm::cross(points[b], points[c]));
  }
  return six / 6.0;
}

TEST(ConvexHull, HasAllPointsOfAConvexBody)
{
  const std::vector<glm::dvec3> points = onEllipsoid(60);
  const std::vector<Triangle> hull = convexHull(points);
  EXPECT_EQ(hull.size(), 2 * points.size() - 4); // Euler's formula
  std::set<std::array<int, 2>> edges;
  for (const Triangle& t : hull)
  {
    for (int n = 0; n < 3; ++n)
    {
      EXPECT_TRUE(edges.insert({ t[n], t[(n + 1) % 3] }).second);
    }
    for (const glm::dvec3& other : points)
    {
      const glm::dvec3 normal =
        glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
      EXPECT_LE(glm::dot(normal, other - points[t[0]]), 1e-9);
    }
  }
  const double whole = 4.0 / 3.0 * glm::pi<double>() * 8.0;
  EXPECT_GT(volumeOf(points, hull), 0.8 * whole);
  EXPECT_LT(volumeOf(points, hull), whole);
}

TEST(ConvexHull, LeavesOutPointsInside)
{
  std::vector<glm::dvec3> points = onEllipsoid(30);
  points.insert(points.begin() + 3, glm::dvec3(0.1, 0.2, -0.1));
  const std::vector<Triangle> hull = convexHull(points);
  EXPECT_EQ(hull.size(), 2 * 30 - 4);
  for (const Triangle& t : hull)
  {
    EXPECT_TRUE(t[0] != 3 && t[1] != 3 && t[2] != 3);
  }
}

TEST(ConvexHull, OfPointsInAPlaneIsNone)
{
  EXPECT_TRUE(convexHull({}).empty());
  EXPECT_TRUE(convexHull({ { 1, 2, 3 }, { 1, 2, 3 } }).empty());
  EXPECT_TRUE(
    convexHull({ { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 3, 4, 1 } }).empty());
}

} // namespace
} // namespace hop::testing
