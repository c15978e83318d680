#pragma once

#include <algorithm>
#include <cmath>

namespace hop
{

/// The units in which elements and their particles are computed: grids have sides of about one then, and fields change
/// by about one in an element, whatever the units of the input. Squares, cubes and single precision neither overflow nor
/// underflow. Powers of two, so that changing units rounds nothing.
struct RunUnits
{
  /// World units.
  double length = 1.0;
  /// Of the chosen scalar.
  double value = 1.0;
};

/// The largest power of two that is at most twice a size, so that the size is 0.5 to 1 of it; 1 if the size is zero.
/// \param size >= 0, finite
inline double unitOf(double size)
{
  // Both the unit and its inverse are doubles. Sizes beyond 1e301 or below 1e-301 are not scaled all the way.
  constexpr int largestExponent = 1000;
  int exponent = 0;
  std::frexp(size, &exponent);
  return std::ldexp(1.0, std::clamp(exponent, -largestExponent, largestExponent));
}

} // namespace hop
