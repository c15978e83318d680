#pragma once

#include "Common/Monitor.h"
#include "Input/InputBlocks.h"

namespace hop
{

/// Sorts blocks into groups that can be contoured as one mesh each: blocks of one group have no cell in common. A
/// composite may hold several results on one grid; their isosurfaces have nothing to do with each other.
std::vector<InputBlocks> groupWithoutSharedCells(
  const InputBlocks& blocks, const ParallelFor& parallelFor);

} // namespace hop
