#pragma once

#include <algorithm>
#include <cmath>

namespace hop
{

/// The cotangent energy of two particles at the scaled distance r (Meyer et al. 2007, eq. 5, after
/// their 2005 paper), and its derivatives:
///   E(r) = cot(pi r/2) + pi r/2 - pi/2
/// and E(r) = 0 from r = 1 on, where E, E' and E'' are continuous. See Documentation/algorithm.md, section Energy and
/// sizing.

constexpr double Pi = 3.14159265358979323846;

/// Scaled distances below count as this one, so that the energy of particles in one place is finite, 6e5.
constexpr double SmallestScaledDistance = 1e-6;

inline double pairEnergy(double r)
{
  if (r >= 1.0)
  {
    return 0.0;
  }
  const double a = 0.5 * Pi * std::max(r, SmallestScaledDistance);
  return std::cos(a) / std::sin(a) + a - 0.5 * Pi;
}

/// E'(r) = (pi/2) (1 - 1/sin^2(pi r/2))
inline double pairEnergyDerivative(double r)
{
  if (r >= 1.0)
  {
    return 0.0;
  }
  const double s = std::sin(0.5 * Pi * std::max(r, SmallestScaledDistance));
  return 0.5 * Pi * (1.0 - 1.0 / (s * s));
}

/// E''(r) = (pi^2/2) cos(pi r/2)/sin^3(pi r/2)
inline double pairEnergySecondDerivative(double r)
{
  if (r >= 1.0)
  {
    return 0.0;
  }
  const double a = 0.5 * Pi * std::max(r, SmallestScaledDistance);
  const double s = std::sin(a);
  return 0.5 * Pi * Pi * std::cos(a) / (s * s * s);
}

/// beta = 0.5 / cos(pi/6), the scaled distance of the six nearest neighbours in hexagonal packing: the second ring of
/// neighbours then stands at r = 1 exactly, where the energy ends.
constexpr double HexagonalDistance = 0.57735026918962576;

/// E_ideal, the energy of a particle in hexagonal packing: 6 E(beta).
inline double idealEnergy()
{
  return 6.0 * pairEnergy(HexagonalDistance);
}

} // namespace hop
