#pragma once

#include "Isolation/IsolationProgress.h"
#include "Isolation/UndecidedPieces.h"

#include <map>
#include <utility>

namespace hop
{

/// What splitting needs to know of the domains and degrees of a mesh's elements: prepared once, for all threads.
class PreparedKinds
{
public:
  struct Prepared
  {
    PieceKind kind;
    PieceTests tests;
  };

  PreparedKinds(const ElementMesh& mesh, double isovalue);

  /// \pre the mesh has an element of this domain and these degrees
  const Prepared& of(Domain domain, const Degrees& degrees) const
  {
    return this->Kinds.at({ domain, degrees });
  }

private:
  std::map<std::pair<Domain, Degrees>, Prepared> Kinds;
};

/// Splits elements into boxes by de Casteljau's algorithm. A piece of an element is
///  - dropped if its coefficients of F - c have one sign: their convex hull then holds no zero;
///  - certified if F - c changes its sign between corners and the coefficients of its derivative along the mean
///    gradient have one sign, or are zero only where F - c is not (MonotoneTest.h). The surface then is a graph along
///    the mean gradient, so that it is one sheet and has no component inside the piece. In a piece with a face on a
///    face of its element the sheet must also be in one part (PieceBoundaryTest.h), as a corner that the sheet cuts off
///    there may be all that the mesh has of a component;
///  - replaced by two boxes if it holds two sheets close to each other (SheetPair.h), is small, and was halved often
///    enough for both sheets to be nearly flat;
///  - halved across its longest direction otherwise.
/// An undecided piece is not halved any more after MaximumBisections bisections, nor are all undecided pieces of an
/// element where there are too many of them (TooManyPieces in UndecidedPieces.h): the surface then is singular
/// along lines. A piece that is not halved is certified if its field rises along some direction all the same: the
/// surface then only touches the box, or cuts off a negligible part of it. Otherwise its box is returned undecided.
/// Pieces in which the field is tangent to the isovalue (TangencyTest.h) are left undecided much earlier. Undecided
/// pieces with one sign at their corners are replaced by a few large boxes that do not straddle: the parts of the
/// element that hold them (UndecidedPieces.h).
/// Certified pieces are split on until they are small enough, and dropped where they hold no surface.
/// Derivation: Documentation/algorithm.md, section Isolation.
class ElementSplitter
{
public:
  /// \param mesh, kinds, isSmall outlive it; isSmall may be called from several threads
  ElementSplitter(const ElementMesh& mesh, double isovalue, const PreparedKinds& kinds,
    const std::function<bool(const SurfaceBox&)>& isSmall);

  /// Appends the boxes of an element.
  void split(int element, const ParallelFor& parallelFor, const ReportProgress& progress,
    std::vector<SurfaceBox>& boxes);

  /// Appends the boxes of an element on the caller's thread, unless that takes long: nothing is appended then.
  /// \return whether the element is done
  bool splitIfShort(int element, std::vector<SurfaceBox>& boxes);

private:
  /// What becomes of a piece: nothing, boxes, an undecided box, or pieces of the next level.
  struct Outcome
  {
    std::vector<SurfaceBox> boxes;
    /// The box may be replaced by a part of the element.
    bool isUndecided = false;
    /// Two halves, or what a certified piece has left after its boxes so far.
    std::vector<Piece> next;
  };

  bool splitWithin(std::size_t mostPieces, int element, const ParallelFor& parallelFor,
    const ReportProgress& progress, std::vector<SurfaceBox>& boxes);
  void prepareFor(const Element& element);
  std::vector<Outcome> decideAll(std::vector<Piece>& level, const StopRule& rule, int follow,
    const ParallelFor& parallelFor, IsolationProgress& progress) const;
  static std::vector<Piece> sortOut(std::vector<Piece> level, std::vector<Outcome> outcomes,
    std::vector<SurfaceBox>& boxes, UndecidedPieces& undecided);

  Outcome decide(Piece& piece, const StopRule& rule, int follow) const;
  bool finishCertified(const Piece& piece, std::vector<SurfaceBox>& boxes) const;
  bool finishUndecided(const Piece& piece, const StopRule& rule, Outcome& outcome) const;
  std::vector<Piece> followToBoxes(Piece piece, int most, std::vector<SurfaceBox>& boxes) const;

  const ElementMesh& Mesh;
  double Isovalue;
  const PreparedKinds& Kinds;
  const std::function<bool(const SurfaceBox&)>& IsSmall;
  /// Of the element that is being split.
  const PieceKind* Kind = nullptr;
  PieceTests Tests;
  /// In world space.
  double ElementSize = 0.0;
};

/// Bisections of a piece at most: twelve along each axis of a nearly cubic element, so that components larger than
/// 2^-12 of the element are found (SurfaceBoxes.h). Chosen by experiment: more find smaller components, and take
/// longer where the surface is singular.
constexpr int MaximumBisections = 36;

} // namespace hop
