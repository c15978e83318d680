#pragma once

#include "Surface/Particles.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace hop::testing
{

/// For every particle the distance to the nearest one on the same sheet (normals less than 90
/// degrees apart), divided by the spacing that it wants. Infinite where there is none.
std::vector<double> nearestSpacings(const Buffer<Particle>& particles);

/// Number of particles of hexagonal packing at spacing s on an area: area / (sqrt(3)/2 s^2).
double hexagonalCount(double area, double spacing);

/// The Delaunay triangles around a particle, among its neighbours on the same sheet: they are laid
/// into its tangent plane at their true distances, and the edges of the particle's Voronoi cell there
/// name those it shares a triangle with.
struct Star
{
  /// Number of these neighbours.
  int valence = 0;
  /// Whether they surround the particle. They do not on the boundary curve of a surface, nor beside a hole more
  /// than OpenRadius spacings away.
  bool closed = false;
  /// Of the triangles, in space: the largest circumradius over the particle's spacing (1/sqrt(3) in
  /// hexagonal packing), and the mean and smallest of their smallest angles, degrees. Zero if open.
  double circumradius = 0.0;
  double meanMinAngle = 0.0;
  double worstMinAngle = 0.0;

  static constexpr double OpenRadius = 1.25;
};

std::vector<Star> delaunayStars(const Buffer<Particle>& particles);

/// How even particles stand. In parentheses: hexagonal packing.
struct Evenness
{
  /// Over all particles that count: least distance to the nearest (nearestSpacings, 1), and the standard
  /// deviation of that distance over its mean (0); those that have none within two spacings left out.
  double minSpacing = 0.0;
  double variation = 0.0;
  /// Over the closed stars: share of those with six neighbours (1), largest circumradius (0.577), mean
  /// and least of the triangles' smallest angles, degrees (60).
  double sixValentShare = 0.0;
  double circumradius = 0.0;
  double meanMinAngle = 0.0;
  double worstMinAngle = 0.0;
  /// Number of stars that are not closed: none on a closed surface without holes.
  std::size_t openStars = 0;
};

/// All zero for fewer than two particles.
/// \param counts which of them do; the others are neighbours only. Leave it out for all.
Evenness measureEvenness(
  const Buffer<Particle>& particles,
  const std::function<bool(const Particle&)>& counts = [](const Particle&) { return true; });

/// Largest distance from a probe on the surface to a particle, whichever way that one is turned, in units of
/// the particle's spacing: of that to which it is least (1/sqrt(3) in hexagonal packing). Infinite without
/// particles, 0 without probes.
double coverageRadius(const Buffer<Particle>& particles, const std::vector<glm::dvec3>& probes);

} // namespace hop::testing
