#pragma once

#include "Elements/Bisection.h"
#include "Elements/ElementMesh.h"
#include "Isolation/MonotoneTest.h"
#include "Support/Buffer.h"

namespace hop
{

/// What the pieces of all elements of one domain and degrees have in common. Prepared once for a domain and degrees.
struct PieceKind
{
  PieceKind(Domain domain, const Degrees& degrees);

  /// A direction in which pieces can be halved.
  struct Direction
  {
    /// Lines of the lattices of coefficients and of corners along the direction.
    LatticeLines coefficients;
    LatticeLines corners;
    /// For each edge of the domain along the direction, the storage indices of the coefficients on the edge.
    std::vector<std::vector<int>> edges;
    /// For each of these edges, the indices of its two ends among Piece::corners.
    std::vector<std::array<int, 2>> cornerEdges;
  };

  Domain domain;
  Degrees degrees;
  std::vector<Direction> directions;
  /// For each corner, in the order of facts(domain).corners, its index among the coefficients of a piece, and its
  /// index among Piece::corners.
  std::vector<int> cornerPlaces;
  std::vector<int> cornerOrder;
};

/// A piece of an element after some bisections: a polynomial of the element's domain and degrees.
struct Piece
{
  /// Outlives the piece.
  const PieceKind* kind = nullptr;
  /// Bernstein coefficients of (x, y, z, F - c), or of w (x, y, z, F - c) if the element is rational.
  Buffer<Coefficient> coefficients;
  /// Bernstein coefficients of w; empty if the element is not rational.
  std::vector<double> weights;
  /// Corners in the element's reference space, in storage order of the lattice of degree 1.
  std::vector<glm::dvec3> corners;
  int element = -1;
  int bisections = 0;
  /// Number of the part of the element (PartBisections) that holds the piece: in binary, a one, then one digit a
  /// bisection, 0 for the first half and 1 for the second. A piece of fewer bisections is a part itself.
  int part = 1;
  /// How the field rises, if the surface in the piece is proven to be one sheet; None otherwise.
  Monotony sheet = Monotony::None;

  bool certified() const { return this->sheet != Monotony::None; }

  BernsteinForm form() const;
  bool isFinite() const;

  /// Coefficients of F - c, or of w (F - c) if the element is rational.
  std::vector<double> values() const;
  /// Range of values().
  Range range() const;
  /// Range of the values() at corners.
  Range cornerRange() const;
  /// F - c at the corners, in the order of facts(domain).corners.
  std::array<double, MaximumCorners> cornerValues() const;

  /// A corner in the element's reference space.
  /// \param c index among facts(domain).corners
  const glm::dvec3& corner(int c) const { return this->corners[this->kind->cornerOrder[c]]; }
  /// Mean of the corners in the element's reference space.
  ReferencePoint middle() const;
  /// The place in the element's reference space that has the coordinates u in the piece's own reference space.
  ReferencePoint inElement(const glm::dvec3& u) const;
  /// Whether a face of the piece lies on a face of the element.
  bool isOnBoundary() const;
  /// Diagonal of the bounds of the control points, world units.
  double worldSize() const;
};

/// The piece that is a whole element.
/// \param kind of the element's domain and degrees; outlives the piece
Piece wholeElement(const ElementMesh& mesh, int element, double isovalue, const PieceKind& kind);

/// Bisects a piece across the direction of its longest edge in world space; a flat piece that is not certified, across
/// that of its longest edge in reference space where this is much longer.
/// \param piece becomes the first half
/// \return the second half
Piece halve(Piece& piece);

/// A part of an element.
/// \param part number as in Piece::part
Piece partOf(Piece whole, int part);

/// Bisections that divide an element into its parts. Parts replace undecided pieces where these are many
/// (UndecidedPieces.h). Three bisections halve a nearly cubic element once along each axis. More make smaller
/// boxes in larger numbers. Chosen by experiment.
constexpr int PartBisections = 3;

} // namespace hop
