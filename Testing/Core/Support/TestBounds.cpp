#include "Support/Bounds.h"

#include "Support/Random.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

TEST(Bounds, OfManyPointsHoldThemTightlyWhateverTheThreads)
{
  // Several pieces of the loop, the extremes in different ones.
  constexpr std::size_t count = 50000;
  Random random(1);
  Buffer<glm::dvec3> points(count);
  for (glm::dvec3& p : points)
  {
    p = { random.uniform(), random.uniform() - 5.0, 3.0 * random.uniform() };
  }
  points[0].x = -1.0;
  points[20000].y = -7.0;
  points[count - 1].z = 9.0;
  points[16383].x = 2.0;
  points[16384].y = 4.0;
  points[40000].z = -3.0;
  for (const int threads : { 1, 2, 8 })
  {
    const Bounds bounds = boundsOf(points, threadedFor(threads));
    EXPECT_EQ(bounds.lower, glm::dvec3(-1.0, -7.0, -3.0));
    EXPECT_EQ(bounds.upper, glm::dvec3(2.0, 4.0, 9.0));
  }
}

TEST(Bounds, OfNoPointsAreTheOriginAndOfOneThePoint)
{
  const Bounds none = boundsOf(Buffer<glm::dvec3>(), {});
  EXPECT_EQ(none.lower, glm::dvec3(0.0));
  EXPECT_EQ(none.upper, glm::dvec3(0.0));
  const glm::dvec3 point(1.0, -2.0, 3.0);
  const Bounds one = boundsOf(Buffer<glm::dvec3>{ point }, {});
  EXPECT_EQ(one.lower, point);
  EXPECT_EQ(one.upper, point);
}

TEST(Bounds, OverlapWhereTheyShareAPointAtLeast)
{
  const Bounds unit{ glm::dvec3(0.0), glm::dvec3(1.0) };
  EXPECT_TRUE(unit.overlaps({ glm::dvec3(1.0), glm::dvec3(2.0) }));
  EXPECT_TRUE(unit.overlaps({ glm::dvec3(0.4), glm::dvec3(0.6) }));
  for (int axis = 0; axis < 3; ++axis)
  {
    Bounds beside = unit;
    beside.lower[axis] = 1.0 + 1e-15;
    beside.upper[axis] = 2.0;
    EXPECT_FALSE(unit.overlaps(beside)) << axis;
    EXPECT_FALSE(beside.overlaps(unit)) << axis;
    EXPECT_TRUE(beside.overlaps(unit.widened(1e-14))) << axis;
  }
}

TEST(Bounds, GrowToIncludeAndMeasureTheirDiagonal)
{
  Bounds bounds{ glm::dvec3(0.0), glm::dvec3(1.0) };
  bounds.include({ glm::dvec3(-1.0, 0.2, 0.3), glm::dvec3(0.5, 0.4, 7.0) });
  EXPECT_EQ(bounds.lower, glm::dvec3(-1.0, 0.0, 0.0));
  EXPECT_EQ(bounds.upper, glm::dvec3(1.0, 1.0, 7.0));
  const Bounds box{ glm::dvec3(1.0), glm::dvec3(2.0, 3.0, 3.0) };
  EXPECT_DOUBLE_EQ(box.diagonal(), 3.0);
  EXPECT_EQ(box.widened(0.5).upper, glm::dvec3(2.5, 3.5, 3.5));
}

} // namespace
} // namespace hop::testing
