#pragma once

#include "Common/Monitor.h"
#include "Input/InputBlocks.h"

#include <set>
#include <utility>
#include <vector>

namespace hop
{

/// Pairs of blocks, by InputBlock::number; the lower number comes first.
using BlockPairs = std::set<std::pair<int, int>>;

/// Blocks that have a cell in common. A composite may hold several results on one grid; their isosurfaces have nothing
/// to do with each other.
BlockPairs blocksThatShareCells(const InputBlocks& blocks, const ParallelFor& parallelFor);

/// Sorts the blocks of all ranks into groups that can be contoured as one mesh each: blocks of one group have no cell
/// in common.
/// \param numbers of the blocks
/// \return the groups' numbers of blocks
std::vector<std::set<int>> groupsWithoutSharedCells(
  const std::set<int>& numbers, const BlockPairs& sharing);

/// The blocks of a group that this rank has.
InputBlocks blocksOfGroup(const InputBlocks& blocks, const std::set<int>& group);

} // namespace hop
