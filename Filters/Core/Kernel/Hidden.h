#pragma once

#include "Kernel/Kernels.h"
#include "Kernel/Simd.h"

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// See HiddenFunction: three cross products are positive, so their least is. They are taken of differences that are zero
/// at the ends of segments, which hide nothing there, however products are rounded.
/// \tparam Count points looked at together; MaximumLanes is a multiple of it
template <int Count>
void findHidden(const FlatPoints& points, const FlatSegment* segments, std::ptrdiff_t segmentCount,
  double* hidden)
{
  static_assert(MaximumLanes % Count == 0);
  using Doubles = Vector<double, Count>;
  for (std::ptrdiff_t n = 0; n < points.count; n += Count)
  {
    const auto x = load<Doubles>(points.x + n);
    const auto y = load<Doubles>(points.y + n);
    Doubles most{};
    for (std::ptrdiff_t s = 0; s < segmentCount; ++s)
    {
      const auto [ax, ay, bx, by] = segments[s];
      const Doubles dx = x - ax;
      const Doubles dy = y - ay;
      const Doubles afterFirst = ax * dy - ay * dx;
      const Doubles beforeLast = by * (x - bx) - bx * (y - by);
      const Doubles behind = (by - ay) * dx - (bx - ax) * dy;
      most = greatest(most, least(least(afterFirst, beforeLast), behind));
    }
    store(most, hidden + n);
  }
}

} // namespace
} // namespace hop::kernel
