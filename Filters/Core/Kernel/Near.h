#pragma once

#include "Kernel/Kernels.h"
#include "Kernel/Simd.h"

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// See NearFunction.
/// \tparam Count candidates looked at together; MaximumLanes is a multiple of it
template <int Count>
std::int32_t* findNear(const Candidates& candidates, const double (&position)[3],
  double inverseSpacing, double limit, std::int32_t* near)
{
  static_assert(MaximumLanes % Count == 0);
  using Doubles = Vector<double, Count>;
  for (std::ptrdiff_t n = 0; n < candidates.count; n += Count)
  {
    const Doubles dx = load<Doubles>(candidates.x + n) - position[0];
    const Doubles dy = load<Doubles>(candidates.y + n) - position[1];
    const Doubles dz = load<Doubles>(candidates.z + n) - position[2];
    const Doubles sum = load<Doubles>(candidates.inverseSpacing + n) + inverseSpacing;
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
      store(isNear, hits);
      // Without a branch, which would often be mispredicted: nearly half of the candidates are near.
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
