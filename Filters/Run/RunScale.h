#pragma once

#include "Input/InputBlocks.h"

#include <vector>

namespace hop
{

/// Lengths that follow from the bounds of the whole input, over all blocks and ranks; world units.
struct RunScale
{
  double spacing = 0.0;
  double tolerance = 0.0;
  /// Diagonal of the bounds.
  double diagonal = 0.0;
};

/// Every rank has to call this: the bounds are those of all ranks.
/// \param spacing as asked for, world units; <= 0 for the automatic one
/// \param tolerance as asked for, a fraction of the diagonal
/// \return zeros where there is no point at all
RunScale findScale(const std::vector<InputBlock>& blocks, double spacing, double tolerance);

} // namespace hop
