#pragma once

#include "Support/SpacedPoints.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>

namespace hop
{

/// Two unit vectors that span the plane normal to a unit vector, right-handed with it.
inline std::array<glm::vec3, 2> tangentsOf(const glm::vec3& normal)
{
  // Across the normal and an axis that is not near it, written out.
  const glm::vec3 across = std::abs(normal.x) < 0.6f ? glm::vec3(0.0f, normal.z, -normal.y)
                                                     : glm::vec3(-normal.z, 0.0f, normal.x);
  const glm::vec3 first = glm::normalize(across);
  return { first, glm::cross(normal, first) };
}

/// The surface around a particle, to second order: x(t) = position + t - (t.S t / 2) normal for t in
/// the tangent plane, in the basis of tangentsOf(normal).
struct Patch
{
  glm::dvec3 position{ 0.0 };
  /// Unit length.
  glm::vec3 normal{ 0.0f };
  /// xx, xy, yy of S = -P F_xx P / |F_x|: positive where the surface bends away from the normal -grad F.
  std::array<float, 3> shape{};
  /// h, > 0.
  float spacing = 1.0f;
  /// Stays where it is, but is seen by others.
  bool fixed = false;

  /// The paper's D = sqrt(k1^2 + k2^2).
  float curvatureMagnitude() const;

  /// S t: the surface's normal at t is along normal + S t.
  /// \param t glm::vec2 or glm::dvec2
  template <class Plane>
  Plane slope(const Plane& t) const
  {
    const auto& [xx, xy, yy] = this->shape;
    return { xx * t.x + xy * t.y, xy * t.x + yy * t.y };
  }

  /// How far the surface has fallen below the tangent plane at t: t.S t / 2.
  template <class Plane>
  auto sink(const Plane& t) const
  {
    using Number = typename Plane::value_type;
    return Number(0.5) * glm::dot(t, this->slope(t));
  }

  /// From the particle to the surface at t, in the world.
  glm::dvec3 step(const glm::vec2& t) const;

  /// Where in the tangent plane a place of the world is.
  glm::dvec2 inPlane(const glm::dvec3& place) const;

  /// How far above the surface, along the particle's normal, a place of the world is.
  double heightOf(const glm::dvec3& place) const;
};

/// Where patches are and how far apart they are to stand.
SpacedPoints spacedPoints(const Buffer<Patch>& patches, const ParallelFor& parallelFor);

} // namespace hop
