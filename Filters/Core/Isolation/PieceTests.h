#pragma once

#include "Isolation/BoundaryTest.h"
#include "Isolation/ElementPieces.h"
#include "Isolation/SheetPair.h"

#include <optional>

namespace hop
{

/// What can be told for certain of the surface in pieces of an element. Bounds are widened by the rounding errors of
/// the halving. Prepared once for a domain and degrees.
class PieceTests
{
public:
  PieceTests(Domain domain, const Degrees& degrees, double isovalue);

  /// Tells which element the pieces will be of.
  void beginElement(const Piece& whole);

  /// Whether coefficients of F - c do not have one sign: otherwise the convex hull holds no zero.
  bool mayHoldSurface(const Piece& piece) const;

  /// Whether the field is nothing but the isovalue, to its rounding errors in the element.
  bool isZero(const Piece& piece) const;

  /// 1 or -1 if corners have that sign, or are at zero; 0 if they have both.
  double signAtCorners(const Piece& piece) const;

  /// How the field rises along its mean gradient.
  Monotony monotony(const Piece& piece) const;
  bool rises(const Piece& piece) const;

  /// How the field rises, if the surface is known to be one sheet: it has corners of both signs, or at zero,
  /// and rises along some direction. On the boundary curve of the element there must also be one piece only: another one
  /// could be all there is of a component.
  Monotony sheetIn(const Piece& piece) const;

  /// Two sheets close to each other.
  std::optional<SheetPair> sheetPairIn(const Piece& piece) const;

private:
  double slackOf(const Range& range) const;

  double Isovalue;
  /// What rounding errors of values may amount to in the element.
  double ElementSlack = 0.0;
  MonotoneTest Monotone;
  BoundaryTest Boundary;
};

/// Pieces on the boundary curve of their element, halved that often, need not hold one piece of their sheet only.
constexpr int MaximumBoundaryBisections = 30;

} // namespace hop
