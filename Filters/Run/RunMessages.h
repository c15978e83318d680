#pragma once

#include "Conversion/CellCensus.h"
#include "Input/InputBlocks.h"
#include "Input/UserMessage.h"
#include "Surface/Particles.h"

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

namespace hop
{

// `numberOfParticles` is the filter's NumberOfParticles. The advice depends on it: where it is positive, Spacing is
// ignored.

/// Tells of a run that ended in an exception.
UserMessage describeFailure(const std::exception& failure, std::int64_t numberOfParticles);

/// Tells which arrays are not passed on.
UserMessages reviewArrays(const std::vector<InputBlock>& blocks);

/// Tells which cells are not as they should be.
/// \param census one census a block
UserMessages reviewCells(const InputBlocks& blocks, const std::vector<CellCensus>& census);

/// Tells what a distribution could not do.
/// \param unit of lengths in the distribution, world units
UserMessages reviewDistribution(const InputBlocks& blocks, const Distribution& distribution,
  double isovalue, std::int64_t numberOfParticles, double unit);

} // namespace hop
