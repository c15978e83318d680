#include "Mesh/ManifoldVertices.h"

#include "FanCases.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

TEST(ManifoldVertices, KeepTheLargerFan)
{
  TriangleFans fans = fansOf(6, { { 0, 1, 2 }, { 0, 3, 4 }, { 0, 4, 5 } });
  EXPECT_TRUE(keepOneFan({ 0 }, fans));
  EXPECT_EQ(fans.triangles({}), (std::vector<Triangle>{ { 0, 3, 4 }, { 0, 4, 5 } }));
  EXPECT_FALSE(keepOneFan({ 0, 1, 2, 3, 4, 5 }, fans));
}

TEST(ManifoldVertices, KeepTheFanOfTheLeastParticleOfTwoAlike)
{
  TriangleFans fans = fansOf(5, { { 2, 3, 4 }, { 2, 0, 1 } });
  EXPECT_TRUE(keepOneFan({ 2 }, fans));
  EXPECT_EQ(fans.triangles({}), (std::vector<Triangle>{ { 0, 1, 2 } }));
}

TEST(ManifoldVertices, GoOnToVerticesThatLoseATriangle)
{
  // At 0 the triangle (0, 1, 2) has to go; it was in the middle of the fan of 1, of which (1, 8, 0) then goes.
  TriangleFans fans = fansOf(10,
    { { 0, 3, 4 }, { 0, 4, 5 }, { 0, 5, 6 }, { 0, 1, 2 }, { 1, 7, 2 }, { 1, 9, 7 }, { 0, 8, 1 } });
  EXPECT_TRUE(keepOneFan({ 0 }, fans));
  EXPECT_FALSE(keepOneFan({ 0, 1, 2, 7, 8, 9 }, fans));
}

TEST(ManifoldVertices, LeaveClosedFansAlone)
{
  TriangleFans fans = fansOf(4, { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 } });
  EXPECT_FALSE(keepOneFan({ 0, 1, 2, 3 }, fans));
  EXPECT_EQ(fans.triangles({}).size(), 3u);
}

} // namespace
} // namespace hop::testing
