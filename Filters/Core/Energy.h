#pragma once

#include <algorithm>
#include <cmath>

namespace hop
{

/// The cotangent energy of two particles at the scaled distance r (Meyer et al. 2007, eq. 5, after
/// their 2005 paper), and its derivatives. All are zero from r = 1 on.

constexpr double Pi = 3.14159265358979323846;

inline double pairEnergy(double r)
{
  if (r >= 1.0)
  {
    return 0.0;
  }
  const double a = 0.5 * Pi * std::max(r, 1e-6);
  return std::cos(a) / std::sin(a) + a - 0.5 * Pi;
}

inline double pairEnergyDerivative(double r)
{
  if (r >= 1.0)
  {
    return 0.0;
  }
  const double s = std::sin(0.5 * Pi * std::max(r, 1e-6));
  return 0.5 * Pi * (1.0 - 1.0 / (s * s));
}

inline double pairEnergySecondDerivative(double r)
{
  if (r >= 1.0)
  {
    return 0.0;
  }
  const double a = 0.5 * Pi * std::max(r, 1e-6);
  const double s = std::sin(a);
  return 0.5 * Pi * Pi * std::cos(a) / (s * s * s);
}

/// Scaled distance of the six nearest neighbours in hexagonal packing; the second ring of
/// neighbours then stands at r = 1 exactly, where the energy ends: beta = 0.5 / cos(pi/6).
constexpr double HexagonalDistance = 0.57735026918962576;

/// Energy of a particle in hexagonal packing: 6 E(beta).
inline double idealEnergy()
{
  return 6.0 * pairEnergy(HexagonalDistance);
}

/// Spacing that particles want: s where the surface is flat, less where it bends.
struct SpacingLaw
{
  /// s: distance of neighbours on a flat surface, world units, > 0.
  double spacing = 1.0;
  /// rho: how much denser particles stand where the surface bends; 0 = evenly everywhere.
  double angularDensity = 0.0;

  /// h = s / (1 + rho D s / 2 pi) for curvature magnitude D. The fraction D s / 2 pi of a full turn
  /// that one spacing covers is bounded by one, so that h >= s / (1 + rho) whatever the curvature.
  double at(double curvatureMagnitude) const
  {
    const double turn = std::min(1.0, curvatureMagnitude * this->spacing / (2.0 * Pi));
    return this->spacing / (1.0 + this->angularDensity * turn);
  }

  /// Distance at which two particles of mean curvature magnitude D cease to see each other:
  /// 1/alpha with alpha = beta (1 + rho D s / 2 pi) / s, eq. (6) without its misprint.
  double range(double curvatureMagnitude) const
  {
    return this->at(curvatureMagnitude) / HexagonalDistance;
  }
};

} // namespace hop
