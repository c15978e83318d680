#include "Mesh/OpenLoops.h"

#include "FanCases.h"
#include "FlatSheet.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

const ConstrainedEdges none{ Distribution() };

TEST(OpenLoops, RunClockwiseAroundPieces)
{
  const Buffer<Particle> particles = particlesAt({ { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 } });
  const TriangleFans fans = fansOf(4, { { 0, 1, 2 }, { 1, 3, 2 } });
  const std::vector<OpenLoop> loops = findOpenLoops(particles, none, fans, {});
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].particles, (std::vector<int>{ 0, 2, 3, 1 }));
  EXPECT_TRUE(loops[0].isClosed);
  EXPECT_EQ(loops[0].edgeCount(), 4u);
}

TEST(OpenLoops, KeepToOneHoleWhereTwoTouch)
{
  // Two triangular holes that meet in the particle 0, (0, 1, 2) and (0, 3, 4), in a mesh that goes on between them.
  const Buffer<Particle> particles = particlesAt(
    { { 0, 0 }, { 1, -0.4 }, { 1, 0.4 }, { -1, 0.4 }, { -1, -0.4 }, { 0, 2 }, { 0, -2 } });
  const TriangleFans fans = fansOf(7,
    { { 0, 2, 5 }, { 0, 5, 3 }, { 0, 4, 6 }, { 0, 6, 1 }, { 1, 5, 2 }, { 3, 5, 6 }, { 3, 6, 4 },
      { 1, 6, 5 } });
  const std::vector<OpenLoop> loops = findOpenLoops(particles, none, fans, {});
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].particles.size(), 3u);
  EXPECT_EQ(loops[1].particles.size(), 3u);
}

/// Particles of two triangular holes that meet in the particle 0.
Buffer<Particle> bowTie()
{
  return particlesAt({ { 0, 0 }, { 1, -0.4 }, { 1, 0.4 }, { -1, 0.4 }, { -1, -0.4 } });
}

TEST(OpenLoops, AreCutWhereTwoHolesTouch)
{
  const Buffer<Particle> particles = bowTie();
  std::vector<OpenLoop> loops{ { { 1, 2, 0, 3, 4, 0 }, true } };
  cutAtPinches(particles, loops);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].particles, (std::vector<int>{ 1, 2, 0 }));
  EXPECT_EQ(loops[1].particles, (std::vector<int>{ 0, 3, 4 }));
  EXPECT_TRUE(loops[1].isClosed);
  EXPECT_NEAR(areaInside(particles, loops[0].particles), 2.4, 1e-12); // three normals, twice 0.4
}

TEST(OpenLoops, AreNotCutWhereAPartSurroundsAPieceOrIsOpen)
{
  const Buffer<Particle> particles = bowTie();
  const std::vector<int> withPiece{ 1, 2, 0, 4, 3, 0 };
  std::vector<OpenLoop> loops{ { withPiece, true }, { { 1, 2, 0, 3, 4, 0 }, false } };
  EXPECT_LT(areaInside(particles, { 0, 4, 3 }), 0.0);
  cutAtPinches(particles, loops);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].particles, withPiece);
}

TEST(OpenLoops, AreNotAtTheEndOfTheSurface)
{
  FlatSheet sheet({ { { 0, 0 }, { 0.1, 0 }, { 0, 0.1 } } }, 0.1);
  ASSERT_EQ(sheet.distribution.particles.size(), 3u);
  const ConstrainedEdges edges(sheet.distribution);
  EXPECT_TRUE(
    findOpenLoops(sheet.distribution.particles, edges, fansOf(3, { { 0, 1, 2 } }), {}).empty());
  // Without the triangle the surface is open inside its border.
  const std::vector<OpenLoop> loops =
    findOpenLoops(sheet.distribution.particles, edges, fansOf(3, {}), {});
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].particles, (std::vector<int>{ 0, 1, 2 }));
}

TEST(OpenLoops, OfTwoEdgesEncloseNothing)
{
  Distribution distribution;
  distribution.particles = particlesAt({ { 0, 0 }, { 1, 0 } });
  distribution.edges.directed = { { 0, 1 }, { 1, 0 } };
  const ConstrainedEdges edges(distribution);
  ASSERT_TRUE(edges.has(0, 1) && edges.has(1, 0));
  EXPECT_TRUE(findOpenLoops(distribution.particles, edges, fansOf(2, {}), {}).empty());
}

/// Where boundary curves end in the midst of the surface an edge leads from the one end to the other.
TEST(OpenLoops, OfChainsAreClosed)
{
  FlatSheet sheet({ { { 0, 0 }, { 0.1, 0 }, { 0, 0.1 } } }, 0.1);
  sheet.distribution.edges.segments.pop_back();
  const ConstrainedEdges edges(sheet.distribution);
  const std::vector<OpenLoop> loops =
    findOpenLoops(sheet.distribution.particles, edges, fansOf(3, {}), {});
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_TRUE(loops[0].isClosed);
  EXPECT_EQ(loops[0].particles, (std::vector<int>{ 0, 1, 2 }));
  EXPECT_EQ(loops[0].edgeCount(), 3u);
}

} // namespace
} // namespace hop::testing
