#include "Isolation/ElementPieces.h"

#include "PieceCases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hop::testing
{
namespace
{

constexpr int bisections = 6;

/// Columns of the map from the piece's own reference space to the element's.
glm::dmat3 jacobianOf(const Piece& piece)
{
  const glm::dvec3 origin = piece.inElement(glm::dvec3(0.0)).xyz;
  return { piece.inElement({ 1, 0, 0 }).xyz - origin, piece.inElement({ 0, 1, 0 }).xyz - origin,
    piece.inElement({ 0, 0, 1 }).xyz - origin };
}

/// Where a place of the element lies in the piece's own reference space.
ReferencePoint inPiece(const Piece& piece, const ReferencePoint& u)
{
  return { glm::inverse(jacobianOf(piece)) * (u.xyz - piece.inElement(glm::dvec3(0.0)).xyz) };
}

class ElementPieces : public PiecesOf
{
};

INSTANTIATE_TEST_SUITE_P(ElementPieces, ElementPieces, allPieceCases(), nameOfCase);

TEST_P(ElementPieces, CoverTheElementExactlyOnce)
{
  const WholeElement element = this->randomElement(1);
  const std::vector<Piece> pieces = allPieces(element.piece(), bisections);
  double volume = 0.0;
  for (const Piece& piece : pieces)
  {
    volume += std::abs(glm::determinant(jacobianOf(piece)));
  }
  EXPECT_NEAR(volume, 1.0, 1e-14);
  Random random(2);
  for (int n = 0; n < 100; ++n)
  {
    const ReferencePoint u = randomPoint(this->domain(), random);
    EXPECT_EQ(
      std::count_if(pieces.begin(), pieces.end(),
        [&](const Piece& piece) { return insideMargin(this->domain(), inPiece(piece, u)) > 0.0; }),
      1);
  }
}

TEST_P(ElementPieces, HoldTheElementsPolynomialsLessTheIsovalue)
{
  constexpr double isovalue = 0.3;
  const WholeElement element = this->randomElement(3);
  Random random(4);
  for (const Piece& piece : allPieces(element.piece(isovalue), bisections))
  {
    const ReferencePoint u = randomPoint(this->domain(), random);
    const Coefficient here = evaluateGradient(piece.form(), u).value;
    const Coefficient expected =
      evaluateGradient(element.mesh.form(0), piece.inElement(u.xyz)).value -
      Coefficient(0.0, 0.0, 0.0, isovalue);
    EXPECT_LE(glm::distance(here, expected), 1e-13);
  }
}

TEST_P(ElementPieces, OfRationalElementsHoldTheirQuotients)
{
  constexpr double isovalue = 0.3;
  WholeElement element = this->randomElement(5);
  Random random(6);
  for (Coefficient& c : element.mesh.coefficients)
  {
    element.mesh.weights.push_back(0.5 + random.uniform());
    c *= element.mesh.weights.back();
  }
  element.mesh.elements[0].rational = true;
  for (const Piece& piece : allPieces(element.piece(isovalue), bisections))
  {
    const ReferencePoint u = randomPoint(this->domain(), random);
    const double expected =
      evaluateGradient(element.mesh.form(0), piece.inElement(u.xyz)).value.w - isovalue;
    EXPECT_NEAR(evaluateGradient(piece.form(), u).value.w, expected, 1e-13);
    const auto& corners = facts(this->domain()).corners;
    for (std::size_t c = 0; c < corners.size(); ++c)
    {
      EXPECT_NEAR(
        piece.cornerValues()[c], evaluateGradient(piece.form(), corners[c]).value.w, 1e-13);
    }
  }
}

TEST_P(ElementPieces, KnowTheirCornersInTheOrderOfTheDomain)
{
  const WholeElement element = this->randomElement(7);
  const auto& corners = facts(this->domain()).corners;
  for (const Piece& piece : allPieces(element.piece(), bisections))
  {
    glm::dvec3 sum(0.0);
    for (std::size_t c = 0; c < corners.size(); ++c)
    {
      const glm::dvec3 corner = piece.corner(static_cast<int>(c));
      sum += corner;
      EXPECT_EQ(corner, piece.inElement(corners[c].xyz).xyz);
      EXPECT_NEAR(
        piece.cornerValues()[c], evaluateGradient(element.mesh.form(0), { corner }).value.w, 1e-13);
    }
    const glm::dvec3 middle = sum / static_cast<double>(corners.size());
    EXPECT_LE(glm::distance(piece.middle().xyz, middle), 1e-15);
  }
}

TEST_P(ElementPieces, TheirRangesHoldTheField)
{
  const WholeElement element = this->randomElement(8);
  Random random(9);
  for (const Piece& piece : allPieces(element.piece(), 3))
  {
    const Range range = piece.range();
    const Range atCorners = piece.cornerRange();
    EXPECT_LE(range.lower, atCorners.lower);
    EXPECT_GE(range.upper, atCorners.upper);
    const std::vector<double> values = piece.values();
    EXPECT_EQ(range.lower, *std::min_element(values.begin(), values.end()));
    EXPECT_EQ(range.upper, *std::max_element(values.begin(), values.end()));
    const auto atEachCorner = piece.cornerValues();
    const auto end = atEachCorner.begin() + facts(this->domain()).corners.size();
    EXPECT_EQ(atCorners.lower, *std::min_element(atEachCorner.begin(), end));
    EXPECT_EQ(atCorners.upper, *std::max_element(atEachCorner.begin(), end));
    for (int n = 0; n < 20; ++n)
    {
      const double value =
        evaluateGradient(piece.form(), randomPoint(this->domain(), random)).value.w;
      EXPECT_GE(value, range.lower - 1e-14);
      EXPECT_LE(value, range.upper + 1e-14);
    }
  }
}

TEST_P(ElementPieces, PartsHaveNumbersThatLeadToThem)
{
  const WholeElement element = this->randomElement(10);
  const Piece whole = element.piece();
  EXPECT_EQ(whole.part, 1);
  std::set<int> numbers;
  for (const Piece& part : allPieces(whole, PartBisections))
  {
    numbers.insert(part.part);
    const Piece again = partOf(whole, part.part);
    EXPECT_EQ(again.corners, part.corners);
    EXPECT_EQ(again.coefficients, part.coefficients);
    for (const Piece& inside : allPieces(part, 2))
    {
      EXPECT_EQ(inside.part, part.part);
      EXPECT_EQ(inside.bisections, PartBisections + 2);
    }
  }
  EXPECT_EQ(numbers.size(), std::size_t{ 1 } << PartBisections);
}

TEST_P(ElementPieces, AtTheBoundaryHaveAFaceWithoutNeighbours)
{
  const WholeElement element = this->randomElement(11);
  const std::vector<Piece> pieces = allPieces(element.piece(), bisections);
  int onBoundary = 0;
  for (const Piece& piece : pieces)
  {
    // A step through the middle of a face leads into another piece, or out of the element.
    bool leadsOut = false;
    for (const Face& face : facts(this->domain()).faces)
    {
      const glm::dvec3 outwards = -1e-3 * face.inward.xyz;
      const glm::dvec3 beyond = middleOf(facts(this->domain()), face).xyz + outwards;
      leadsOut = leadsOut || insideMargin(this->domain(), piece.inElement(beyond)) < 0.0;
    }
    EXPECT_EQ(piece.isOnBoundary(), leadsOut);
    onBoundary += leadsOut;
  }
  EXPECT_GT(onBoundary, 0);
  if (this->domain() == Domain::Hexahedron)
  {
    EXPECT_EQ(onBoundary, 64 - 8) << "4 x 4 x 4 pieces without the inner 2 x 2 x 2";
  }
}

TEST(ElementPieces, AreHalvedAcrossTheLongestDirection)
{
  for (const int longest : { 0, 1, 2 })
  {
    WholeElement element(Domain::Hexahedron, 2, [](const glm::dvec3& x) { return x.x; });
    for (Coefficient& c : element.mesh.coefficients)
    {
      c[longest] *= 3.0;
    }
    Piece first = element.piece();
    EXPECT_NEAR(first.worldSize(), std::sqrt(11.0), 1e-14);
    const Piece second = halve(first);
    glm::dvec3 expected(0.5);
    expected[longest] = 0.25;
    EXPECT_EQ(first.middle().xyz, expected);
    expected[longest] = 0.75;
    EXPECT_EQ(second.middle().xyz, expected);
    EXPECT_NEAR(first.worldSize(), std::sqrt(1.0 + 1.0 + 1.5 * 1.5), 1e-14);
  }
}

/// Else their columns are never so narrow that an upright surface in them is proven to be one sheet.
TEST(ElementPieces, FlatOnesAreHalvedAcrossTheirThicknessToo)
{
  // Tetrahedra have long edges from one side to the other.
  for (const Domain domain : { Domain::Hexahedron, Domain::Wedge })
  {
    WholeElement element(domain, 2, [](const glm::dvec3& x) { return x.x; });
    for (Coefficient& c : element.mesh.coefficients)
    {
      c.z *= 1e-9;
    }
    for (const bool isCertified : { false, true })
    {
      Piece piece = element.piece();
      piece.sheet = isCertified ? Monotony::Strict : Monotony::None;
      for (int n = 0; n < 18; ++n)
      {
        halve(piece);
      }
      double thickness = 0.0;
      for (const glm::dvec3& corner : piece.corners)
      {
        thickness = std::max(thickness, corner.z - piece.corners.front().z);
      }
      EXPECT_EQ(thickness < 0.1, !isCertified) << domain << ", thickness " << thickness;
    }
  }
}

TEST(ElementPieces, AnEdgeThatClosesOnItselfIsLong)
{
  // A ring around the z axis, as thick as high: its ends meet where x = 0.
  WholeElement element(Domain::Hexahedron, 4, [](const glm::dvec3& x) { return x.z; });
  for (Coefficient& c : element.mesh.coefficients)
  {
    const double angle = 2.0 * std::acos(-1.0) * c.x;
    const double r = 1.0 + c.y;
    c.x = r * std::cos(angle);
    c.y = r * std::sin(angle);
  }
  EXPECT_EQ(halfOf(element.piece(), true).middle().xyz, glm::dvec3(0.75, 0.5, 0.5));
}

TEST(ElementPieces, AreFiniteUnlessACoefficientIsNot)
{
  for (const int component : { 0, 1, 2, 3 })
  {
    for (const double poison :
      { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
    {
      WholeElement element(Domain::Wedge, 2, [](const glm::dvec3& x) { return x.x; });
      EXPECT_TRUE(element.piece().isFinite());
      element.mesh.coefficients[7][component] = poison;
      EXPECT_FALSE(element.piece().isFinite());
    }
  }
}

} // namespace
} // namespace hop::testing
