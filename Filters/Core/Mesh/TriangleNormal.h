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

/// The same of a triangle that has a height: others may be turned by rounding.
inline bool isTurnedOver(const Buffer<Particle>& particles, const std::array<int, 3>& corners)
{
  // Height over the longest edge below which there is none: half a degree.
  constexpr double none = 0.01;
  double longest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    longest = std::max(
      longest, length(particles[corners[i]].position - particles[corners[(i + 1) % 3]].position));
  }
  return glm::length(doubleAreaNormal(particles, corners)) > none * longest * longest &&
    isTurned(particles, corners);
}

/// Whether it is turned away from the mean of the normals of its corners: where the surface bends by more than a right
/// angle within a spacing, no triangle suits all of them.
inline bool isTurnedFromMean(const Buffer<Particle>& particles, const std::array<int, 3>& corners)
{
  const WorldVector normals =
    particles[corners[0]].normal + particles[corners[1]].normal + particles[corners[2]].normal;
  return glm::dot(doubleAreaNormal(particles, corners), normals.xyz) <= 0.0;
}

} // namespace hop
