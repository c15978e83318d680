#pragma once

#include "InputBlocks.h"

/// Sorts blocks into groups that can be contoured as one mesh each: blocks of one group have no cell
/// in common. A composite may hold several results on one grid, whose surfaces are not one.
std::vector<std::vector<InputBlock>> groupWithoutSharedCells(const std::vector<InputBlock>& blocks);
