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

  /// Smallest h, world units, the optional bound of the paper's section 3.3; 0: s / (1 + rho MostTurns).
  double smallestSpacing = 0.0;

  /// Turns that the surface takes over a length s up to which the spacing follows it where no smallest spacing is
  /// given. Larger: where sheets cross, and where the gradient vanishes, particles become more in proportion to it;
  /// smaller: fewer than rho particles stand around tubes thinner than s / (2 pi MostTurns). Eight turns are a tube with
  /// a radius of s/50. Chosen by experiment: of the solvers' files, none has over 2% more particles without any bound.
  static constexpr double MostTurns = 8.0;

  /// The bound of h.
  double smallest() const
  {
    return this->smallestSpacing > 0.0 ? std::min(this->spacing, this->smallestSpacing)
                                       : this->spacing / (1.0 + this->angularDensity * MostTurns);
  }

  /// h for a curvature magnitude D, world units. D s / 2 pi are the turns that the surface takes over a length s.
  double at(double curvatureMagnitude) const
  {
    const double turns = curvatureMagnitude * this->spacing / (2.0 * Pi);
    return std::max(this->smallest(), this->spacing / (1.0 + this->angularDensity * turns));
  }

  /// 1/alpha, the distance at which two particles of mean curvature magnitude D cease to see each other: r = 1.
  double range(double curvatureMagnitude) const
  {
    return this->at(curvatureMagnitude) / HexagonalDistance;
  }
};

} // namespace hop
