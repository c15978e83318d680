#pragma once

#include "Surface/Energy.h"

#include <algorithm>

namespace hop
{

/// The spacing wanted on the surface: s where it is flat, less where it bends. Meyer et al. 2007, eq. (6), without its
/// misprint: two particles at the distance d have the scaled distance r = alpha d of Energy.h with
///   alpha = beta (1 + rho D s / 2 pi) / s,
/// D the mean of their curvature magnitudes. Hexagonal packing, r = beta, then has the distance
///   h = beta / alpha = s / (1 + rho D s / 2 pi).
/// See Documentation/algorithm.md, section Energy and sizing.
struct SizingFunction
{
  /// s: distance of neighbours on a flat surface, world units, > 0.
  double spacing = 1.0;
  /// rho: how much denser particles stand where the surface bends; 0 = evenly everywhere.
  double angularDensity = 0.0;

  /// h for a curvature magnitude D, world units. D s / 2 pi, the fraction of a full circle that one spacing covers, is
  /// bounded by one (the paper has no bound), so that h >= s / (1 + rho) whatever the curvature.
  double at(double curvatureMagnitude) const
  {
    const double share = std::min(1.0, curvatureMagnitude * this->spacing / (2.0 * Pi));
    return this->spacing / (1.0 + this->angularDensity * share);
  }

  /// 1/alpha, the distance at which two particles of mean curvature magnitude D cease to see each other: r = 1.
  double range(double curvatureMagnitude) const
  {
    return this->at(curvatureMagnitude) / HexagonalDistance;
  }
};

} // namespace hop
