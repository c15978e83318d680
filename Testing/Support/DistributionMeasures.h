#pragma once

#include "Particles.h"

namespace hop::testing
{

/// For every particle the distance to the nearest one on the same sheet (normals less than 90
/// degrees apart), divided by the spacing that it wants. Infinite where there is none.
std::vector<double> nearestSpacings(const std::vector<Particle>& particles);

/// Number of particles of hexagonal packing at spacing s on an area: area / (sqrt(3)/2 s^2).
double hexagonalCount(double area, double spacing);

} // namespace hop::testing
