#pragma once

#include "Fast/MovingParticles.h"
#include "Surface/DistributionParameters.h"

namespace hop
{

/// Makes particles as many as the parameters ask for, if there is room for them. Particles that stand too near to
/// others are exchanged for particles in gaps.
/// \param boundaryPatches particles on boundary curves, which stay
void matchGivenNumber(const DistributionParameters& parameters,
  const Buffer<Patch>& boundaryPatches, MovingParticles& moving, const ParallelFor& parallelFor);

} // namespace hop
