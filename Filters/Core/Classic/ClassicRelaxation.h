#pragma once

#include "Classic/ClassicParticles.h"

namespace hop
{

/// Moves one particle after the other against the gradient of its energy (eq. 3), no farther than h. Each has a step
/// length of its own, which grows where the first try lowers the energy and shrinks with each try that does not.
/// \return the sum of the energies that particles have before or, if they move, after their step
double sweepOnce(ClassicParticles& particles, const ParallelFor& parallelFor);

} // namespace hop
