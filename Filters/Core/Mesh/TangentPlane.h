#pragma once

#include "Surface/Patch.h"

#include <glm/glm.hpp>

#include <cmath>

namespace hop
{

/// Twice the area of the triangle between the origin and two places, positive if they are counterclockwise.
inline double crossOf(const glm::dvec2& a, const glm::dvec2& b)
{
  return a.x * b.y - a.y * b.x;
}

/// Counterclockwise angle from one direction to another, in [0, 2 pi).
inline double turnFrom(const glm::dvec2& from, const glm::dvec2& to)
{
  constexpr double fullTurn = 6.283185307179586;
  const double angle = std::atan2(crossOf(from, to), glm::dot(from, to));
  return angle < 0.0 ? angle + fullTurn : angle;
}

/// The same in (0, 2 pi]: all around from one place to the same one, as around a particle at which a crease fades, which
/// has the crease's two sides in the same place.
inline double turnAround(const glm::dvec2& from, const glm::dvec2& to)
{
  constexpr double fullTurn = 6.283185307179586;
  return from == to ? fullTurn : turnFrom(from, to);
}

/// Grows with turnFrom(), from 0 to FullRank, without its arc tangent: to compare turns by. Zero where a direction has no
/// length.
inline double turnRank(const glm::dvec2& from, const glm::dvec2& to)
{
  const double up = crossOf(from, to);
  const double ahead = glm::dot(from, to);
  const double sum = std::abs(up) + std::abs(ahead);
  const double share = sum > 0.0 ? ahead / sum : 1.0;
  return up < 0.0 ? 3.0 + share : 1.0 - share;
}

/// The rank of a full turn.
constexpr double FullRank = 4.0;

/// The tangent plane of a particle. Places around it are laid into the plane at their distance in space, and measured
/// in units of the particle's spacing.
struct TangentPlane
{
  TangentPlane() = default;
  TangentPlane(const glm::dvec3& middle, const glm::vec3& normal, double spacing)
    : origin(middle)
    , perSpacing(1.0 / spacing)
  {
    const auto [first, second] = tangentsOf(normal);
    this->across = first;
    this->along = second;
  }

  glm::dvec2 directionOf(const glm::dvec3& v) const
  {
    return { glm::dot(v, this->across), glm::dot(v, this->along) };
  }

  /// The origin for a place on the normal.
  glm::dvec2 flat(const glm::dvec3& place) const
  {
    const glm::dvec3 apart = (place - this->origin) * this->perSpacing;
    const glm::dvec2 shadow = this->directionOf(apart);
    const double squared = glm::dot(shadow, shadow);
    const double stretch = squared > 0.0 ? std::sqrt(glm::dot(apart, apart) / squared) : 0.0;
    return stretch * shadow;
  }

  glm::dvec3 origin{ 0.0 };
  glm::dvec3 across{ 0.0 }, along{ 0.0 };
  double perSpacing = 1.0;
};

} // namespace hop
