#pragma once

#include "Kernel/Kernels.h"
#include "Kernel/Simd.h"

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// What a cell of the Voronoi diagram bends, at places t = (x, y): see PlaneCellFunction. Four times too much, for the sum
/// of two corners instead of their middle.
template <class Doubles>
inline Doubles stretchAt(const CellBend& bend, Doubles x, Doubles y)
{
  // Keeps the quotient finite at the origin, where no corner is.
  constexpr double tiny = 1e-200;
  const Doubles squared = x * x + y * y;
  const Doubles form = bend.xx * x * x + 2.0 * bend.xy * x * y + bend.yy * y * y;
  return form * form / (squared + tiny) - bend.gauss * squared;
}

/// See PlaneCellFunction. The side that the cell has in common with neighbour p lies on the line p/2 + s p', p' = p
/// turned by a quarter. Neighbour q allows those s for which 2 s (p x q) <= q . (q - p), so that each side is found
/// without the others: eight at a time, in whatever order.
/// \tparam Count neighbours looked at together; MaximumLanes is a multiple of it
template <int Count>
PlaneCell measurePlaneCell(const FlatPoints& near, const CellBend& bend)
{
  static_assert(MaximumLanes % Count == 0);
  using Doubles = Vector<double, Count>;
  // For p = q both sides of the condition are exactly zero, as they are computed from p - q: it then holds for all s.
  // Far less than any difference between neighbours, yet quotients are finite or have the right sign.
  constexpr double tinyProduct = 1e-250;
  constexpr double tinyRest = 1e-150;
  constexpr double far = 1e3;
  const Doubles zero{};
  PlaneCell cell;
  for (std::ptrdiff_t n = 0; n < near.count; n += Count)
  {
    const auto px = load<Doubles>(near.x + n);
    const auto py = load<Doubles>(near.y + n);
    Doubles first = zero - far;
    Doubles last = zero + far;
    for (std::ptrdiff_t k = 0; k < near.used; ++k)
    {
      const double qx = near.x[k];
      const double qy = near.y[k];
      const Doubles dx = qx - px;
      const Doubles dy = qy - py;
      const Doubles product = dy * qx - dx * qy + tinyProduct;
      const Doubles bound = (dx * qx + dy * qy + tinyRest) / product;
      const auto isFirst = product <= zero;
      first = select(isFirst, greatest(first, bound), first);
      last = select(isFirst, last, least(last, bound));
    }
    const Doubles length = greatest(last - first, zero); // in halves of |p|
    const Doubles ax = 0.5 * (px - first * py);
    const Doubles ay = 0.5 * (py + first * px);
    const Doubles bx = 0.5 * (px - last * py);
    const Doubles by = 0.5 * (py + last * px);
    const Doubles lowest = zero - 1.0;
    const Doubles stretch = (greatest(0.25 * stretchAt(bend, ax, ay), lowest) +
                              greatest(0.25 * stretchAt(bend, bx, by), lowest) +
                              greatest(0.25 * stretchAt(bend, ax + bx, ay + by), lowest)) *
      (1.0 / 3.0);
    const Doubles area = 0.125 * (px * px + py * py) * length * (1.0 + stretch);
    const Doubles reach = greatest(ax * ax + ay * ay, bx * bx + by * by);
    double areas[Count], lengths[Count], reaches[Count];
    store(area, areas);
    store(length, lengths);
    store(reach, reaches);
    for (int lane = 0; lane < Count; ++lane)
    {
      if (lengths[lane] > 0.0)
      {
        cell.area += areas[lane];
        cell.reachSquared = reaches[lane] > cell.reachSquared ? reaches[lane] : cell.reachSquared;
      }
    }
  }
  return cell;
}

} // namespace
} // namespace hop::kernel
