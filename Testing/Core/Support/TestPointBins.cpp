#include "Support/PointBins.h"

#include "ElementCases.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

std::vector<glm::dvec3> randomPoints(int count, const glm::dvec3& origin, double size)
{
  Random random(1);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i)
  {
    points.push_back(origin + size * randomVector(random));
  }
  return points;
}

std::vector<double> randomRadii(int count, double largest)
{
  Random random(2);
  std::vector<double> radii;
  for (int i = 0; i < count; ++i)
  {
    radii.push_back(largest * (0.1 + 0.9 * random.uniform()));
  }
  return radii;
}

std::vector<int> bruteForceNeighbors(const std::vector<glm::dvec3>& points, int i, double radius)
{
  std::vector<int> neighbors;
  for (int j = 0; j < static_cast<int>(points.size()); ++j)
  {
    if (j != i && glm::distance(points[i], points[j]) <= radius)
    {
      neighbors.push_back(j);
    }
  }
  return neighbors;
}

void expectBruteForce(const std::vector<glm::dvec3>& points, const std::vector<double>& radii)
{
  const NeighborLists lists = findNeighbors(points, radii, {});
  ASSERT_EQ(lists.start.size(), points.size() + 1);
  ASSERT_EQ(lists.start.back(), lists.neighbor.size());
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
  {
    std::vector<int> found(
      lists.neighbor.begin() + lists.start[i], lists.neighbor.begin() + lists.start[i + 1]);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, bruteForceNeighbors(points, i, radii[i])) << i;
  }
}

TEST(PointBins, FindsTheNeighborsThatBruteForceFinds)
{
  expectBruteForce(randomPoints(700, { 0, 0, 0 }, 1.0), randomRadii(700, 0.3));
  expectBruteForce(randomPoints(300, { -1e5, 3e4, 7e6 }, 50.0), randomRadii(300, 20.0));
}

TEST(PointBins, FindsNeighborsOfPointsThatLieFarApart)
{
  // Bounds of more than 2^21 bins.
  std::vector<glm::dvec3> points = randomPoints(100, { 0, 0, 0 }, 1.0);
  const std::vector<glm::dvec3> far = randomPoints(100, { 1e9, -1e9, 1e9 }, 1.0);
  points.insert(points.end(), far.begin(), far.end());
  expectBruteForce(points, randomRadii(200, 0.5));
}

TEST(PointBins, CoincidentPointsAreNeighbors)
{
  expectBruteForce(std::vector<glm::dvec3>(5, { 1, 2, 3 }), std::vector<double>(5, 0.1));
}

TEST(PointBins, NoPointsNoNeighbors)
{
  const NeighborLists lists = findNeighbors({}, {}, {});
  EXPECT_EQ(lists.start, std::vector<std::size_t>{ 0 });
  EXPECT_TRUE(lists.neighbor.empty());
}

TEST(PointBins, OrderDoesNotDependOnThreads)
{
  const auto points = randomPoints(700, { 0, 0, 0 }, 1.0);
  const auto radii = randomRadii(700, 0.3);
  const NeighborLists serial = findNeighbors(points, radii, {});
  for (const int threads : { 2, 5 })
  {
    const NeighborLists threaded = findNeighbors(points, radii, threadedFor(threads));
    EXPECT_EQ(threaded.start, serial.start);
    EXPECT_EQ(threaded.neighbor, serial.neighbor);
  }
}

TEST(PointBins, VisitReachesAllPointsWithinTheRadiusOnce)
{
  const auto points = randomPoints(500, { 0, 0, 0 }, 1.0);
  const PointBins bins(points, 0.1);
  Random random(3);
  for (int n = 0; n < 50; ++n)
  {
    // Positions outside the bounds are as good as those inside.
    const glm::dvec3 position = 1.5 * randomVector(random);
    const double radius = 0.4 * random.uniform();
    std::vector<int> visits(points.size(), 0);
    bins.visit(position, radius, [&](int i) { ++visits[i]; });
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_LE(visits[i], 1);
      EXPECT_GE(visits[i], glm::distance(points[i], position) <= radius ? 1 : 0);
    }
  }
}

} // namespace
} // namespace hop::testing
