#include "Edges/FacePlanes.h"

#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

bool comesBefore(const ClipPlane& a, const ClipPlane& b, double spacing)
{
  const auto rank = [spacing](const ClipPlane& plane)
  {
    return plane.isBoundary() && plane.distance < spacing ? 0
      : plane.dihedralAngle > CreaseAngle                 ? 1
                                                          : 2;
  };
  return rank(a) != rank(b) ? rank(a) < rank(b) : a.distance < b.distance;
}

/// A function of world space near a place, to second order.
struct Quadratic
{
  double value = 0.0;
  LevelSet slope;

  double valueAt(const glm::dvec3& x) const
  {
    return this->value + glm::dot(this->slope.gradient.xyz + 0.5 * this->slope.hessian * x, x);
  }
  LevelSet slopeAt(const glm::dvec3& x) const
  {
    return { this->slope.gradient + WorldVector{ this->slope.hessian * x }, this->slope.hessian };
  }
};

/// The place on the curve {a = b = 0} that is nearest to the origin; not finite where there is none.
glm::dvec3 nearestOnCrossing(const Quadratic& a, const Quadratic& b)
{
  constexpr int steps = 4;
  glm::dvec3 x(0.0);
  for (int step = 0; step < steps; ++step)
  {
    // Of the places on both planes that touch the functions here, the nearest.
    const glm::dvec3 p = a.slopeAt(x).gradient.xyz;
    const glm::dvec3 q = b.slopeAt(x).gradient.xyz;
    const glm::dvec2 wanted(glm::dot(p, x) - a.valueAt(x), glm::dot(q, x) - b.valueAt(x));
    const glm::dmat2 products(glm::dot(p, p), glm::dot(p, q), glm::dot(p, q), glm::dot(q, q));
    const glm::dvec2 shares = glm::inverse(products) * wanted;
    x = shares.x * p + shares.y * q;
  }
  return x;
}

/// The face by which the surface leaves an element, touched where the surface is nearest to leaving, as a particle
/// in the element sees that to second order. (Planes across the surface would not be the same from both sides.)
/// \param field, wall around the particle: F - c, and faceMargin() of the face
/// \return the plane exists only if that place is within reach
ClipPlane edgeSeenFrom(const Particle& particle, const Quadratic& field, const Quadratic& wall)
{
  const glm::dvec3 nearest = nearestOnCrossing(field, wall);
  if (!(glm::length(nearest) <= ClipReach * particle.spacing))
  {
    return {};
  }
  const LevelSet wallThere = wall.slopeAt(nearest);
  const WorldVector outward{ -glm::normalize(wallThere.gradient.xyz) };
  const WorldVector bend = bendOfCrossing(field.slopeAt(nearest), wallThere);
  return { outward, std::max(0.0, glm::dot(nearest, outward.xyz)), dot(bend, outward) };
}

/// The face itself, to first order.
ClipPlane planeOf(const Face& face, const Particle& particle, const LocalMap& map)
{
  const glm::dvec3 inward = glm::transpose(map.inverse) * face.inward.xyz;
  const double slope = glm::length(inward);
  const double margin = std::max(0.0, faceMargin(face, particle.location.u));
  return { { inward / -slope }, margin / slope };
}

} // namespace

void offerPlane(Particle& particle, const ClipPlane& plane)
{
  if (plane.distance > ClipReach * particle.spacing)
  {
    return;
  }
  auto& [first, second] = particle.clips;
  const auto isBefore = [&](const ClipPlane& other)
  { return !other.exists() || comesBefore(plane, other, particle.spacing); };
  const bool isFirstEdge = first.exists() && dot(first.normal, plane.normal) > SameEdge;
  if (isBefore(first))
  {
    second = isFirstEdge ? second : first;
    first = plane;
  }
  else if (!isFirstEdge && isBefore(second))
  {
    second = plane;
  }
}

void offerFaces(const Isosurface& surface, const FaceJumps& jumps, const Jet& jet,
  const FieldPoint& point, Particle& particle)
{
  const int element = particle.location.element;
  const auto& faces = facts(surface.mesh->elements[element].domain).faces;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    const float angle = jumps.dihedralAngles[faceSlot(element, f)];
    if (angle == 0.0f)
    {
      continue;
    }
    ClipPlane plane = planeOf(faces[f], particle, point.map);
    if (plane.distance <= ClipReach * particle.spacing && angle > CreaseAngle)
    {
      const Quadratic field{ point.value, { point.gradient, worldHessian(jet, point) } };
      const Quadratic wall{ faceMargin(faces[f], particle.location.u),
        faceLevels(jet, point.map, faces[f]) };
      plane = edgeSeenFrom(particle, field, wall);
    }
    plane.dihedralAngle = angle;
    plane.face = f;
    if (plane.exists())
    {
      offerPlane(particle, plane);
    }
  }
}

} // namespace hop
