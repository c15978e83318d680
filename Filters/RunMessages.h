#pragma once

#include "CellCensus.h"
#include "InputBlocks.h"
#include "Particles.h"

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

/// What a user is to be told. The filter tells it: observers of errors and warnings listen there.
struct UserMessage
{
  enum Kind
  {
    Warning,
    Error
  };
  Kind kind = Warning;
  std::string text;
};

/// In the order in which they are to be told.
using UserMessages = std::vector<UserMessage>;

/// "a, b, c and 2 more", or "none".
std::string listOf(const std::vector<std::string>& names);

// Advice depends on the filter's NumberOfParticles: where it is positive, Spacing is ignored.

/// A run that ended in an exception.
UserMessage describeFailure(const std::exception& failure, std::int64_t numberOfParticles);

/// Which arrays are not passed on.
UserMessages reviewArrays(const std::vector<InputBlock>& blocks);

/// Which cells are not as they should be.
/// \param census one a block
UserMessages reviewCells(const InputBlocks& blocks, const std::vector<CellCensus>& census);

/// What a distribution could not do.
UserMessages reviewDistribution(const InputBlocks& blocks, const hop::Distribution& distribution,
  double isovalue, std::int64_t numberOfParticles);
