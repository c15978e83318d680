#include "Isolation/PieceBoxes.h"

#include "Isolation/ProxyPolygons.h"
#include "PieceCases.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

constexpr float infinity = std::numeric_limits<float>::infinity();

PieceTests testsOf(const Piece& whole, double isovalue = 0.0)
{
  PieceTests tests(whole.kind->domain, whole.kind->degrees, isovalue);
  tests.beginElement(whole);
  return tests;
}

class BoxesOfPieces : public PiecesOf
{
};

INSTANTIATE_TEST_SUITE_P(PieceBoxes, BoxesOfPieces, allPieceCases(), nameOfCase);

TEST_P(BoxesOfPieces, HaveThePlaneOfALinearFieldInTheirValues)
{
  const Field field = [](const glm::dvec3& u) { return 1e-3 * (u.x - 2.0 * u.y + 3.0 * u.z); };
  constexpr double isovalue = 5e-4;
  const WholeElement element(this->domain(), this->degree(), field);
  const Piece whole = element.piece(isovalue);
  const PieceTests tests = testsOf(whole, isovalue);
  const std::size_t corners = facts(this->domain()).corners.size();
  for (const int bisections : { 0, 4 })
  {
    for (const Piece& piece : allPieces(whole, bisections))
    {
      const SurfaceBox box = boxOf(piece, tests);
      EXPECT_EQ(box.middle.element, 0);
      EXPECT_EQ(box.middle.u.xyz, piece.middle().xyz);
      EXPECT_EQ(box.size, piece.worldSize());
      EXPECT_EQ(box.largestOwnValue, infinity);
      double largest = 0.0;
      double radius = 0.0;
      for (std::size_t c = 0; c < corners; ++c)
      {
        const glm::dvec3 corner = piece.corner(static_cast<int>(c));
        EXPECT_EQ(box.corners[c], glm::vec3(corner));
        EXPECT_NEAR(box.values[c] * box.valueUnit, field(corner) - isovalue, 1e-9);
        largest = std::max(largest, std::abs(field(corner) - isovalue));
        radius = std::max(radius, glm::distance(corner, piece.middle().xyz));
      }
      EXPECT_EQ(box.referenceRadius, radius);
      EXPECT_EQ(std::ldexp(1.0, std::ilogb(box.valueUnit)), box.valueUnit) << "a power of two";
      EXPECT_LE(box.valueUnit, largest * (1.0 + 1e-12));
      EXPECT_GT(2.0 * box.valueUnit, largest * (1.0 - 1e-12));
    }
  }
}

TEST_P(BoxesOfPieces, StraddleBetweenTheirLowestAndTheirHighestCorner)
{
  const WholeElement element = this->randomElement(1);
  const Range ofElement = element.piece().cornerRange();
  const double isovalue = 0.5 * (ofElement.lower + ofElement.upper);
  const Piece whole = element.piece(isovalue);
  const PieceTests tests = testsOf(whole, isovalue);
  const auto valueAt = [&](const glm::dvec3& u)
  { return evaluateGradient(element.mesh.form(0), { u }).value.w - isovalue; };
  int straddling = 0;
  for (const Piece& piece : allPieces(whole, 5))
  {
    const SurfaceBox box = boxOf(piece, tests);
    const Range range = piece.cornerRange();
    EXPECT_NEAR(valueAt(box.ends[0].xyz), range.lower, 1e-13);
    EXPECT_NEAR(valueAt(box.ends[1].xyz), range.upper, 1e-13);
    EXPECT_EQ(box.straddles, range.lower < 0.0 && range.upper > 0.0);
    straddling += box.straddles;
  }
  EXPECT_GT(straddling, 0);
  EXPECT_LT(straddling, 32);
}

TEST_P(BoxesOfPieces, AreCertifiedIfThePieceIs)
{
  const WholeElement element(
    this->domain(), this->degree(), [](const glm::dvec3& u) { return u.x - 0.3; });
  Piece piece = element.piece();
  const PieceTests tests = testsOf(piece);
  EXPECT_FALSE(boxOf(piece, tests).certified);
  piece.sheet = Monotony::Strict;
  const SurfaceBox box = boxOf(piece, tests);
  EXPECT_TRUE(box.certified);
  EXPECT_FALSE(box.risesWeakly);
  EXPECT_FALSE(box.mayBeThin);
}

TEST(PieceBoxes, AreWeakOnlyWhereTheFieldStandsStill)
{
  // The square of a velocity at a wall, x = 0, less a constant.
  const WholeElement element(
    Domain::Hexahedron, 2, [](const glm::dvec3& u) { return u.x * u.x - 0.05; });
  Piece whole = element.piece();
  const PieceTests tests = testsOf(whole);
  whole.sheet = Monotony::Weak;
  for (const Piece& piece : allPieces(whole, 3))
  {
    const SurfaceBox box = boxOf(piece, tests);
    EXPECT_TRUE(box.certified);
    EXPECT_TRUE(box.mayBeThin);
    EXPECT_EQ(box.risesWeakly, piece.middle().xyz.x < 0.5);
  }
}

TEST(PieceBoxes, ValuesOfZeroHaveTheUnitOne)
{
  const WholeElement element(Domain::Wedge, 1, [](const glm::dvec3&) { return 0.0; });
  const Piece piece = element.piece();
  const SurfaceBox box = boxOf(piece, testsOf(piece));
  EXPECT_EQ(box.valueUnit, 1.0);
  EXPECT_EQ(box.values, (std::array<float, MaximumCorners>{}));
  EXPECT_FALSE(box.straddles);
}

class BoxesOfPairs : public ::testing::TestWithParam<Domain>
{
protected:
  /// Boxes of two planes, a distance apart, around one at a height.
  std::vector<SurfaceBox> boxesOfFilm(double height, double apart, double sign) const
  {
    const Field field = [=](const glm::dvec3& u)
    { return sign * ((u.z - height) * (u.z - height) - 0.25 * apart * apart); };
    const WholeElement element(this->GetParam(), 2, field);
    const Piece piece = element.piece();
    const auto pair = testsOf(piece).sheetPairIn(piece);
    std::vector<SurfaceBox> boxes;
    if (pair)
    {
      appendBoxesOfPair(piece, *pair, boxes);
    }
    return boxes;
  }
};

INSTANTIATE_TEST_SUITE_P(PieceBoxes, BoxesOfPairs, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(BoxesOfPairs, HoldOneSheetEach)
{
  constexpr double height = 0.3;
  constexpr double apart = 0.02;
  for (const double sign : { 1.0, -1.0 })
  {
    const std::vector<SurfaceBox> boxes = this->boxesOfFilm(height, apart, sign);
    ASSERT_EQ(boxes.size(), 2u);
    for (std::size_t n = 0; n < 2; ++n)
    {
      const SurfaceBox& box = boxes[n];
      EXPECT_TRUE(box.certified);
      EXPECT_TRUE(box.straddles);
      // The direction of a pair may be z or -z.
      const double side = box.middle.u.xyz.z > height ? 1.0 : -1.0;
      EXPECT_NEAR(box.middle.u.xyz.z, height + 0.5 * side * apart, 1e-6);
      // F - c rises from the first end to the second: away from the middle of the film where it is positive outside.
      EXPECT_NEAR(box.ends[sign > 0.0 ? 0 : 1].xyz.z, height, 1e-6);
      EXPECT_NEAR(box.ends[sign > 0.0 ? 1 : 0].xyz.z, height + side * apart, 1e-6);
      const double rise = side * sign;
      const auto& corners = facts(this->GetParam()).corners;
      for (std::size_t c = 0; c < corners.size(); ++c)
      {
        const double ahead = corners[c].xyz.z - (height + 0.5 * side * apart);
        EXPECT_NEAR(box.values[c] * box.valueUnit, rise * apart * ahead, 0.05 * apart);
        EXPECT_GT(box.values[c] * rise * ahead, 0.0);
      }
      EXPECT_NEAR(box.largestOwnValue * box.valueUnit, 0.5 * apart * apart, 1e-6);
    }
    EXPECT_LT((boxes[0].middle.u.xyz.z - height) * (boxes[1].middle.u.xyz.z - height), 0.0);
  }
}

TEST_P(BoxesOfPairs, AreNoneForASheetThatPassesTheCornersBy)
{
  const std::vector<SurfaceBox> boxes = this->boxesOfFilm(-0.005, 0.02, 1.0);
  ASSERT_EQ(boxes.size(), 1u) << "one sheet is below the domain";
  EXPECT_NEAR(boxes[0].middle.u.xyz.z, 0.005, 1e-6);
}

TEST_P(BoxesOfPairs, OfUndecidedPartsSayNothingOfTheSurface)
{
  const WholeElement element(this->GetParam(), 2, [](const glm::dvec3& u) { return u.x - 0.3; });
  const Piece piece = element.piece();
  const SurfaceBox box = boxOfUndecidedPart(piece, testsOf(piece));
  EXPECT_FALSE(box.straddles);
  EXPECT_FALSE(box.certified);
  EXPECT_EQ(box.size, piece.worldSize());
  std::vector<ReferenceTriangle> triangles;
  appendProxyTriangles(this->GetParam(), box, triangles);
  EXPECT_TRUE(triangles.empty());
}

} // namespace
} // namespace hop::testing
