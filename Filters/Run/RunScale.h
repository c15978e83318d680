#pragma once

#include "Input/InputBlocks.h"

#include <vector>

namespace hop
{

/// Lengths that follow from the bounds of the whole input, over all blocks and ranks; in units of `unit`.
struct RunScale
{
  /// A power of two, world units; the longest side of the bounds is 0.5 to 1 of it.
  double unit = 1.0;
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
