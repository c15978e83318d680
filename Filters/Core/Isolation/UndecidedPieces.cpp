#include "Isolation/UndecidedPieces.h"

#include "Isolation/TangencyTest.h"

#include <algorithm>

namespace hop
{
namespace
{

/// Pieces are looked at every so many halvings, as soon as each axis had so many, for whether they touch the
/// isovalue only.
constexpr int halvingsOfAllAxes = 3;
constexpr int firstTangencyBisections = 9;
/// As many pieces with one sign at their corners are normal in an element that the surface crosses, and
/// where nothing tells that it does. None are after so many halvings.
constexpr int fewOneSided = 1024;
constexpr int fewOneSidedWithoutSurface = 64;
constexpr int smallBisections = 18;
/// As many pieces given up are boxes of their own.
constexpr std::size_t fewLeft = 16;

std::ptrdiff_t undecidedCount(const std::vector<Piece>& pieces)
{
  return std::count_if(
    pieces.begin(), pieces.end(), [](const Piece& piece) { return !piece.certified(); });
}

std::ptrdiff_t mostUndecided(const Piece& piece)
{
  const std::size_t bytes =
    piece.coefficients.size() * sizeof(Coefficient) + piece.weights.size() * sizeof(double);
  return piece.bisections >= LongBisections
    ? MaximumLongPieces
    : std::min<std::ptrdiff_t>(MaximumPieces, MaximumPieceBytes / bytes);
}

} // namespace

GivenUp givenUp(const std::vector<Piece>& level, bool isCrossed, const PieceTests& tests)
{
  GivenUp result;
  result.all = undecidedCount(level) > mostUndecided(level.front());
  const int bisections = level.front().bisections;
  if (bisections < firstTangencyBisections || bisections % halvingsOfAllAxes != 0)
  {
    return result;
  }
  int oneSided = 0;
  for (const Piece& piece : level)
  {
    const bool isOneSided = !piece.certified() && tests.signAtCorners(piece) != 0.0;
    isCrossed = isCrossed || !isOneSided;
    oneSided += isOneSided && tests.mayHoldSurface(piece);
  }
  const bool areSmall = bisections >= smallBisections;
  result.tangent = areSmall || oneSided > (isCrossed ? fewOneSided : fewOneSidedWithoutSurface);
  result.missing = areSmall && oneSided > fewOneSided;
  return result;
}

bool isGivenUp(const Piece& piece, const GivenUp& some, const PieceTests& tests)
{
  if (tests.isZero(piece))
  {
    return true;
  }
  const double sign = some.tangent ? tests.signAtCorners(piece) : 0.0;
  if (sign == 0.0 || tests.rises(piece))
  {
    return false;
  }
  const Approach approach = approachToZero(piece.form(), sign);
  return approach == Approach::Tangent || (some.missing && approach == Approach::Apart);
}

void appendLeft(const LeftUndecided& left, const Piece& whole, const PieceTests& tests,
  std::vector<SurfaceBox>& boxes)
{
  if (left.boxes.size() <= fewLeft)
  {
    boxes.insert(boxes.end(), left.boxes.begin(), left.boxes.end());
    return;
  }
  for (const int part : left.parts)
  {
    boxes.push_back(boxOfUnknown(partOf(whole, part), tests));
  }
}

} // namespace hop
