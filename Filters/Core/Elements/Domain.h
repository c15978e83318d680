#pragma once

#include "Elements/Space.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hop
{

/// The reference domains. Each is a product of simplices: hexahedron = line x line x line,
/// wedge = triangle x line, tetrahedron alone. Coordinates run over [0,1], as VTK's do.
enum class Domain : std::uint8_t
{
  Hexahedron,
  Tetrahedron,
  Wedge
};

/// Polynomial degrees. Hexahedron: one a coordinate. Wedge: {triangle, triangle, line}.
/// Tetrahedron: the total degree, three times.
using Degrees = std::array<int, 3>;

/// Highest degree of an element of the input: 15 for hexahedra, 10 for the others, of which the
/// conversion is not one of lines. Beyond it the conversion of equispaced nodal values, although in
/// extended precision, loses more digits than doubles can spare.
constexpr int MaximumInputDegree = 15;

constexpr int maximumInputDegree(Domain domain)
{
  return domain == Domain::Hexahedron ? MaximumInputDegree : 10;
}

/// Highest degree that the evaluators take: squares of the input's fields.
constexpr int MaximumDegree = 2 * MaximumInputDegree;

/// Highest degree of any polynomial: the Jacobian determinants of rational elements.
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
/// the domain.
struct Face
{
  int cornerCount = 0;
  std::array<int, 4> corners{};
  ReferenceVector inward;
  double offset = 0.0;
};

/// Constant facts of a domain.
struct DomainFacts
{
  /// Corners in VTK's order of the linear cell.
  std::vector<ReferencePoint> corners;
  std::vector<Face> faces;
  /// Lattice directions along which the domain can be bisected into two domains of its own kind.
  std::vector<LatticePoint> edgeDirections;
};

constexpr int MaximumFaces = 6;
constexpr int MaximumCorners = 8;

const DomainFacts& facts(Domain domain);

/// Pairs of corners that are joined by an edge in that direction.
/// \param direction one of facts(domain).edgeDirections
std::vector<std::pair<int, int>> edgesAlong(Domain domain, const LatticePoint& direction);

/// Number of coefficients (and of nodes of the full Lagrange element).
int coefficientCount(Domain domain, const Degrees& degrees);

/// Where the coefficient of a lattice point is stored: i runs fastest, then j, then k.
int coefficientIndex(Domain domain, const Degrees& degrees, const LatticePoint& point);

/// All lattice points in storage order.
std::vector<LatticePoint> latticePoints(Domain domain, const Degrees& degrees);

bool inLattice(Domain domain, const Degrees& degrees, const LatticePoint& point);

/// The reference point at which a lattice point stands.
ReferencePoint latticePosition(const Degrees& degrees, const LatticePoint& point);

/// The lattice point of a corner of the domain.
LatticePoint cornerLatticePoint(Domain domain, const Degrees& degrees, int corner);

/// The mean of a domain's corners, and that of a face's.
ReferencePoint middleOf(const DomainFacts& domain);
ReferencePoint middleOf(const DomainFacts& domain, const Face& face);

/// Half-space value of a face at u: how far inside of it.
inline double faceMargin(const Face& face, const ReferencePoint& u)
{
  return glm::dot(face.inward.xyz, u.xyz) + face.offset;
}

/// How far inside the domain u lies: the smallest half-space value; negative outside.
double insideMargin(Domain domain, const ReferencePoint& u);

/// A point that is hardly outside, taken to the faces that it is beyond.
ReferencePoint broughtInside(Domain domain, ReferencePoint u);

} // namespace hop
