#pragma once

#include "Input/InputBlocks.h"

namespace hop
{

/// Name and length of a block's scalars if they have fewer tuples than the block has points; else empty.
std::string describeShortScalars(const InputBlock& block);

/// Removes all arrays that have fewer tuples than the block has points or cells: the block's grid becomes a copy
/// without these arrays.
/// \return names and lengths of the removed arrays
std::vector<std::string> dropShortArrays(InputBlock& block);

} // namespace hop
