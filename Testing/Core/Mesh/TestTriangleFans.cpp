#include "Mesh/TriangleFans.h"

#include "FanCases.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

TEST(TriangleFans, KnowWhatIsLeftOfAnEdge)
{
  const TriangleFans fans = fansOf(5, { { 0, 1, 2 }, { 2, 1, 3 } });
  EXPECT_EQ(fans.apexOf(0, 1), 2);
  EXPECT_EQ(fans.apexOf(1, 2), 0);
  EXPECT_EQ(fans.apexOf(2, 1), 3);
  EXPECT_EQ(fans.apexOf(1, 0), -1);
  EXPECT_TRUE(fans.hasTriangles(3));
  EXPECT_FALSE(fans.hasTriangles(4));
}

TEST(TriangleFans, GiveEachTriangleOnce)
{
  const std::vector<Triangle> triangles{ { 0, 1, 2 }, { 1, 3, 2 } };
  TriangleFans fans = fansOf(4, { { 2, 0, 1 }, { 2, 1, 3 } });
  EXPECT_EQ(fans.triangles({}), triangles);
  fans.remove({ 1, 2, 0 });
  EXPECT_EQ(fans.triangles({}), std::vector<Triangle>{ triangles[1] });
  EXPECT_EQ(fans.apexOf(0, 1), -1);
  EXPECT_FALSE(fans.hasTriangles(0));
}

TEST(TriangleFans, TakeFurtherVertices)
{
  TriangleFans fans = fansOf(2, {});
  fans.appendVertex();
  fans.add({ 0, 1, 2 });
  EXPECT_EQ(fans.vertexCount(), 3u);
  EXPECT_EQ(fans.apexOf(1, 2), 0);
  fans.remove({ 0, 1, 2 });
  fans.dropLastVertex();
  EXPECT_EQ(fans.vertexCount(), 2u);
}

TEST(TriangleFans, TellRingsThatAreInOrder)
{
  const std::vector<Triangle> ring{ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 } };
  EXPECT_TRUE(fansOf(4, ring).isRing(0));
  EXPECT_FALSE(fansOf(4, ring).isRing(1)); // two triangles, open
  EXPECT_FALSE(fansOf(5, ring).isRing(4)); // none
  EXPECT_FALSE(fansOf(4, { ring[0], ring[1] }).isRing(0));
  EXPECT_FALSE(fansOf(4, { ring[0], ring[2], ring[1] }).isRing(0)); // closed, but not in order
  EXPECT_FALSE(
    fansOf(7, { ring[0], ring[1], ring[2], { 0, 4, 5 }, { 0, 5, 6 }, { 0, 6, 4 } }).isRing(0));
}

/// A strip of triangles (i, i + 1, i + 2), but for those that one of their corners does not want.
TriangleFans stripOf(int count, const ParallelFor& parallelFor)
{
  TriangleFans fans(
    static_cast<std::size_t>(count), parallelFor, []() { return 0; },
    [count](int vertex, TriangleFans::Fan& fan, int&)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const int first = vertex - corner;
        const bool isRefused = first % 5 == 0 && corner == first / 5 % 3;
        if (first >= 0 && first + 2 < count && !isRefused)
        {
          fan.push_back({ first + (corner + 1) % 3, first + (corner + 2) % 3 });
        }
      }
    });
  fans.keepAgreed(parallelFor);
  return fans;
}

TEST(TriangleFans, KeepWhatAllCornersWant)
{
  constexpr int count = 2000;
  std::vector<Triangle> expected;
  for (int first = 0; first + 2 < count; ++first)
  {
    if (first % 5 != 0)
    {
      expected.push_back({ first, first + 1, first + 2 });
    }
  }
  EXPECT_EQ(stripOf(count, {}).triangles({}), expected);
  EXPECT_EQ(stripOf(count, threadedFor(4)).triangles(threadedFor(3)), expected);
}

} // namespace
} // namespace hop::testing
