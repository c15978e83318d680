#include "Surface/ActiveFaces.h"

#include <cmath>

namespace hop
{
namespace
{

/// Directions in reference space along all active faces.
/// \return number of directions: two along one face, one along two
int freeDirections(Domain domain, const ActiveFaces& active, glm::dvec3 (&directions)[2])
{
  const auto& faces = facts(domain).faces;
  const glm::dvec3 a = faces[active.face[0]].inward.xyz;
  if (active.count == 2)
  {
    directions[0] = glm::cross(a, faces[active.face[1]].inward.xyz);
    return 1;
  }
  // An axis that is not parallel to a.
  const glm::dvec3 other =
    std::abs(a.x) < 0.5 * glm::length(a) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  directions[0] = glm::cross(a, other);
  directions[1] = glm::cross(a, directions[0]);
  return 2;
}

} // namespace

ReferenceVector pullAlong(
  Domain domain, const ActiveFaces& active, const LocalMap& map, const WorldVector& v)
{
  if (active.count == 0)
  {
    return map.pull(v);
  }
  glm::dvec3 e[2]{};
  const int count = freeDirections(domain, active, e);
  const glm::dvec3 a = map.jacobian * e[0];
  if (count == 1)
  {
    return { e[0] * (glm::dot(a, v.xyz) / glm::dot(a, a)) };
  }
  const glm::dvec3 b = map.jacobian * e[1];
  const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
  const double av = glm::dot(a, v.xyz), bv = glm::dot(b, v.xyz);
  const double determinant = aa * bb - ab * ab;
  return { e[0] * ((bb * av - ab * bv) / determinant) +
    e[1] * ((aa * bv - ab * av) / determinant) };
}

Exit findExit(
  Domain domain, const ReferencePoint& u, const ReferenceVector& du, const ActiveFaces& active)
{
  const auto& faces = facts(domain).faces;
  Exit exit;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    const double rate = glm::dot(faces[f].inward.xyz, du.xyz);
    const double distance = faceMargin(faces[f], u);
    const double inside = distance < OnFace ? 0.0 : distance;
    if (rate < 0.0 && inside < -rate * exit.fraction && !active.holds(f))
    {
      exit = { inside / -rate, f };
    }
  }
  return exit;
}

} // namespace hop
