#include "Edges/FacePlanes.h"

#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

/// See offerPlane().
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

/// Whether a crease runs between a particle and a boundary curve, along it.
bool isBefore(const ClipPlane& crease, const ClipPlane& boundary, double spacing)
{
  // Distance of two edges, in units of the spacing. With a smaller one a boundary curve along a jump that fades would be
  // a crease as well; a larger one overlooks strips, over whose creases splats of both sides are mixed.
  constexpr double apart = 0.1;
  return boundary.isBoundary() && !crease.isBoundary() &&
    crease.distance < boundary.distance - apart * spacing;
}

/// A function of world space to second order, around a place that is the origin.
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
  constexpr int steps =
    4; // of Newton's method; within reach of a splat more change nothing that is seen
  glm::dvec3 x(0.0);
  for (int step = 0; step < steps; ++step)
  {
    // The place on both linear functions that touch a and b here which is nearest to the origin.
    const glm::dvec3 p = a.slopeAt(x).gradient.xyz;
    const glm::dvec3 q = b.slopeAt(x).gradient.xyz;
    const glm::dvec2 wanted(glm::dot(p, x) - a.valueAt(x), glm::dot(q, x) - b.valueAt(x));
    const glm::dmat2 products(glm::dot(p, p), glm::dot(p, q), glm::dot(p, q), glm::dot(q, q));
    const glm::dvec2 shares = glm::inverse(products) * wanted;
    x = shares.x * p + shares.y * q;
  }
  return x;
}

/// The plane that touches a face where the surface leaves the element nearest to a particle in it. (Planes across the
/// surface would not be the same from both sides.)
/// \param field, margin around the particle: F - c, and faceMargin() of the face
/// \return no plane if that place is not within reach
ClipPlane edgeSeenFrom(const Particle& particle, const Quadratic& field, const Quadratic& margin)
{
  const glm::dvec3 nearest = nearestOnCrossing(field, margin);
  if (!(glm::length(nearest) <= ClipReach * particle.spacing))
  {
    return {};
  }
  const LevelSet marginThere = margin.slopeAt(nearest);
  const WorldVector outward{ -glm::normalize(marginThere.gradient.xyz) };
  const WorldVector bend = curvatureOfCrossing(field.slopeAt(nearest), marginThere);
  return { outward, std::max(0.0, glm::dot(nearest, outward.xyz)), dot(bend, outward) };
}

/// The plane of a face, to first order at the particle.
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
  insertEdge(
    particle.clips, plane,
    [&](const ClipPlane& a, const ClipPlane& b) { return comesBefore(a, b, particle.spacing); },
    [&](const ClipPlane& a, const ClipPlane& b)
    { return dot(a.normal, b.normal) > SameEdge && !isBefore(b, a, particle.spacing); });
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
      const Quadratic margin{ faceMargin(faces[f], particle.location.u),
        faceLevels(jet, point.map, faces[f]) };
      plane = edgeSeenFrom(particle, field, margin);
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
