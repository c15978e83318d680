#pragma once

#include "Common/Monitor.h"
#include "Surface/DistributionParameters.h"
#include "Surface/Particles.h"

namespace hop
{

/// Spreads particles more evenly than the paper's scheme, with a small part of its evaluations:
///  - boxes that hold all of the surface (SurfaceBoxes.h) give a rough proxy of it, from which the number of particles
///    follows, and seeds as dense as the sizing function asks for (SurfaceProxy.h);
///  - one Newton step takes the seeds near the surface; one more evaluation gives each a quadratic patch;
///  - in each round particles are relaxed on their patches without any evaluation (PatchRelaxation.h), and one
///    evaluation then puts them back on the surface;
///  - Newton's method takes them to the tolerance.
/// A box whose piece of surface no particle stands on gets one of its own, so that no component is lost, however
/// small. A particle stands on that piece if it is within its spacing of the box's sample, is not turned away, and its
/// patch runs through the sample.
/// Derivation: Documentation/algorithm.md, section Fast distribution.
Distribution distributeFast(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor);

/// Number of particles that the surface takes in each element of the mesh at a sizing function, as Fast counts them.
/// A particle on a boundary curve counts half, as half of the area around it lies beyond the surface's end.
/// \throw Interrupted if the monitor asks for an early end
std::vector<double> particlesPerElement(const Isosurface& surface, const SizingFunction& sizing,
  const Monitor& monitor, const ParallelFor& parallelFor);

} // namespace hop
