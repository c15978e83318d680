#pragma once

#include "Surface/Energy.h"

#include <algorithm>

namespace hop
{

/// Spacing that particles want: s where the surface is flat, less where it bends.
struct SizingFunction
{
  /// s: distance of neighbours on a flat surface, world units, > 0.
  double spacing = 1.0;
  /// rho: how much denser particles stand where the surface bends; 0 = evenly everywhere.
  double angularDensity = 0.0;

  /// h = s / (1 + rho D s / 2 pi) for curvature magnitude D. The fraction D s / 2 pi of a full turn
  /// that one spacing covers is bounded by one, so that h >= s / (1 + rho) whatever the curvature.
  double at(double curvatureMagnitude) const
  {
    const double share = std::min(1.0, curvatureMagnitude * this->spacing / (2.0 * Pi));
    return this->spacing / (1.0 + this->angularDensity * share);
  }

  /// Distance at which two particles of mean curvature magnitude D cease to see each other:
  /// 1/alpha with alpha = beta (1 + rho D s / 2 pi) / s, eq. (6) without its misprint.
  double range(double curvatureMagnitude) const
  {
    return this->at(curvatureMagnitude) / HexagonalDistance;
  }
};

} // namespace hop
