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

} // namespace hop
