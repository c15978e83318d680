#pragma once

#include "Elements/Space.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace hop
{

/// The reference domains. Each is a product of simplices (DomainFacts::factors): hexahedron = line x line x line,
/// wedge = triangle x line, tetrahedron alone. Coordinates run over [0,1], as VTK's do. What follows from a domain
/// stands in facts(domain), or in a switch that names every domain, so that compilers find what a new one lacks.
/// See Documentation/algorithm.md, section Elements.
enum class Domain : std::uint8_t
{
  Hexahedron,
  Tetrahedron,
  Wedge
};

/// Polynomial degrees. Hexahedron: one a coordinate. Wedge: {triangle, triangle, line}.
/// Tetrahedron: the total degree, three times.
using Degrees = std::array<int, 3>;

/// For a value of Domain that is none of the enumerators, behind a switch that names them all.
/// \throw std::logic_error always
[[noreturn]] void unknownDomain();

/// Highest degree of a hexahedron of the input, and of any element. Beyond it the conversion of equispaced nodal
/// values, although in extended precision, loses more digits than doubles can spare (NodalBasis::conversionError).
constexpr int MaximumInputDegree = 15;

/// Highest degree of the other elements of the input: their conversion has a factor on a triangle or a tetrahedron,
/// not on lines alone.
constexpr int MaximumSimplexInputDegree = 10;

constexpr int maximumInputDegree(Domain domain)
{
  return domain == Domain::Hexahedron ? MaximumInputDegree : MaximumSimplexInputDegree;
}

/// Highest degree that the evaluators take: the square of a field of the input, see squareField().
constexpr int MaximumDegree = 2 * MaximumInputDegree;

/// Highest degree of any polynomial: 4p bounds the determinant of a rational element, see JacobianTest.
constexpr int MaximumPolynomialDegree = 4 * MaximumInputDegree;

/// A point of an element's lattice of coefficients or nodes, at reference coordinates
/// (i/p, j/q, k/r); for simplices i + j (+ k) does not exceed the degree.
struct LatticePoint
{
  int i = 0;
  int j = 0;
  int k = 0;
};

/// A face: its corners in cyclic order, and the half-space 'inward . u + offset >= 0' that holds
/// the domain, scaled so that the corner farthest from the face has the value 1.
struct Face
{
  int cornerCount = 0;
  /// Numbers of corners of the domain; cornerCount of them.
  std::array<int, 4> corners{};
  ReferenceVector inward;
  double offset = 0.0;
};

/// A line, triangle or tetrahedron (dimension 1, 2, 3) of which a domain is a product. The coordinates `axis` to
/// `axis + dimension - 1` run in it: each >= 0, their sum <= 1. They have one degree.
struct SimplexFactor
{
  int axis = 0;
  int dimension = 1;

  int end() const { return this->axis + this->dimension; }
};

/// Constant facts of a domain.
struct DomainFacts
{
  /// The simplices of which the domain is the product, by axis.
  std::vector<SimplexFactor> factors;
  /// Corners in VTK's order of the linear cell.
  std::vector<ReferencePoint> corners;
  std::vector<Face> faces;
  /// Lattice directions along which the domain can be bisected into two domains of its own kind.
  std::vector<LatticePoint> edgeDirections;
  /// Pairs of corners that are joined by an edge, direction after direction.
  std::vector<std::pair<int, int>> edges;
};

/// Largest numbers over all domains: lengths of arrays that hold one entry a face or a corner.
constexpr int MaximumFaces = 6;
constexpr int MaximumCorners = 8;

const DomainFacts& facts(Domain domain);

/// The factor of a domain in which a coordinate runs.
/// \param axis 0, 1 or 2
const SimplexFactor& factorOf(Domain domain, int axis);

/// Pairs of corners that are joined by an edge in that direction.
/// \param direction one of facts(domain).edgeDirections
std::vector<std::pair<int, int>> edgesAlong(Domain domain, const LatticePoint& direction);

/// Number of coefficients (and of nodes of the full Lagrange element).
int coefficientCount(Domain domain, const Degrees& degrees);

/// Where the coefficient of a lattice point is stored: i runs fastest, then j, then k.
int coefficientIndex(Domain domain, const Degrees& degrees, const LatticePoint& point);

/// All lattice points in storage order.
std::vector<LatticePoint> latticePoints(Domain domain, const Degrees& degrees);

/// Whether a domain's lattice holds a point, whose numbers may be negative or too large.
bool inLattice(Domain domain, const Degrees& degrees, const LatticePoint& point);

/// The reference point at which a lattice point stands.
ReferencePoint latticePosition(const Degrees& degrees, const LatticePoint& point);

/// The lattice point of a corner of the domain.
LatticePoint cornerLatticePoint(Domain domain, const Degrees& degrees, int corner);

/// The mean of the corners of a domain, or of a face.
ReferencePoint middleOf(const DomainFacts& domain);
ReferencePoint middleOf(const DomainFacts& domain, const Face& face);

/// Half-space value of a face at u: 0 on the face, 1 at the corner farthest from it, negative outside.
inline double faceMargin(const Face& face, const ReferencePoint& u)
{
  return glm::dot(face.inward.xyz, u.xyz) + face.offset;
}

/// How far inside the domain u lies: the smallest faceMargin() of its faces; negative outside.
double insideMargin(Domain domain, const ReferencePoint& u);

/// A point taken to the plane of each face that it is beyond, face after face: inside, to rounding, if it was hardly
/// outside.
ReferencePoint broughtInside(Domain domain, ReferencePoint u);

} // namespace hop
