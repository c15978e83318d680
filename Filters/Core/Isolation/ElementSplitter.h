#pragma once

#include "Isolation/FoundShare.h"
#include "Isolation/UndecidedPieces.h"

namespace hop
{

/// Splits elements into boxes by de Casteljau's algorithm. A piece of an element is
///  - dropped if its coefficients of F - c have one sign: the convex hull holds no zero;
///  - certified if F - c changes its sign between corners and its derivative along the mean gradient
///    has coefficients of one sign, or is zero only where F - c is not (MonotoneTest.h): then the surface is
///    a graph along that direction, one sheet, and has no component of its own inside the piece. A piece with a face
///    on its element's must also hold one piece of the sheet only (BoundaryTest.h), as a corner that it cuts off
///    there may be all that the mesh has of a component;
///  - taken for two boxes if it holds two sheets close to each other (SheetPair.h), is small and was halved often
///    enough for them to be as good as flat;
///  - halved otherwise, across its longest direction; until it was halved MaximumBisections times, or its element had
///    to be split into more than MaximumPieces undecided pieces, or MaximumPieceBytes of them, or
///    MaximumLongPieces where they were halved LongBisections times: then the surface is singular along lines.
///    What is left then is certified if its field rises along some direction all the same: the surface touches such a
///    box, or cuts off less of it than counts. Otherwise it is returned uncertified.
/// Where the field only touches the isovalue (TangencyTest.h) an element is given up much earlier. What has
/// one sign at its corners and is left so is returned as a few large boxes, that do not straddle: of the
/// parts of the element, halved PartBisections times, that it lies in (UndecidedPieces.h).
/// Certified pieces are split on until small enough, and dropped where empty.
class ElementSplitter
{
public:
  /// \param mesh, isSmall outlive it; isSmall may be called from several threads
  ElementSplitter(const ElementMesh& mesh, double isovalue,
    const std::function<bool(const SurfaceBox&)>& isSmall);

  /// Appends the boxes of an element.
  void split(int element, const ParallelFor& parallelFor, const ReportShare& found,
    std::vector<SurfaceBox>& boxes);

private:
  /// What becomes of a piece: nothing, boxes, one that is left undecided, or two halves, of which it
  /// keeps the first.
  struct Outcome
  {
    std::vector<SurfaceBox> boxes;
    bool isHalved = false;
    bool isLeft = false;
    Piece second;
  };

  void prepareFor(const BernsteinForm& form);
  std::vector<Outcome> decideAll(std::vector<Piece>& level, const GivenUp& givenUp,
    const ParallelFor& parallelFor, FoundShare& share) const;
  static std::vector<Piece> sortOut(std::vector<Piece> level, std::vector<Outcome> outcomes,
    std::vector<SurfaceBox>& boxes, LeftUndecided& left);

  Outcome decide(Piece& piece, const GivenUp& givenUp, bool toTheEnd) const;
  bool finishCertified(const Piece& piece, std::vector<SurfaceBox>& boxes) const;
  bool finishUndecided(const Piece& piece, const GivenUp& givenUp, Outcome& outcome) const;
  std::optional<SheetPair> sheetPairIn(const Piece& piece, bool isLast) const;
  void followToBoxes(Piece& piece, std::vector<SurfaceBox>& boxes) const;

  const ElementMesh& Mesh;
  double Isovalue;
  const std::function<bool(const SurfaceBox&)>& IsSmall;
  /// Of the element at hand.
  PieceKind Kind;
  PieceTests Tests;
};

constexpr int MaximumBisections = 36;

} // namespace hop
