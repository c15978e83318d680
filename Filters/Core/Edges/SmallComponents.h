#pragma once

#include "Edges/ParticleGrid.h"
#include "Isolation/SurfaceProxy.h"

namespace hop
{

/// Shrinks the splats of particles that stand alone on a component of the surface much smaller than a splat, so that
/// what is drawn has about the area of the component, as the proxy knows it. A particle stands alone if no other one is
/// nearer than 1.8 of its spacing.
/// \param all places of the particles
/// \param particles all of them, those on boundary curves last
void fitSmallComponents(const SurfaceProxy& proxy, const ParticleGrid& all,
  Buffer<Particle>& particles, const ParallelFor& parallelFor);

} // namespace hop
