#pragma once

#include "Isolation/ElementPieces.h"
#include "Isolation/PieceBoundaryTest.h"
#include "Isolation/SheetPair.h"

#include <memory>
#include <optional>

namespace hop
{

/// What is certain of the surface in pieces of an element. Bounds are widened by the rounding errors of the bisections.
/// Prepared once for a domain and degrees; copies share what is prepared.
class PieceTests
{
public:
  /// Knows nothing: to be assigned to before it is asked.
  PieceTests() = default;
  PieceTests(Domain domain, const Degrees& degrees, double isovalue);

  /// Tells of which element the next pieces are.
  void beginElement(const Piece& whole);

  /// False if all coefficients of F - c have one sign: then their convex hull holds no zero.
  bool mayHoldSurface(const Piece& piece) const;

  /// Whether the field is the isovalue all over the piece, up to rounding errors.
  bool isZero(const Piece& piece) const;

  /// Sign of F - c at all corners that are not zero, 1 or -1; 0 if there are corners of both signs.
  double signAtCorners(const Piece& piece) const;

  /// How the field rises along its mean gradient.
  Monotony monotony(const Piece& piece) const;
  /// Whether it does, weakly at least.
  bool rises(const Piece& piece) const;

  /// How the field rises, if the surface in the piece is proven to be one sheet: F - c has both signs at corners, or is
  /// zero there, and rises along some direction. On the boundary of the element the sheet must also be in one part
  /// (PieceBoundaryTest.h): a second part could be all that the mesh has of a component. None otherwise.
  Monotony sheetIn(const Piece& piece) const;

  /// Two sheets close to each other, in the reference coordinates of the piece; nothing if there is no proof of them.
  std::optional<SheetPair> sheetPairIn(const Piece& piece) const;

private:
  double slackOf(const Range& range) const;

  struct Tables
  {
    MonotoneTest monotone;
    PieceBoundaryTest boundary;
  };

  double Isovalue = 0.0;
  /// Largest rounding error of values in the element.
  double ElementSlack = 0.0;
  std::shared_ptr<const Tables> Prepared;
};

/// Bisections, ten along each axis of a nearly cubic element, after which the sheet in a piece on the boundary of its
/// element may be in several parts. Chosen by experiment, fewer than MaximumBisections so that pieces at a tangency
/// with a face are certified in the end. Fewer lose larger components that the mesh cuts off; more take longer there.
constexpr int MaximumBoundaryBisections = 30;

} // namespace hop
