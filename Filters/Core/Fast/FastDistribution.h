#pragma once

#include "Common/Monitor.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"

namespace hop
{

/// Spreads particles more evenly than the paper's scheme, at a small part of its evaluations:
///  - boxes that hold all of the surface (SurfaceBoxes.h) give a rough picture of it, from which the
///    number of particles follows and first places are drawn, everywhere as dense as wanted
///    (SurfaceProxy.h);
///  - one Newton step takes these near the surface, one more evaluation gives each a quadratic patch;
///  - in each round particles are relaxed on their patches without any evaluation
///    (PatchRelaxation.h), and then taken there by one;
///  - Newton's method takes them to the tolerance.
/// Boxes whose piece of surface no particle stands on get one of their own, so that no component is
/// lost, however small: a particle stands on it if it is within its spacing, not turned away, and its
/// patch runs through it.
Distribution distributeFast(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor);

/// How many particles each element of a mesh wants on the surface at that sizing function, as Fast counts them; those on
/// boundary curves stand for half as much area as others and count half.
/// \throw Interrupted if the monitor asks for an early end
std::vector<double> wantedParticles(const Isosurface& surface, const SizingFunction& sizing,
  const Monitor& monitor, const ParallelFor& parallelFor);

} // namespace hop
