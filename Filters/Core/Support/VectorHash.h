#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>

namespace hop
{

/// Spreads three numbers over the bits of one; equal ones, -0 and 0 too, the same way.
inline std::uint64_t hashOf(const glm::dvec3& numbers)
{
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    hash = (hash ^ std::hash<double>()(numbers[axis])) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

} // namespace hop
