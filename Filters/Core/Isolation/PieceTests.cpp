#include "Isolation/PieceTests.h"

#include <algorithm>
#include <cmath>

namespace hop
{

PieceTests::PieceTests(Domain domain, const Degrees& degrees, double isovalue)
  : Isovalue(isovalue)
  , Prepared(std::make_shared<const Tables>(
      Tables{ MonotoneTest(domain, degrees), PieceBoundaryTest(domain, degrees) }))
{
}

void PieceTests::beginElement(const Piece& whole)
{
  this->ElementSlack = this->slackOf(whole.range());
}

bool PieceTests::mayHoldSurface(const Piece& piece) const
{
  const Range range = piece.range();
  const double slack = this->slackOf(range);
  return range.lower <= slack && range.upper >= -slack;
}

bool PieceTests::isZero(const Piece& piece) const
{
  const Range range = piece.range();
  return range.lower >= -this->ElementSlack && range.upper <= this->ElementSlack;
}

double PieceTests::signAtCorners(const Piece& piece) const
{
  const Range range = piece.cornerRange();
  return range.lower >= -this->ElementSlack ? 1.0 : range.upper <= this->ElementSlack ? -1.0 : 0.0;
}

Monotony PieceTests::monotony(const Piece& piece) const
{
  return this->Prepared->monotone.monotony(piece.values());
}

bool PieceTests::rises(const Piece& piece) const
{
  return this->Prepared->monotone.rises(piece.values());
}

Monotony PieceTests::sheetIn(const Piece& piece) const
{
  const std::vector<double> values = piece.values();
  double largest = std::abs(this->Isovalue);
  for (const double value : values)
  {
    largest = std::max(largest, std::abs(value));
  }
  const double slack = BisectionRounding * largest;
  const Range atCorners = piece.cornerRange();
  if (!(atCorners.upper >= -slack && atCorners.lower <= slack))
  {
    return Monotony::None;
  }
  const bool mayHoldMore = piece.bisections < MaximumBoundaryBisections && piece.isOnBoundary();
  const Monotony monotony = this->Prepared->monotone.monotony(values);
  return monotony != Monotony::None && mayHoldMore &&
      !this->Prepared->boundary.isCrossedOnce(values, slack)
    ? Monotony::None
    : monotony;
}

std::optional<SheetPair> PieceTests::sheetPairIn(const Piece& piece) const
{
  return findSheetPair(piece.form(), this->Prepared->monotone, this->ElementSlack);
}

double PieceTests::slackOf(const Range& range) const
{
  return BisectionRounding * (range.magnitude() + std::abs(this->Isovalue));
}

} // namespace hop
