#include "Isolation/UndecidedPieces.h"

#include "Isolation/TangencyTest.h"

#include <algorithm>

namespace hop
{
namespace
{

/// When the undecided pieces of an element are tested for tangency. Without the test the square of a velocity, zero at
/// a wall, took 16,384 boxes an element. The figures were chosen by experiment.
struct TangencyTests
{
  /// Bisections from one test to the next: each axis of a nearly cubic element is halved once in between. Fewer cost
  /// more tests of pieces that hardly changed.
  static constexpr int Interval = 3;
  /// Bisections before the first test: three along each axis. After fewer bisections pieces still hold the surface and
  /// a tangency side by side; after more there are more pieces to test.
  static constexpr int First = 9;
  /// Undecided pieces with one sign at their corners that are normal where the surface crosses the element. A smaller
  /// number tests pieces that a few bisections would decide, a larger one takes more time where there is a tangency.
  static constexpr int FewOneSided = 1024;
  /// The same where nothing tells that the surface crosses the element.
  static constexpr int FewOneSidedWithoutSurface = 64;
  /// Bisections, six along each axis, after which no undecided piece with one sign at its corners is normal. Fewer may
  /// take components that small for tangencies; more take longer.
  static constexpr int Small = 18;
};

/// Undecided pieces of an element that become boxes of their own at most. Chosen by experiment: more give boxes that
/// are smaller and say better where the surface is undecided, at a cost in samples and messages.
constexpr std::size_t mostOwnBoxes = 16;

std::ptrdiff_t undecidedCount(const std::vector<Piece>& pieces)
{
  return std::count_if(
    pieces.begin(), pieces.end(), [](const Piece& piece) { return !piece.certified(); });
}

/// The limit on undecided pieces of the size of a piece, in one of the elements of a cell.
std::ptrdiff_t mostUndecided(const Piece& piece, int partsOfCell)
{
  const std::size_t bytes =
    piece.coefficients.size() * sizeof(Coefficient) + piece.weights.size() * sizeof(double);
  if (piece.bisections >= TooManyPieces::LongBisections)
  {
    return std::max(1, TooManyPieces::LongCount / partsOfCell);
  }
  const auto ofCell = std::min<std::ptrdiff_t>(TooManyPieces::Count, TooManyPieces::Bytes / bytes);
  const std::ptrdiff_t fewest = std::min<std::ptrdiff_t>(ofCell, TooManyPieces::FewestOfElement);
  return std::max(ofCell / partsOfCell, fewest);
}

} // namespace

StopRule stopRuleOf(
  const std::vector<Piece>& level, bool isCrossed, const PieceTests& tests, int partsOfCell)
{
  StopRule rule;
  // Undecided pieces of a level are of one size; certified ones may have been halved more often.
  const auto undecided =
    std::find_if(level.begin(), level.end(), [](const Piece& piece) { return !piece.certified(); });
  if (undecided == level.end())
  {
    return rule;
  }
  rule.all = undecidedCount(level) > mostUndecided(*undecided, partsOfCell);
  const int bisections = undecided->bisections;
  if (bisections < TangencyTests::First || bisections % TangencyTests::Interval != 0)
  {
    return rule;
  }
  int oneSided = 0;
  for (const Piece& piece : level)
  {
    const bool isOneSided = !piece.certified() && tests.signAtCorners(piece) != 0.0;
    isCrossed = isCrossed || !isOneSided;
    oneSided += isOneSided && tests.mayHoldSurface(piece);
  }
  const bool areSmall = bisections >= TangencyTests::Small;
  rule.tangent = areSmall ||
    oneSided > (isCrossed ? TangencyTests::FewOneSided : TangencyTests::FewOneSidedWithoutSurface);
  rule.apart = areSmall && oneSided > TangencyTests::FewOneSided;
  return rule;
}

bool staysUndecided(const Piece& piece, const StopRule& rule, const PieceTests& tests)
{
  if (tests.isZero(piece))
  {
    return true;
  }
  const double sign = rule.tangent ? tests.signAtCorners(piece) : 0.0;
  if (sign == 0.0 || tests.rises(piece))
  {
    return false;
  }
  const Approach approach = approachToZero(piece.form(), sign);
  return approach == Approach::Tangent || (rule.apart && approach == Approach::Apart);
}

void appendUndecided(const UndecidedPieces& undecided, const Piece& whole, const PieceTests& tests,
  std::vector<SurfaceBox>& boxes)
{
  if (undecided.boxes.size() <= mostOwnBoxes)
  {
    boxes.insert(boxes.end(), undecided.boxes.begin(), undecided.boxes.end());
    return;
  }
  for (const int part : undecided.parts)
  {
    boxes.push_back(boxOfUndecidedPart(partOf(whole, part), tests));
  }
}

} // namespace hop
