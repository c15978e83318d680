#include "Elements/Domain.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace hop::testing
{
namespace
{

TEST(Domain, LatticePointsComeInStorageOrderEachOnce)
{
  for (const auto& [domain, degrees] : allElementCases())
  {
    SCOPED_TRACE(::testing::PrintToString(ElementCase{ domain, degrees }));
    const std::vector<LatticePoint> points = latticePoints(domain, degrees);
    ASSERT_EQ(static_cast<int>(points.size()), coefficientCount(domain, degrees));
    for (int index = 0; index < static_cast<int>(points.size()); ++index)
    {
      EXPECT_EQ(coefficientIndex(domain, degrees, points[index]), index);
    }
  }
}

TEST(Domain, CoefficientCounts)
{
  EXPECT_EQ(coefficientCount(Domain::Hexahedron, { 4, 2, 3 }), 60);
  EXPECT_EQ(coefficientCount(Domain::Hexahedron, { 10, 10, 10 }), 1331);
  EXPECT_EQ(coefficientCount(Domain::Tetrahedron, { 2, 2, 2 }), 10);
  EXPECT_EQ(coefficientCount(Domain::Tetrahedron, { 10, 10, 10 }), 286);
  EXPECT_EQ(coefficientCount(Domain::Wedge, { 2, 2, 2 }), 18);
  EXPECT_EQ(coefficientCount(Domain::Wedge, { 3, 3, 1 }), 20);
}

TEST(Domain, LatticeLiesInTheDomainAndNothingBesideItDoes)
{
  for (const auto& [domain, degrees] : allElementCases())
  {
    SCOPED_TRACE(::testing::PrintToString(ElementCase{ domain, degrees }));
    const auto [p, q, r] = degrees;
    for (int k = -1; k <= r + 1; ++k)
    {
      for (int j = -1; j <= q + 1; ++j)
      {
        for (int i = -1; i <= p + 1; ++i)
        {
          const LatticePoint point{ i, j, k };
          const bool inside = insideMargin(domain, latticePosition(degrees, point)) > -1e-12;
          EXPECT_EQ(inLattice(domain, degrees, point), inside) << i << ' ' << j << ' ' << k;
        }
      }
    }
  }
}

TEST(Domain, CornersStandAtTheirLatticePoints)
{
  for (const auto& [domain, degrees] : allElementCases())
  {
    const auto& corners = facts(domain).corners;
    for (int c = 0; c < static_cast<int>(corners.size()); ++c)
    {
      const LatticePoint point = cornerLatticePoint(domain, degrees, c);
      EXPECT_EQ(latticePosition(degrees, point).xyz, corners[c].xyz);
    }
  }
}

TEST(Domain, HasAsManyFacesAndCornersAsItShould)
{
  EXPECT_EQ(facts(Domain::Hexahedron).faces.size(), 6u);
  EXPECT_EQ(facts(Domain::Hexahedron).corners.size(), 8u);
  EXPECT_EQ(facts(Domain::Tetrahedron).faces.size(), 4u);
  EXPECT_EQ(facts(Domain::Tetrahedron).corners.size(), 4u);
  EXPECT_EQ(facts(Domain::Wedge).faces.size(), 5u);
  EXPECT_EQ(facts(Domain::Wedge).corners.size(), 6u);
}

TEST(Domain, IsAProductOfSimplices)
{
  for (const Domain domain : allDomains)
  {
    SCOPED_TRACE(::testing::PrintToString(domain));
    int axes = 0;
    for (const SimplexFactor& factor : facts(domain).factors)
    {
      EXPECT_EQ(factor.axis, axes);
      axes = factor.end();
    }
    EXPECT_EQ(axes, 3);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_LE(factorOf(domain, axis).axis, axis);
      EXPECT_GT(factorOf(domain, axis).end(), axis);
    }
  }
}

/// What the switches say of lattices follows from the factors.
TEST(Domain, LatticeIsTheProductOfTheLatticesOfItsSimplices)
{
  constexpr int most = 5;
  for (const auto& [domain, degrees] : allElementCases())
  {
    SCOPED_TRACE(::testing::PrintToString(ElementCase{ domain, degrees }));
    int count = 1;
    for (const SimplexFactor& factor : facts(domain).factors)
    {
      // Binomial(degree + dimension, dimension) points.
      int points = 1;
      for (int d = 1; d <= factor.dimension; ++d)
      {
        points = points * (degrees[factor.axis] + d) / d;
      }
      count *= points;
    }
    EXPECT_EQ(coefficientCount(domain, degrees), count);
    for (int n = 0; n < most * most * most; ++n)
    {
      const std::array<int, 3> index{ n % most, n / most % most, n / (most * most) };
      bool inside = true;
      for (const SimplexFactor& factor : facts(domain).factors)
      {
        int sum = 0;
        for (int axis = factor.axis; axis < factor.end(); ++axis)
        {
          sum += index[axis];
        }
        inside = inside && sum <= degrees[factor.axis];
      }
      EXPECT_EQ(inLattice(domain, degrees, { index[0], index[1], index[2] }), inside) << n;
    }
  }
}

TEST(Domain, EdgesAreTheSidesOfFacesEachOnce)
{
  for (const Domain domain : allDomains)
  {
    SCOPED_TRACE(::testing::PrintToString(domain));
    std::set<std::pair<int, int>> sides;
    for (const Face& face : facts(domain).faces)
    {
      for (int c = 0; c < face.cornerCount; ++c)
      {
        sides.insert(std::minmax({ face.corners[c], face.corners[(c + 1) % face.cornerCount] }));
      }
    }
    std::set<std::pair<int, int>> edges;
    for (const auto& [a, b] : facts(domain).edges)
    {
      edges.insert(std::minmax({ a, b }));
    }
    EXPECT_EQ(edges, sides);
    EXPECT_EQ(edges.size(), facts(domain).edges.size());
  }
}

TEST(Domain, ANumberThatStandsForNoneIsRefused)
{
  const Domain none = static_cast<Domain>(allDomains.size());
  EXPECT_THROW(facts(none), std::logic_error);
  EXPECT_THROW(coefficientCount(none, { 1, 1, 1 }), std::logic_error);
  EXPECT_THROW(coefficientIndex(none, { 1, 1, 1 }, { 0, 0, 0 }), std::logic_error);
  EXPECT_THROW(inLattice(none, { 1, 1, 1 }, { 0, 0, 0 }), std::logic_error);
}

TEST(Domain, PointsHardlyOutsideAreBroughtInside)
{
  Random random(1);
  for (const Domain domain : allDomains)
  {
    for (int n = 0; n < 200; ++n)
    {
      const ReferencePoint inside = randomPoint(domain, random);
      EXPECT_EQ(broughtInside(domain, inside).xyz, inside.xyz);
      const ReferencePoint u{ inside.xyz + 0.3 * randomVector(random) };
      const ReferencePoint brought =
        broughtInside(domain, { inside.xyz + 1e-3 * (u.xyz - inside.xyz) });
      EXPECT_GE(insideMargin(domain, brought), -1e-9) << domain;
    }
  }
}

TEST(Domain, FaceHalfSpacesHoldTheDomainAndVanishOnTheFace)
{
  for (const Domain domain : allDomains)
  {
    SCOPED_TRACE(::testing::PrintToString(domain));
    const auto& corners = facts(domain).corners;
    for (const Face& face : facts(domain).faces)
    {
      double farthest = 0.0;
      int onFace = 0;
      for (const ReferencePoint& corner : corners)
      {
        const double value = glm::dot(face.inward.xyz, corner.xyz) + face.offset;
        EXPECT_GE(value, 0.0);
        farthest = std::max(farthest, value);
        onFace += value == 0.0;
      }
      EXPECT_EQ(onFace, face.cornerCount);
      EXPECT_DOUBLE_EQ(farthest, 1.0);
      for (int c = 0; c < face.cornerCount; ++c)
      {
        EXPECT_EQ(glm::dot(face.inward.xyz, corners[face.corners[c]].xyz) + face.offset, 0.0);
      }
    }
  }
}

TEST(Domain, FaceCornersRunAroundTheFace)
{
  for (const Domain domain : allDomains)
  {
    for (const Face& face : facts(domain).faces)
    {
      if (face.cornerCount == 4)
      {
        const auto at = [&](int c) { return facts(domain).corners[face.corners[c]].xyz; };
        // In every reference domain a quadrilateral face is a parallelogram.
        EXPECT_EQ(at(0) + at(2), at(1) + at(3)) << domain;
      }
    }
  }
}

TEST(Domain, InsideMarginIsTheSmallestHalfSpace)
{
  EXPECT_DOUBLE_EQ(insideMargin(Domain::Hexahedron, { { 0.5, 0.4, 0.8 } }), 0.2);
  EXPECT_DOUBLE_EQ(insideMargin(Domain::Hexahedron, { { 0.5, 1.25, 0.8 } }), -0.25);
  EXPECT_DOUBLE_EQ(insideMargin(Domain::Tetrahedron, { { 0.25, 0.25, 0.25 } }), 0.25);
  EXPECT_DOUBLE_EQ(insideMargin(Domain::Tetrahedron, { { 0.5, 0.5, 0.5 } }), -0.5);
  EXPECT_DOUBLE_EQ(insideMargin(Domain::Wedge, { { 0.25, 0.25, 0.75 } }), 0.25);
  EXPECT_DOUBLE_EQ(insideMargin(Domain::Wedge, { { 0.75, 0.75, 0.5 } }), -0.5);
}

} // namespace
} // namespace hop::testing
