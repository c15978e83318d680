#pragma once

#include "Fast/MovingParticles.h"
#include "Surface/DistributionParameters.h"

namespace hop
{

/// Makes particles as many as the parameters ask for, if there is room; those that stand badly are exchanged
/// for others.
/// \param boundary curves particles on boundary curves, which stay
void settleNumber(const DistributionParameters& parameters, const Buffer<Patch>& boundaries,
  MovingParticles& moving, const ParallelFor& parallelFor);

} // namespace hop
