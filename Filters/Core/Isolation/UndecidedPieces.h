#pragma once

#include "Isolation/PieceBoxes.h"

#include <set>

namespace hop
{

/// Which undecided pieces of an element are not halved any more.
struct GivenUp
{
  /// All: there are too many of them.
  bool all = false;
  /// Those in which the field touches the isovalue (TangencyTest.h), if it has one sign at their corners.
  bool tangent = false;
  /// Those, too, in which it was found neither to touch nor to cross it.
  bool missing = false;
};

/// Where a field only touches the isovalue its pieces stay undecided, on and on, and have one sign
/// at their corners.
/// \param level all pieces of the element, as often halved
/// \param isCrossed whether there are boxes already
GivenUp givenUp(const std::vector<Piece>& level, bool isCrossed, const PieceTests& tests);

/// Whether a piece that is not certified is not worth halving.
/// \param some that are given up; `all` does not count
bool isGivenUp(const Piece& piece, const GivenUp& some, const PieceTests& tests);

/// Boxes of pieces that were left undecided, and the parts of the element that they lie in.
struct LeftUndecided
{
  std::vector<SurfaceBox> boxes;
  std::set<int> parts;
};

/// Few boxes that were left undecided as they are, in place of many the parts that they lie in.
/// \param whole their element
void appendLeft(const LeftUndecided& left, const Piece& whole, const PieceTests& tests,
  std::vector<SurfaceBox>& boxes);

constexpr int MaximumPieces = 16384;
constexpr std::size_t MaximumPieceBytes = std::size_t{ 1 } << 29;
constexpr int LongBisections = 24;
constexpr int MaximumLongPieces = 1024;

} // namespace hop
