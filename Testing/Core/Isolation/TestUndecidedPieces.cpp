#include "Isolation/UndecidedPieces.h"

#include "PieceCases.h"

#include <algorithm>

namespace hop::testing
{
namespace
{

PieceTests testsOf(const Piece& whole)
{
  PieceTests tests(whole.kind->domain, whole.kind->degrees, 0.0);
  tests.beginElement(whole);
  return tests;
}

/// Fields over the reference domain with one sign at its corners.
double tangentField(const glm::dvec3& u)
{
  return (u.x - 0.23) * (u.x - 0.23);
}
double apartField(const glm::dvec3& u)
{
  return tangentField(u) + 0.01;
}
double crossingField(const glm::dvec3& u)
{
  return tangentField(u) - 0.01;
}
/// And one with both.
double planeField(const glm::dvec3& u)
{
  return u.x - 0.23;
}

/// Rules for levels that are copies of one piece.
class StopRules : public ::testing::TestWithParam<Domain>
{
protected:
  StopRule ruleOf(const Field& field, int bisections, int pieces, bool isCrossed = false) const
  {
    const WholeElement element(this->GetParam(), 2, field);
    Piece piece = element.piece();
    const PieceTests tests = testsOf(piece);
    piece.bisections = bisections;
    return stopRuleOf(std::vector<Piece>(pieces, piece), isCrossed, tests);
  }
};

INSTANTIATE_TEST_SUITE_P(UndecidedPieces, StopRules, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(StopRules, ManyPiecesWithOneSignTellOfATangency)
{
  EXPECT_FALSE(this->ruleOf(tangentField, 9, 64).tangent);
  EXPECT_TRUE(this->ruleOf(tangentField, 9, 65).tangent);
  EXPECT_FALSE(this->ruleOf(tangentField, 9, 1024, true).tangent) << "where the surface crosses";
  EXPECT_TRUE(this->ruleOf(tangentField, 9, 1025, true).tangent);
  EXPECT_FALSE(this->ruleOf(tangentField, 9, 1025, true).apart);
}

TEST_P(StopRules, HoldAfterAllAxesWereHalvedOnly)
{
  for (const int bisections : { 3, 6, 8, 10, 11, 13 })
  {
    EXPECT_FALSE(this->ruleOf(tangentField, bisections, 65).tangent) << bisections;
  }
  EXPECT_TRUE(this->ruleOf(tangentField, 12, 65).tangent);
}

TEST_P(StopRules, AnySmallPieceWithOneSignIsTested)
{
  const StopRule few = this->ruleOf(tangentField, 18, 1, true);
  EXPECT_TRUE(few.tangent);
  EXPECT_FALSE(few.apart);
  EXPECT_FALSE(this->ruleOf(tangentField, 15, 1, true).tangent);
  EXPECT_TRUE(this->ruleOf(tangentField, 18, 1025, true).apart);
}

TEST_P(StopRules, PiecesWithoutSurfaceOrWithBothSignsDoNotCount)
{
  EXPECT_FALSE(this->ruleOf(planeField, 9, 2000).tangent);
  const Field away = [](const glm::dvec3& u) { return 5.0 + u.x; };
  EXPECT_FALSE(this->ruleOf(away, 9, 2000).tangent);
}

TEST_P(StopRules, LimitTheNumberOfUndecidedPieces)
{
  EXPECT_FALSE(this->ruleOf(planeField, 4, TooManyPieces::Count).all);
  EXPECT_TRUE(this->ruleOf(planeField, 4, TooManyPieces::Count + 1).all);
  EXPECT_FALSE(
    this->ruleOf(planeField, TooManyPieces::LongBisections, TooManyPieces::LongCount).all);
  EXPECT_TRUE(
    this->ruleOf(planeField, TooManyPieces::LongBisections, TooManyPieces::LongCount + 1).all);
}

TEST_P(StopRules, PartsOfACellShareItsLimit)
{
  const WholeElement element(this->GetParam(), 2, planeField);
  Piece piece = element.piece();
  const PieceTests tests = testsOf(piece);
  const auto areTooMany = [&](int pieces, int parts)
  { return stopRuleOf(std::vector<Piece>(pieces, piece), false, tests, parts).all; };
  EXPECT_FALSE(areTooMany(TooManyPieces::Count / 8, 8));
  EXPECT_TRUE(areTooMany(TooManyPieces::Count / 8 + 1, 8));
  // Parts for other isovalues leave enough for the surface in one part.
  EXPECT_FALSE(areTooMany(TooManyPieces::FewestOfElement, TooManyPieces::Count));
  EXPECT_TRUE(areTooMany(TooManyPieces::FewestOfElement + 1, TooManyPieces::Count));
  piece.bisections = TooManyPieces::LongBisections;
  EXPECT_TRUE(areTooMany(2, TooManyPieces::LongCount));
  EXPECT_FALSE(areTooMany(1, 10 * TooManyPieces::LongCount)) << "one piece is no more than it was";
}

TEST_P(StopRules, DoNotLimitCertifiedPieces)
{
  const WholeElement element(this->GetParam(), 1, planeField);
  Piece piece = element.piece();
  const PieceTests tests = testsOf(piece);
  piece.sheet = Monotony::Strict;
  EXPECT_FALSE(stopRuleOf(std::vector<Piece>(TooManyPieces::Count + 1, piece), false, tests).all);
}

TEST(UndecidedPieces, AreLimitedInBytes)
{
  // A piece of degree 30 takes about a megabyte of coefficients.
  Piece piece;
  piece.coefficients.resize(29791);
  const PieceKind kind(Domain::Hexahedron, { 1, 1, 1 });
  piece.kind = &kind;
  const std::size_t enough =
    TooManyPieces::Bytes / (piece.coefficients.size() * sizeof(Coefficient));
  ASSERT_LT(enough, 600u);
  const PieceTests tests(Domain::Hexahedron, { 1, 1, 1 }, 0.0);
  std::vector<Piece> level(enough + 1);
  level.front() = piece;
  EXPECT_TRUE(stopRuleOf(level, false, tests).all) << "as if all were like the first";
  level.pop_back();
  EXPECT_FALSE(stopRuleOf(level, false, tests).all);
}

/// Whether the whole element stays undecided by a rule.
bool stays(Domain domain, const Field& field, bool tangent, bool apart)
{
  const WholeElement element(domain, 2, field);
  const Piece piece = element.piece();
  StopRule rule;
  rule.tangent = tangent;
  rule.apart = apart;
  return staysUndecided(piece, rule, testsOf(piece));
}

TEST_P(StopRules, StopPiecesInWhichTheFieldIsTangent)
{
  const Domain domain = this->GetParam();
  EXPECT_TRUE(stays(domain, tangentField, true, false));
  EXPECT_FALSE(stays(domain, tangentField, false, false));
  EXPECT_TRUE(stays(
    domain, [](const glm::dvec3& u) { return -tangentField(u); }, true, false));
}

TEST_P(StopRules, StopPiecesInWhichTheFieldIsApartWhereTheRuleSaysSo)
{
  const Domain domain = this->GetParam();
  EXPECT_FALSE(stays(domain, apartField, true, false));
  EXPECT_TRUE(stays(domain, apartField, true, true));
  EXPECT_FALSE(stays(domain, crossingField, true, true));
}

TEST_P(StopRules, DoNotStopPiecesThatHalvingDecides)
{
  const Domain domain = this->GetParam();
  EXPECT_FALSE(stays(domain, planeField, true, true)) << "both signs at corners";
  EXPECT_FALSE(stays(
    domain, [](const glm::dvec3& u) { return u.x + u.y + u.z; }, true, true))
    << "it rises";
}

TEST_P(StopRules, NothingButTheIsovalueStaysUndecided)
{
  EXPECT_TRUE(stays(
    this->GetParam(), [](const glm::dvec3&) { return 0.0; }, false, false));
}

TEST_P(StopRules, FewUndecidedBoxesAreKeptManyBecomeParts)
{
  const WholeElement element(this->GetParam(), 2, tangentField);
  const Piece whole = element.piece();
  const PieceTests tests = testsOf(whole);
  UndecidedPieces undecided;
  for (const Piece& piece : allPieces(whole, 5))
  {
    if (piece.part % 2 == 0 && undecided.boxes.size() < 16)
    {
      undecided.boxes.push_back(boxOf(piece, tests));
      undecided.parts.insert(piece.part);
    }
  }
  ASSERT_EQ(undecided.boxes.size(), 16u);
  std::vector<SurfaceBox> boxes(1);
  appendUndecided(undecided, whole, tests, boxes);
  ASSERT_EQ(boxes.size(), 17u) << "appended";
  EXPECT_EQ(boxes[16].middle.u.xyz, undecided.boxes[15].middle.u.xyz);

  undecided.boxes.push_back(undecided.boxes.back());
  boxes.clear();
  appendUndecided(undecided, whole, tests, boxes);
  ASSERT_EQ(boxes.size(), undecided.parts.size());
  for (const Piece& part : allPieces(whole, PartBisections))
  {
    EXPECT_EQ(std::count_if(boxes.begin(), boxes.end(),
                [&](const SurfaceBox& box) { return box.middle.u.xyz == part.middle().xyz; }),
      undecided.parts.count(part.part));
  }
  EXPECT_FALSE(boxes.front().straddles);
}

} // namespace
} // namespace hop::testing
