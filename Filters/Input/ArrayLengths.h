#pragma once

#include "Input/InputBlocks.h"

namespace hop
{

/// Names and lengths of a block's scalars if they do not reach its last point; else empty.
std::string describeShortScalars(const InputBlock& block);

/// Takes all arrays out of a block that do not reach its last point or cell: its grid becomes a copy
/// without them.
/// \return their names and lengths
std::vector<std::string> dropShortArrays(InputBlock& block);

} // namespace hop
