#pragma once

#include "DistributionParameters.h"
#include "MovingParticles.h"

namespace hop
{

/// Makes particles as many as the parameters ask for, if there is room; those that stand badly are exchanged
/// for others.
/// \param rims particles on rims, which stay
void settleNumber(const DistributionParameters& parameters, const Buffer<Patch>& rims,
  MovingParticles& moving, const ParallelFor& parallelFor);

} // namespace hop
