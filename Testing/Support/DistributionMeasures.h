#pragma once

#include "Surface/Particles.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace hop::testing
{

/// For every particle the distance to the nearest particle on the same sheet (normals less than 90
/// degrees apart), divided by its wanted spacing. Infinite where there is none.
std::vector<double> nearestSpacings(const Buffer<Particle>& particles);

/// Number of particles of hexagonal packing at spacing s on an area: area / (sqrt(3)/2 s^2).
double hexagonalCount(double area, double spacing);

/// The Delaunay triangles around a particle, among its neighbours on the same sheet. The neighbours are laid
/// into the particle's tangent plane at their true distances; each edge of the particle's Voronoi cell there
/// belongs to a neighbour with which it shares triangles.
struct Star
{
  /// Number of neighbours that share triangles with the particle.
  int valence = 0;
  /// Whether these neighbours surround the particle. They do not on a boundary curve of the surface, nor at a hole
  /// whose circumcentres are more than OpenRadius spacings away.
  bool closed = false;
  /// Of the triangles, in space: the largest circumradius over the particle's spacing (1/sqrt(3) in
  /// hexagonal packing), and the mean and smallest of their smallest angles, degrees. Zero if open.
  double circumradius = 0.0;
  double meanMinAngle = 0.0;
  double worstMinAngle = 0.0;

  /// Half the side of the square with which a Voronoi cell begins, in spacings; hexagonal packing needs 1/sqrt(3), and
  /// one missing particle opens at 1. Larger: holes count as large triangles; smaller: loose stars count as open.
  static constexpr double OpenRadius = 1.25;
};

std::vector<Star> delaunayStars(const Buffer<Particle>& particles);

/// How even particles stand. In parentheses: hexagonal packing.
struct Evenness
{
  /// Over all particles that count: least distance to the nearest particle (nearestSpacings, 1), and the standard
  /// deviation of this distance over its mean (0), without particles that have no other within two spacings.
  double minSpacing = 0.0;
  double variation = 0.0;
  /// Over the closed stars: share of stars with six neighbours (1), largest circumradius (0.577), mean
  /// and least of the triangles' smallest angles, degrees (60).
  double sixValentShare = 0.0;
  double circumradius = 0.0;
  double meanMinAngle = 0.0;
  double worstMinAngle = 0.0;
  /// Number of stars that are not closed: none on a closed surface without holes.
  std::size_t openStars = 0;
};

/// All zero for fewer than two particles.
/// \param counts which particles count; the others are neighbours only. By default all do.
Evenness measureEvenness(
  const Buffer<Particle>& particles,
  const std::function<bool(const Particle&)>& counts = [](const Particle&) { return true; });

/// Largest distance from a probe on the surface to its nearest particle, whatever the particle's normal, in units of
/// that particle's spacing (1/sqrt(3) in hexagonal packing). Nearest is the particle with the least distance in its own
/// units. Infinite without particles, 0 without probes.
double coverageRadius(const Buffer<Particle>& particles, const std::vector<glm::dvec3>& probes);

} // namespace hop::testing
