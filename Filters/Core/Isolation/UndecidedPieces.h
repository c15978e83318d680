#pragma once

#include "Isolation/PieceBoxes.h"

#include <set>

namespace hop
{

/// Which undecided pieces of a level are not halved any more.
struct StopRule
{
  /// All of them, as there are too many.
  bool all = false;
  /// Pieces with one sign at their corners in which the field is tangent to the isovalue (Approach::Tangent).
  bool tangent = false;
  /// Pieces with one sign at their corners in which the field was found apart from the isovalue (Approach::Apart).
  bool apart = false;
};

/// The rule for a level. Where a field is tangent to the isovalue, pieces have one sign at their corners and stay
/// undecided however often they are halved: many of them tell of a tangency.
/// \param level all pieces of the element that are left, of one number of bisections; not empty
/// \param isCrossed whether the element has boxes already, so that the surface crosses it
/// \param partsOfCell elements that share the limits of a cell, at least 1
StopRule stopRuleOf(
  const std::vector<Piece>& level, bool isCrossed, const PieceTests& tests, int partsOfCell = 1);

/// Whether halving a piece that is not certified would not decide it: the field is nothing but the isovalue, or
/// `tangent` or `apart` of the rule holds for the piece.
bool staysUndecided(const Piece& piece, const StopRule& rule, const PieceTests& tests);

/// Boxes of the pieces of an element that stay undecided, and the parts of the element (Piece::part) that hold the
/// pieces.
struct UndecidedPieces
{
  std::vector<SurfaceBox> boxes;
  std::set<int> parts;
};

/// Appends the boxes of undecided pieces if they are few; otherwise the parts of the element that hold the pieces.
/// \param whole the element
void appendUndecided(const UndecidedPieces& undecided, const Piece& whole, const PieceTests& tests,
  std::vector<SurfaceBox>& boxes);

/// Undecided pieces of a cell at most, which its elements share. Where the surface is singular along lines, two
/// sheets that cross for instance, undecided pieces along the lines double in number with each halving of their length.
/// Larger limits take more time and memory there, smaller ones stop pieces that further bisections would decide. Chosen
/// by experiment.
struct TooManyPieces
{
  /// Pieces of any size.
  static constexpr int Count = 16384;
  /// Pieces of any size that each element has where a cell's share is less: a cell with creases has hundreds of elements,
  /// most of them for other isovalues or with little surface. Smaller: components are missed that are found where an
  /// isovalue is contoured alone (test_derived_components.py); larger: noise of hundreds of elements takes longer.
  static constexpr int FewestOfElement = 256;
  /// Bytes of coefficients and weights, 512 MiB: fewer pieces than `Count` from degree 10 of hexahedra on.
  static constexpr std::size_t Bytes = std::size_t{ 1 } << 29;
  /// Bisections, eight along each axis of a nearly cubic element, after which a lower limit holds, and this limit.
  static constexpr int LongBisections = 24;
  static constexpr int LongCount = 1024;
};

} // namespace hop
