#pragma once

#include <cstdint>

namespace hop
{

/// How many particles this machine has memory for now.
std::int64_t particlesThatFit();

} // namespace hop
