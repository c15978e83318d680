#include "Mesh/ManifoldVertices.h"

#include "FanCases.h"
#include "FlatSheet.h"
#include "Mesh/OpenLoops.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

TEST(ManifoldVertices, KeepTheLargerFan)
{
  TriangleFans fans = fansOf(6, { { 0, 1, 2 }, { 0, 3, 4 }, { 0, 4, 5 } });
  EXPECT_TRUE(keepOneFan(fans, {}));
  EXPECT_EQ(fans.triangles({}), (std::vector<Triangle>{ { 0, 3, 4 }, { 0, 4, 5 } }));
  EXPECT_FALSE(keepOneFan(fans, {}));
}

TEST(ManifoldVertices, KeepTheFanOfTheLeastParticleOfTwoAlike)
{
  TriangleFans fans = fansOf(5, { { 2, 3, 4 }, { 2, 0, 1 } });
  EXPECT_TRUE(keepOneFan(fans, {}));
  EXPECT_EQ(fans.triangles({}), (std::vector<Triangle>{ { 0, 1, 2 } }));
}

TEST(ManifoldVertices, GoOnToVerticesThatLoseATriangle)
{
  // At 0 the triangle (0, 1, 2) has to go; it was in the middle of the fan of 1, of which (1, 8, 0) then goes.
  TriangleFans fans = fansOf(10,
    { { 0, 3, 4 }, { 0, 4, 5 }, { 0, 5, 6 }, { 0, 1, 2 }, { 1, 7, 2 }, { 1, 9, 7 }, { 0, 8, 1 } });
  EXPECT_TRUE(keepOneFan(fans, {}));
  EXPECT_FALSE(keepOneFan(fans, {}));
}

TEST(ManifoldVertices, LeaveClosedFansAlone)
{
  TriangleFans fans = fansOf(4, { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 } });
  EXPECT_FALSE(keepOneFan(fans, {}));
  EXPECT_EQ(fans.triangles({}).size(), 3u);
}

/// Two triangles that touch in particle 0.
struct Bow
{
  /// \param ended the surface ends along these edges
  explicit Bow(std::vector<std::array<int, 2>> ended)
  {
    this->distribution.particles =
      particlesAt({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { -1, 0 }, { -1, -1 } });
    this->distribution.edges.directed = std::move(ended);
  }

  Distribution distribution;
  TriangleFans fans = fansOf(5, { { 0, 1, 2 }, { 0, 3, 4 } });
};

TEST(ManifoldVertices, HaveAParticleForEachFanWhereBoundaryCurvesTouch)
{
  Bow bow({ { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 3, 4 }, { 4, 0 } });
  Buffer<Particle>& particles = bow.distribution.particles;
  ConstrainedEdges edges(bow.distribution);
  const std::vector<std::array<int, 2>> copies = splitFans(edges, particles, bow.fans, {});
  EXPECT_EQ(copies, (std::vector<std::array<int, 2>>{ { 0, 5 } }));
  ASSERT_EQ(particles.size(), 6u);
  EXPECT_EQ(particles[5].position.xyz, particles[0].position.xyz);
  EXPECT_EQ(bow.fans.triangles({}), (std::vector<Triangle>{ { 0, 1, 2 }, { 3, 4, 5 } }));
  EXPECT_FALSE(keepOneFan(bow.fans, {}));
  EXPECT_TRUE(edges.has(5, 3) && edges.has(4, 5) && edges.has(3, 4));
  EXPECT_FALSE(edges.joins(0, 3) || edges.joins(0, 4));
  EXPECT_TRUE(findOpenLoops(particles, edges, bow.fans, {}).empty());
}

TEST(ManifoldVertices, KeepOneParticleWhereAFanIsOpen)
{
  Bow bow({ { 0, 1 }, { 1, 2 }, { 2, 0 } });
  ConstrainedEdges edges(bow.distribution);
  EXPECT_TRUE(splitFans(edges, bow.distribution.particles, bow.fans, {}).empty());
  EXPECT_EQ(bow.distribution.particles.size(), 5u);
}

TEST(ManifoldVertices, KeepTheFirstTriangleOnOneSideOfAnEdgeWhereParticlesAreOneVertex)
{
  // The sheets (0, 1, 2) and (3, 4, 5) end in the same two places and lie on the same side of the edge between them; the
  // sheet (6, 7, 8) lies on the other side.
  const std::vector<int> places{ 0, 1, 2, 0, 1, 5, 0, 1, 8 };
  TriangleFans fans = fansOf(9, { { 0, 1, 2 }, { 3, 4, 5 }, { 6, 8, 7 } });
  keepManifold(places, fans, {});
  EXPECT_EQ(fans.triangles({}), (std::vector<Triangle>{ { 0, 1, 2 }, { 6, 8, 7 } }));
}

TEST(ManifoldVertices, KeepOneOfTwoClosedFans)
{
  const std::vector<Triangle> larger{ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 } };
  std::vector<Triangle> both{ { 0, 5, 6 }, { 0, 6, 7 }, { 0, 7, 5 } };
  both.insert(both.end(), larger.begin(), larger.end());
  TriangleFans fans = fansOf(8, both);
  EXPECT_TRUE(keepOneFan(fans, {}));
  EXPECT_EQ(fans.triangles({}).size(), larger.size());
  EXPECT_FALSE(keepOneFan(fans, {}));
}

TEST(ManifoldVertices, KeepOneFanWhereParticlesAreOneVertex)
{
  TriangleFans fans = fansOf(7, { { 0, 1, 2 }, { 3, 4, 5 }, { 3, 5, 6 } });
  keepManifold({ 0, 1, 2, 0, 4, 5, 6 }, fans, {});
  EXPECT_EQ(fans.triangles({}), (std::vector<Triangle>{ { 3, 4, 5 }, { 3, 5, 6 } }));
}

TEST(ManifoldVertices, LeaveSidesOfACreaseAlone)
{
  const std::vector<Triangle> sides{ { 0, 1, 2 }, { 3, 5, 4 } };
  TriangleFans fans = fansOf(6, sides);
  keepManifold({ 0, 1, 2, 0, 1, 5 }, fans, {});
  EXPECT_EQ(fans.triangles({}), sides);
}

} // namespace
} // namespace hop::testing
