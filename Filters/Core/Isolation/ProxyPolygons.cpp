#include "Isolation/ProxyPolygons.h"

namespace hop
{
namespace
{

using Tetrahedron = std::array<int, 4>;

/// Tetrahedra that fill a domain, by their corners in the order of facts(domain).corners. All tetrahedra of the
/// hexahedron share the diagonal from corner 0 to corner 6.
const std::vector<Tetrahedron>& fillingTetrahedra(Domain domain)
{
  static const std::vector<Tetrahedron> hexahedron{ { 0, 1, 2, 6 }, { 0, 2, 3, 6 }, { 0, 3, 7, 6 },
    { 0, 7, 4, 6 }, { 0, 4, 5, 6 }, { 0, 5, 1, 6 } };
  static const std::vector<Tetrahedron> tetrahedron{ { 0, 1, 2, 3 } };
  static const std::vector<Tetrahedron> wedge{ { 0, 1, 2, 5 }, { 0, 1, 5, 4 }, { 0, 4, 5, 3 } };
  switch (domain)
  {
    case Domain::Hexahedron:
      return hexahedron;
    case Domain::Tetrahedron:
      return tetrahedron;
    case Domain::Wedge:
      return wedge;
  }
  unknownDomain();
}

/// Appends the triangle, or the two triangles of the quadrilateral, between corners above and below zero.
void marchTetrahedron(
  const SurfaceBox& box, const Tetrahedron& corners, std::vector<ReferenceTriangle>& triangles)
{
  std::array<int, 4> above{};
  std::array<int, 4> below{};
  int aboveCount = 0;
  int belowCount = 0;
  for (const int corner : corners)
  {
    (box.values[corner] > 0.0f ? above[aboveCount++] : below[belowCount++]) = corner;
  }
  const auto crossing = [&](int a, int b)
  {
    const float t = box.values[a] / (box.values[a] - box.values[b]);
    return box.corners[a] + t * (box.corners[b] - box.corners[a]);
  };
  if (aboveCount == 2)
  {
    const glm::vec3 first = crossing(above[0], below[0]);
    const glm::vec3 last = crossing(above[1], below[1]);
    triangles.push_back({ first, crossing(above[0], below[1]), last });
    triangles.push_back({ first, last, crossing(above[1], below[0]) });
  }
  else if (aboveCount == 1 || belowCount == 1)
  {
    const auto& [alone, others] =
      aboveCount == 1 ? std::pair(above[0], below) : std::pair(below[0], above);
    triangles.push_back(
      { crossing(alone, others[0]), crossing(alone, others[1]), crossing(alone, others[2]) });
  }
}

} // namespace

void appendProxyTriangles(
  Domain domain, const SurfaceBox& box, std::vector<ReferenceTriangle>& triangles)
{
  for (const Tetrahedron& corners : fillingTetrahedra(domain))
  {
    marchTetrahedron(box, corners, triangles);
  }
}

ReferencePoint proxyMiddle(Domain domain, const SurfaceBox& box)
{
  std::vector<ReferenceTriangle> triangles;
  appendProxyTriangles(domain, box, triangles);
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (const ReferenceTriangle& t : triangles)
  {
    const double weight = glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    sum += weight / 3.0 * glm::dvec3(t[0] + t[1] + t[2]);
    weights += weight;
  }
  return weights > 0.0 ? ReferencePoint{ sum / weights } : box.middle.u;
}

} // namespace hop
