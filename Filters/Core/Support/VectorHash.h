#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>

namespace hop
{

/// Spreads three numbers over the bits of one. Equal numbers have equal hashes; so have -0 and 0.
inline std::uint64_t hashOf(const glm::dvec3& numbers)
{
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    // 2^64 over the golden ratio (Fibonacci hashing, Knuth, vol. 3, 6.4). The upper bits of a product depend on all
    // bits of its factors, and are folded into the lower ones, which callers take.
    hash = (hash ^ std::hash<double>()(numbers[axis])) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

} // namespace hop
