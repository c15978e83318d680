#pragma once

#include "Support/SpacedPoints.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>

namespace hop
{

/// Two unit vectors that span the plane normal to a unit vector. Both and the normal are right-handed.
inline std::array<glm::vec3, 2> tangentsOf(const glm::vec3& normal)
{
  // The cross product with an axis that is not nearly parallel, written out: below 0.6 < 1/sqrt(2) the x axis is at
  // least 53 degrees away, else y is, because normal.y is at most 0.8.
  constexpr float nearAxis = 0.6f;
  const glm::vec3 across = std::abs(normal.x) < nearAxis ? glm::vec3(0.0f, normal.z, -normal.y)
                                                         : glm::vec3(-normal.z, 0.0f, normal.x);
  const glm::vec3 first = glm::normalize(across);
  return { first, glm::cross(normal, first) };
}

/// The surface around a particle, to second order: x(t) = position + t - (t.S t / 2) normal for t in
/// the tangent plane, in the basis of tangentsOf(normal). S is the shape operator; see Documentation/algorithm.md,
/// section Geometry in world space.
struct Patch
{
  glm::dvec3 position{ 0.0 };
  /// Unit length.
  glm::vec3 normal{ 0.0f };
  /// xx, xy, yy of S = -P F_xx P / |F_x|: positive where the surface bends away from the normal -grad F.
  std::array<float, 3> shape{};
  /// h > 0, the spacing wanted, world units.
  float spacing = 1.0f;
  /// Whether relaxation leaves it where it is; other particles see it all the same.
  bool fixed = false;

  /// The paper's D = sqrt(k1^2 + k2^2), the Frobenius norm of S.
  float curvatureMagnitude() const;

  /// S t. The surface's normal at t is normal + S t, normalised, to first order.
  /// \param t glm::vec2 or glm::dvec2
  template <class Plane>
  Plane slope(const Plane& t) const
  {
    const auto& [xx, xy, yy] = this->shape;
    return { xx * t.x + xy * t.y, xy * t.x + yy * t.y };
  }

  /// t.S t / 2: how far the surface lies below the tangent plane at t.
  template <class Plane>
  auto sink(const Plane& t) const
  {
    using Number = typename Plane::value_type;
    return Number(0.5) * glm::dot(t, this->slope(t));
  }

  /// From the particle to the surface at t, in world space.
  glm::dvec3 step(const glm::vec2& t) const;

  /// The projection of a point in world space to the tangent plane.
  glm::dvec2 inPlane(const glm::dvec3& place) const;

  /// How far above the surface a point in world space lies, along the particle's normal.
  double heightOf(const glm::dvec3& place) const;
};

/// Positions and spacings of patches, for searches of neighbours.
SpacedPoints spacedPoints(const Buffer<Patch>& patches, const ParallelFor& parallelFor);

} // namespace hop
