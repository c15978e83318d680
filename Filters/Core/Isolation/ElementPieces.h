#pragma once

#include "Elements/Bisection.h"
#include "Elements/ElementMesh.h"
#include "Isolation/MonotoneTest.h"

namespace hop
{

/// What the pieces of all elements of a domain and degrees have in common. Prepared once for these.
struct PieceKind
{
  PieceKind(Domain domain, const Degrees& degrees);

  /// A direction in which pieces can be halved: lattice lines, and the places of coefficients along its edges.
  struct Direction
  {
    LatticeLines coefficients;
    LatticeLines corners;
    std::vector<std::vector<int>> edges;
  };

  Domain domain;
  Degrees degrees;
  std::vector<Direction> directions;
  /// For each corner, in the order of facts(domain).corners, its place among coefficients, and among corners of
  /// pieces.
  std::vector<int> cornerPlaces;
  std::vector<int> cornerOrder;
};

/// A piece of an element, of the same domain and degrees: what is left of it after some halvings.
struct Piece
{
  /// Outlives the piece.
  const PieceKind* kind = nullptr;
  /// Of which the last component is that of F - c (of w (F - c), if rational).
  std::vector<Coefficient> coefficients;
  /// If rational.
  std::vector<double> weights;
  /// In the element's reference space.
  std::vector<glm::dvec3> corners;
  int element = -1;
  int bisections = 0;
  /// Which of the parts of its element it is, or lies in: a one, then a bit for each of the first
  /// PartBisections halvings.
  int part = 1;
  /// How the field rises, if the surface in it is known to be one sheet.
  Monotony sheet = Monotony::None;

  bool certified() const { return this->sheet != Monotony::None; }

  BernsteinForm form() const;
  bool isFinite() const;

  /// Coefficients of F - c, as they are.
  std::vector<double> values() const;
  /// The smallest and the largest of them, and of those at corners.
  Range range() const;
  Range cornerRange() const;
  /// F - c at the corners.
  std::array<double, MaximumCorners> cornerValues() const;

  /// A corner in the element's reference space.
  const glm::dvec3& corner(int c) const { return this->corners[this->kind->cornerOrder[c]]; }
  /// Likewise the middle, and a place of the piece's own reference coordinates.
  ReferencePoint middle() const;
  ReferencePoint inElement(const glm::dvec3& u) const;
  /// Whether it has a face on one of the element's.
  bool isOnBoundary() const;
  /// Diagonal of the bounds of its control points.
  double worldSize() const;
};

/// All of an element. Its domain and degrees are those of `kind`.
Piece wholeElement(const ElementMesh& mesh, int element, double isovalue, const PieceKind& kind);

/// Halves a piece across its longest direction; it keeps the first half.
/// \return the second half
Piece halve(Piece& piece);

/// A part of an element, as numbered in its pieces.
Piece partOf(Piece whole, int part);

constexpr int PartBisections = 3;

} // namespace hop
