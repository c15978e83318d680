#include "Edges/CurveSegments.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

using Pairs = std::vector<std::array<int, 2>>;

const CurvePlace gap{ -1, -1, true };
const CurvePlace lost{};

CurvePlace withParticle(int particle)
{
  return { particle, -1, false };
}

CurvePlace withStandIn(int particle)
{
  return { -1, particle, false };
}

TEST(CurveSegments, JoinNeighboursOnCurvesAndCloseClosedOnes)
{
  const std::vector<CurvePlace> places{ withParticle(0), withParticle(1), withParticle(2),
    withParticle(3), withParticle(4), withParticle(5) };
  EXPECT_EQ(segmentsOf(places, { { 0, 3, true }, { 3, 3, false } }),
    (Pairs{ { 0, 1 }, { 0, 2 }, { 1, 2 }, { 3, 4 }, { 4, 5 } }));
}

TEST(CurveSegments, PassAPlaceWithoutParticleButNoGap)
{
  const std::vector<CurvePlace> places{ withParticle(0), lost, withParticle(1), gap,
    withParticle(2), withStandIn(9), withParticle(3) };
  EXPECT_EQ(segmentsOf(places, { { 0, 7, false } }), (Pairs{ { 0, 1 }, { 2, 3 } }));
  EXPECT_EQ(segmentsOf(places, { { 0, 7, true } }), (Pairs{ { 0, 1 }, { 0, 3 }, { 2, 3 } }));
}

TEST(CurveSegments, LeadOverStandInsWhereSeveralPlacesHaveNoParticle)
{
  const std::vector<CurvePlace> places{ withParticle(0), withStandIn(7), withStandIn(7),
    withStandIn(8), withParticle(1), withStandIn(9) };
  EXPECT_EQ(
    segmentsOf(places, { { 0, 6, false } }), (Pairs{ { 0, 7 }, { 1, 8 }, { 1, 9 }, { 7, 8 } }));
}

TEST(CurveSegments, OfAClosedCurveOfTwoParticlesAreOne)
{
  EXPECT_EQ(
    segmentsOf({ withParticle(0), withParticle(1) }, { { 0, 2, true } }), (Pairs{ { 0, 1 } }));
  EXPECT_TRUE(segmentsOf({ withParticle(0) }, { { 0, 1, true } }).empty());
  EXPECT_TRUE(segmentsOf({ lost, gap }, { { 0, 2, true } }).empty());
}

TEST(CurveSegments, JoinTheNeighboursOfDroppedParticles)
{
  const Pairs square{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 0, 3 } };
  EXPECT_EQ(withoutDropped(square, { 1, 0, 1, 1 }), (Pairs{ { 0, 1 }, { 0, 2 }, { 1, 2 } }));
  EXPECT_EQ(withoutDropped(square, { 0, 0, 1, 1 }), (Pairs{ { 0, 1 } }));
  EXPECT_EQ(withoutDropped({ { 0, 1 }, { 1, 2 } }, { 0, 1, 1 }), (Pairs{ { 0, 1 } }));
}

TEST(CurveSegments, AreDirectedOnCurvesOfWhichAPartIsACrease)
{
  // A triangle of one crease and two pieces of boundary curve; then a curve without creases.
  std::vector<CurvePlace> places{ withParticle(0), withParticle(1), withParticle(2),
    withParticle(3), withParticle(4), withParticle(5) };
  places[1].beginsCrease = true;
  const std::vector<CurveRange> curves{ { 0, 3, true }, { 3, 3, true } };
  EXPECT_EQ(directedEdgesOf(places, curves), (Pairs{ { 0, 2 }, { 1, 0 }, { 2, 1 } }));
  EXPECT_EQ(
    segmentsOf(places, curves), (Pairs{ { 0, 1 }, { 0, 2 }, { 3, 4 }, { 3, 5 }, { 4, 5 } }));
}

TEST(CurveSegments, AreRenumberedWithoutDroppedParticles)
{
  Pairs pairs{ { 4, 2 }, { 0, 4 } };
  renumber(pairs, { 1, 0, 1, 0, 1 });
  EXPECT_EQ(pairs, (Pairs{ { 2, 1 }, { 0, 2 } }));
}

} // namespace
} // namespace hop::testing
