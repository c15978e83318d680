#pragma once

#include "Particles.h"
#include "SurfaceProxy.h"

namespace hop
{

/// Gives particles that stand alone on a piece of the surface much smaller than their splat a smaller spacing,
/// so that what is drawn has about the area that the proxy knows. A particle stands alone if no other is nearer
/// than 1.8 of its spacing; all others keep theirs.
void fitSmallPieces(
  const SurfaceProxy& proxy, Buffer<Particle>& particles, const ParallelFor& parallelFor);

} // namespace hop
