#include "Elements/Domain.h"

#include "Elements/LatticeRows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace hop
{
namespace
{

ReferencePoint at(double u, double v, double w)
{
  return { { u, v, w } };
}

/// The half-space of a face from its corners: the plane through three of them, turned towards the
/// domain's centre and scaled so that the farthest corner has value 1.
Face makeFace(const std::vector<ReferencePoint>& corners, const std::vector<int>& ring)
{
  Face face;
  face.cornerCount = static_cast<int>(ring.size());
  std::copy(ring.begin(), ring.end(), face.corners.begin());
  const glm::dvec3 origin = corners[ring[0]].xyz;
  const glm::dvec3 normal =
    glm::cross(corners[ring[1]].xyz - origin, corners[ring[2]].xyz - origin);
  double farthest = 0.0;
  for (const ReferencePoint& corner : corners)
  {
    const double distance = glm::dot(normal, corner.xyz - origin);
    farthest = std::abs(distance) > std::abs(farthest) ? distance : farthest;
  }
  face.inward = { normal / farthest };
  face.offset = -glm::dot(face.inward.xyz, origin);
  return face;
}

std::vector<std::pair<int, int>> edgesBetween(
  const std::vector<ReferencePoint>& corners, const LatticePoint& direction)
{
  const glm::dvec3 step(direction.i, direction.j, direction.k);
  std::vector<std::pair<int, int>> edges;
  for (int a = 0; a < static_cast<int>(corners.size()); ++a)
  {
    for (int b = 0; b < static_cast<int>(corners.size()); ++b)
    {
      if (corners[a].xyz + step == corners[b].xyz)
      {
        edges.emplace_back(a, b);
      }
    }
  }
  return edges;
}

/// \param faceRings the corners of each face in cyclic order
DomainFacts makeFacts(std::vector<SimplexFactor> factors, std::vector<ReferencePoint> corners,
  const std::vector<std::vector<int>>& faceRings, std::vector<LatticePoint> directions)
{
  DomainFacts result;
  result.factors = std::move(factors);
  result.corners = std::move(corners);
  result.edgeDirections = std::move(directions);
  for (const auto& ring : faceRings)
  {
    result.faces.push_back(makeFace(result.corners, ring));
  }
  for (const LatticePoint& direction : result.edgeDirections)
  {
    const auto edges = edgesBetween(result.corners, direction);
    result.edges.insert(result.edges.end(), edges.begin(), edges.end());
  }
  return result;
}

DomainFacts hexahedronFacts()
{
  return makeFacts({ { 0, 1 }, { 1, 1 }, { 2, 1 } },
    { at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1),
      at(0, 1, 1) },
    { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 }, { 0, 3, 2, 1 },
      { 4, 5, 6, 7 } },
    { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } });
}

DomainFacts tetrahedronFacts()
{
  return makeFacts({ { 0, 3 } }, { at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1) },
    { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 }, { 0, 2, 1 } },
    { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 1, 0 }, { -1, 0, 1 }, { 0, -1, 1 } });
}

DomainFacts wedgeFacts()
{
  return makeFacts({ { 0, 2 }, { 2, 1 } },
    { at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(0, 1, 1) },
    { { 0, 1, 2 }, { 3, 5, 4 }, { 0, 3, 4, 1 }, { 1, 4, 5, 2 }, { 2, 5, 3, 0 } },
    { { 1, 0, 0 }, { 0, 1, 0 }, { -1, 1, 0 }, { 0, 0, 1 } });
}

int triangleCount(int degree)
{
  return (degree + 1) * (degree + 2) / 2;
}

int tetrahedronCount(int degree)
{
  return (degree + 1) * (degree + 2) * (degree + 3) / 6;
}

/// Row j of the lattice of a triangle holds degree + 1 - j points.
int triangleIndex(int degree, int i, int j)
{
  return i + j * (2 * degree + 3 - j) / 2;
}

} // namespace

void unknownDomain()
{
  throw std::logic_error("a number that stands for no domain");
}

const DomainFacts& facts(Domain domain)
{
  static const struct
  {
    DomainFacts hexahedron = hexahedronFacts();
    DomainFacts tetrahedron = tetrahedronFacts();
    DomainFacts wedge = wedgeFacts();
  } all;
  switch (domain)
  {
    case Domain::Hexahedron:
      return all.hexahedron;
    case Domain::Tetrahedron:
      return all.tetrahedron;
    case Domain::Wedge:
      return all.wedge;
  }
  unknownDomain();
}

const SimplexFactor& factorOf(Domain domain, int axis)
{
  const std::vector<SimplexFactor>& factors = facts(domain).factors;
  return *std::find_if(factors.begin(), factors.end(),
    [axis](const SimplexFactor& factor) { return axis < factor.end(); });
}

std::vector<std::pair<int, int>> edgesAlong(Domain domain, const LatticePoint& direction)
{
  return edgesBetween(facts(domain).corners, direction);
}

int coefficientCount(Domain domain, const Degrees& degrees)
{
  switch (domain)
  {
    case Domain::Hexahedron:
      return (degrees[0] + 1) * (degrees[1] + 1) * (degrees[2] + 1);
    case Domain::Tetrahedron:
      return tetrahedronCount(degrees[0]);
    case Domain::Wedge:
      return triangleCount(degrees[0]) * (degrees[2] + 1);
  }
  unknownDomain();
}

int coefficientIndex(Domain domain, const Degrees& degrees, const LatticePoint& point)
{
  switch (domain)
  {
    case Domain::Hexahedron:
      return point.i + (degrees[0] + 1) * (point.j + (degrees[1] + 1) * point.k);
    case Domain::Tetrahedron:
      // The layers below k form the whole tetrahedron without the smaller one on top.
      return tetrahedronCount(degrees[0]) - tetrahedronCount(degrees[0] - point.k) +
        triangleIndex(degrees[0] - point.k, point.i, point.j);
    case Domain::Wedge:
      return triangleIndex(degrees[0], point.i, point.j) + triangleCount(degrees[0]) * point.k;
  }
  unknownDomain();
}

bool inLattice(Domain domain, const Degrees& degrees, const LatticePoint& point)
{
  if (std::min({ point.i, point.j, point.k }) < 0 || point.k > degrees[2])
  {
    return false;
  }
  switch (domain)
  {
    case Domain::Hexahedron:
      return point.i <= degrees[0] && point.j <= degrees[1];
    case Domain::Tetrahedron:
      return point.i + point.j + point.k <= degrees[0];
    case Domain::Wedge:
      return point.i + point.j <= degrees[0];
  }
  unknownDomain();
}

std::vector<LatticePoint> latticePoints(Domain domain, const Degrees& degrees)
{
  std::vector<LatticePoint> points;
  points.reserve(coefficientCount(domain, degrees));
  visitLatticePoints(domain, degrees, [&](const LatticePoint& point) { points.push_back(point); });
  return points;
}

ReferencePoint latticePosition(const Degrees& degrees, const LatticePoint& point)
{
  return at(static_cast<double>(point.i) / degrees[0], static_cast<double>(point.j) / degrees[1],
    static_cast<double>(point.k) / degrees[2]);
}

LatticePoint cornerLatticePoint(Domain domain, const Degrees& degrees, int corner)
{
  const glm::dvec3& u = facts(domain).corners[corner].xyz;
  return { static_cast<int>(u.x) * degrees[0], static_cast<int>(u.y) * degrees[1],
    static_cast<int>(u.z) * degrees[2] };
}

ReferencePoint middleOf(const DomainFacts& domain)
{
  glm::dvec3 sum(0.0);
  for (const ReferencePoint& corner : domain.corners)
  {
    sum += corner.xyz;
  }
  return { sum / static_cast<double>(domain.corners.size()) };
}

ReferencePoint middleOf(const DomainFacts& domain, const Face& face)
{
  ReferencePoint middle;
  for (int c = 0; c < face.cornerCount; ++c)
  {
    middle.xyz += domain.corners[face.corners[c]].xyz / static_cast<double>(face.cornerCount);
  }
  return middle;
}

double insideMargin(Domain domain, const ReferencePoint& u)
{
  double margin = std::numeric_limits<double>::infinity();
  for (const Face& face : facts(domain).faces)
  {
    margin = std::min(margin, faceMargin(face, u));
  }
  return margin;
}

ReferencePoint broughtInside(Domain domain, ReferencePoint u)
{
  for (const Face& face : facts(domain).faces)
  {
    const glm::dvec3& inward = face.inward.xyz;
    u.xyz -= std::min(0.0, faceMargin(face, u)) / glm::dot(inward, inward) * inward;
  }
  return u;
}

} // namespace hop
