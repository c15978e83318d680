#pragma once

#include "Elements/Bernstein.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{

/// Interval arithmetic (Moore 1966): the ranges that sums and products have where their terms stay within ranges. Bounds
/// are not rounded outwards.

constexpr Range everything{ -std::numeric_limits<double>::infinity(),
  std::numeric_limits<double>::infinity() };

inline Range sum(const Range& a, const Range& b)
{
  return { a.lower + b.lower, a.upper + b.upper };
}

inline Range scaledBy(double factor, const Range& a)
{
  return factor >= 0.0 ? Range{ factor * a.lower, factor * a.upper }
                       : Range{ factor * a.upper, factor * a.lower };
}

inline Range product(const Range& a, const Range& b)
{
  const auto [lower, upper] =
    std::minmax({ a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper });
  return { lower, upper };
}

inline Range square(const Range& a)
{
  const double largest = a.magnitude() * a.magnitude();
  if (a.lower <= 0.0 && a.upper >= 0.0)
  {
    return { 0.0, largest };
  }
  const double least = std::min(std::abs(a.lower), std::abs(a.upper));
  return { least * least, largest };
}

/// Everything where the divisor may be zero.
inline Range quotient(const Range& a, const Range& b)
{
  const bool mayBeZero = b.lower <= 0.0 && b.upper >= 0.0;
  return mayBeZero ? everything : product(a, { 1.0 / b.upper, 1.0 / b.lower });
}

/// The range itself, or everything where a bound is no number.
inline Range knownOr(const Range& range)
{
  return range.lower > everything.lower && range.upper < everything.upper ? range : everything;
}

} // namespace hop
