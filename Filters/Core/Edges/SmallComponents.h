#pragma once

#include "Edges/ParticleGrid.h"
#include "Isolation/SurfaceProxy.h"

namespace hop
{

/// Shrinks the splats of particles that stand alone on a piece of the surface much smaller than them, so that
/// what is drawn has about the area that the proxy knows. A particle stands alone if no other is nearer than 1.8
/// of its spacing.
/// \param all of these particles, those on boundary curves last
void fitSmallComponents(const SurfaceProxy& proxy, const ParticleGrid& all,
  Buffer<Particle>& particles, const ParallelFor& parallelFor);

} // namespace hop
