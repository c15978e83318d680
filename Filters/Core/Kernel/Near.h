#pragma once

#include "Kernel/Lanes.h"

#include "Kernel/Kernels.h"

// Local to the file that includes it, like Lanes.h.
namespace hop::kernel
{
namespace
{

template <int Count>
inline typename Lanes<Count>::Type loadDoubles(const double* from)
{
  typename Lanes<Count>::Type result;
  std::memcpy(&result, from, sizeof(result));
  return result;
}

template <int Count>
std::int32_t* findNear(const Candidates& candidates, const double (&position)[3],
  double inverseSpacing, double limit, std::int32_t* near)
{
  for (std::ptrdiff_t n = 0; n < candidates.count; n += Count)
  {
    const auto dx = loadDoubles<Count>(candidates.x + n) - position[0];
    const auto dy = loadDoubles<Count>(candidates.y + n) - position[1];
    const auto dz = loadDoubles<Count>(candidates.z + n) - position[2];
    const auto sum = loadDoubles<Count>(candidates.inverseSpacing + n) + inverseSpacing;
    const auto isNear = (dx * dx + dy * dy + dz * dz) * (sum * sum) <= limit;
    if constexpr (Count == 1)
    {
      *near = candidates.index[n];
      near += isNear;
    }
    else
    {
      std::int64_t hits[Count];
      static_assert(sizeof(hits) == sizeof(isNear));
      std::memcpy(hits, &isNear, sizeof(hits));
      // Without a branch: nearly half of the candidates are near.
      for (int lane = 0; lane < Count; ++lane)
      {
        *near = candidates.index[n + lane];
        near -= hits[lane];
      }
    }
  }
  return near;
}

} // namespace
} // namespace hop::kernel
