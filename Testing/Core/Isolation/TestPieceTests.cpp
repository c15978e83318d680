#include "Isolation/PieceTests.h"

#include "AnalyticFields.h"
#include "PieceCases.h"

#include <algorithm>
#include <memory>

namespace hop::testing
{
namespace
{

PieceTests testsOf(const Piece& whole, double isovalue = 0.0)
{
  PieceTests tests(whole.kind->domain, whole.kind->degrees, isovalue);
  tests.beginElement(whole);
  return tests;
}

class Proofs : public PiecesOf
{
protected:
  Piece wholeOf(const Field& field)
  {
    this->Element = std::make_unique<WholeElement>(this->domain(), this->degree(), field);
    return this->Element->piece();
  }

private:
  std::unique_ptr<WholeElement> Element;
};

INSTANTIATE_TEST_SUITE_P(PieceTests, Proofs, allPieceCases(), nameOfCase);

TEST_P(Proofs, PlanesAreInPiecesWithCornersOnBothSides)
{
  Random random(1);
  for (int n = 0; n < 10; ++n)
  {
    const glm::dvec3 normal = glm::normalize(randomVector(random));
    const glm::dvec3 through = randomPoint(this->domain(), random).xyz;
    const Piece whole =
      this->wholeOf([&](const glm::dvec3& u) { return glm::dot(normal, u - through); });
    const PieceTests tests = testsOf(whole);
    for (const Piece& piece : allPieces(whole, 4))
    {
      std::vector<double> distances;
      for (const glm::dvec3& corner : piece.corners)
      {
        distances.push_back(glm::dot(normal, corner - through));
      }
      const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
      const bool isCut = *least < 0.0 && *most > 0.0;
      EXPECT_EQ(tests.mayHoldSurface(piece), isCut);
      EXPECT_EQ(tests.signAtCorners(piece), isCut ? 0.0 : *most > 0.0 ? 1.0 : -1.0);
      EXPECT_EQ(tests.sheetIn(piece), isCut ? Monotony::Strict : Monotony::None);
      EXPECT_EQ(tests.monotony(piece), Monotony::Strict);
      EXPECT_TRUE(tests.rises(piece));
      EXPECT_FALSE(tests.isZero(piece));
      EXPECT_FALSE(tests.sheetPairIn(piece));
    }
  }
}

/// Rounding errors are shares of the field and of the isovalue.
TEST_P(Proofs, WhatIsNothingButTheIsovalueMayHoldSurface)
{
  for (const double isovalue : { 0.0, 1e-20, 1e10 })
  {
    Random random(2);
    WholeElement element(this->domain(), this->degree(), [](const glm::dvec3&) { return 0.0; });
    for (Coefficient& c : element.mesh.coefficients)
    {
      c.w = isovalue * (1.0 + 1e-16 * randomNumber(random));
    }
    const Piece whole = element.piece(isovalue);
    const PieceTests tests = testsOf(whole, isovalue);
    EXPECT_TRUE(tests.isZero(whole)) << isovalue;
    EXPECT_TRUE(tests.mayHoldSurface(whole)) << isovalue;
    EXPECT_EQ(tests.sheetIn(whole), Monotony::None) << isovalue;
  }
}

TEST_P(Proofs, ASheetAtACornerCounts)
{
  for (const double sign : { 1.0, -1.0 })
  {
    const Piece whole =
      this->wholeOf([=](const glm::dvec3& u) { return sign * (u.x + u.y + u.z); });
    const PieceTests tests = testsOf(whole);
    EXPECT_TRUE(tests.mayHoldSurface(whole));
    EXPECT_EQ(tests.signAtCorners(whole), sign);
    EXPECT_EQ(tests.sheetIn(whole), Monotony::Strict);
  }
}

TEST(PieceTests, ASphereInsideIsNoSheet)
{
  for (const Domain domain : allDomains)
  {
    const WholeElement element(domain, 2, sphere(glm::dvec3(0.22), 0.1).field);
    const Piece whole = element.piece();
    const PieceTests tests = testsOf(whole);
    EXPECT_TRUE(tests.mayHoldSurface(whole));
    EXPECT_EQ(tests.sheetIn(whole), Monotony::None);
    EXPECT_EQ(tests.signAtCorners(whole), -1.0);
    EXPECT_FALSE(tests.rises(whole));
  }
}

/// One wavy sheet that cuts off two corners of the floor.
TEST(PieceTests, ASheetInTwoPartsCountsInsideOrInSmallPieces)
{
  const WholeElement element(Domain::Hexahedron, 2,
    [](const glm::dvec3& u) { return u.z + 0.9 * (u.x + u.y - 2.0 * u.x * u.y) - 0.3; });
  Piece piece = element.piece();
  const PieceTests tests = testsOf(piece);
  EXPECT_EQ(tests.monotony(piece), Monotony::Strict);
  EXPECT_EQ(tests.sheetIn(piece), Monotony::None) << "on the boundary of the element";
  Piece small = piece;
  small.bisections = MaximumBoundaryBisections;
  EXPECT_EQ(tests.sheetIn(small), Monotony::Strict);
  for (glm::dvec3& corner : piece.corners)
  {
    corner = 0.25 + 0.5 * corner;
  }
  EXPECT_EQ(tests.sheetIn(piece), Monotony::Strict) << "inside the element";
}

TEST(PieceTests, TwoSheetsCloseToEachOtherAreAPair)
{
  for (const Domain domain : allDomains)
  {
    const auto film = [](double constant)
    { return [=](const glm::dvec3& u) { return (u.z - 0.3) * (u.z - 0.3) - constant; }; };
    const WholeElement two(domain, 2, film(1e-4));
    const Piece piece = two.piece();
    EXPECT_TRUE(testsOf(piece).sheetPairIn(piece));
    EXPECT_EQ(testsOf(piece).sheetIn(piece), Monotony::None);
    const WholeElement one(domain, 2, film(1e-17));
    EXPECT_FALSE(testsOf(one.piece()).sheetPairIn(one.piece())) << "less than rounding errors";
  }
}

} // namespace
} // namespace hop::testing
