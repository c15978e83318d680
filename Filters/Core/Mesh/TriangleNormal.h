#pragma once

#include "Surface/Particles.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>

namespace hop
{

/// Of the flat triangle between three particles: its normal, as long as twice its area.
inline glm::dvec3 doubleAreaNormal(
  const Buffer<Particle>& particles, const std::array<int, 3>& corners)
{
  const glm::dvec3& from = particles[corners[0]].position.xyz;
  return glm::cross(
    particles[corners[1]].position.xyz - from, particles[corners[2]].position.xyz - from);
}

/// Whether it is turned away from the normal of a corner.
inline bool isTurned(const Buffer<Particle>& particles, const std::array<int, 3>& corners)
{
  const glm::dvec3 normal = doubleAreaNormal(particles, corners);
  return std::any_of(corners.begin(), corners.end(),
    [&](int corner) { return glm::dot(normal, particles[corner].normal.xyz) <= 0.0; });
}

} // namespace hop
