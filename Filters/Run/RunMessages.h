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

// Advice depends on the filter's NumberOfParticles: where it is positive, Spacing is ignored.

/// A run that ended in an exception.
UserMessage describeFailure(const std::exception& failure, std::int64_t numberOfParticles);

/// Which arrays are not passed on.
UserMessages reviewArrays(const std::vector<InputBlock>& blocks);

/// Which cells are not as they should be.
/// \param census one a block
UserMessages reviewCells(const InputBlocks& blocks, const std::vector<CellCensus>& census);

/// What a distribution could not do.
UserMessages reviewDistribution(const InputBlocks& blocks, const Distribution& distribution,
  double isovalue, std::int64_t numberOfParticles);

} // namespace hop
