#pragma once

#include "Classic/ClassicParticles.h"

namespace hop
{

/// Moves one particle after the other against the gradient of its energy (eq. 3), with a step length of its own
/// that grows and shrinks as its energy falls or does not, no farther than h.
/// \return the energy of all of them, before
double sweepOnce(ClassicParticles& particles, const ParallelFor& parallelFor);

} // namespace hop
