#pragma once

#include "Elements/Bernstein.h"

namespace hop
{

/// How a polynomial changes along some direction.
enum class Monotony
{
  None,
  /// It never falls. Where it stands still it is not zero, and of one sign.
  Weak,
  /// It rises everywhere, nowhere less than a thousandth of what it does on average.
  Strict
};

/// Decides whether a polynomial in Bernstein form rises along some direction all over its domain.
/// Prepared once for a domain and degrees.
///
/// On a simplex with barycentric indices alpha the derivative along e_a - e_0, elevated back to the
/// degree of the polynomial, has the coefficients
///   sum_m alpha_m (c_(alpha - e_m + e_a) - c_(alpha - e_m + e_0)),
/// from c' = p (c_(beta + e_a) - c_(beta + e_0)) and degree elevation; on products of simplices the
/// same holds factor by factor. All three derivatives then share one lattice, and so does any linear
/// combination of them.
class MonotoneTest
{
public:
  MonotoneTest(Domain domain, const Degrees& degrees);

  /// \param values one coefficient a lattice point
  /// \return what its derivative along its mean gradient tells for certain. Weak is the square of a velocity
  ///   at walls, less a constant.
  Monotony monotony(const std::vector<double>& values) const;

  bool rises(const std::vector<double>& values) const
  {
    return this->monotony(values) != Monotony::None;
  }

  /// The coefficients of the derivative along a direction, elevated to the polynomial's degrees.
  std::vector<double> derivative(
    const std::vector<double>& values, const glm::dvec3& direction) const;

private:
  struct Difference
  {
    int plus = 0;
    int minus = 0;
    double weight = 0.0;
  };

  glm::dvec3 gradient(const std::vector<double>& values, std::size_t point) const;

  /// For each lattice point and axis the differences [begin, end) of its derivative coefficient.
  std::vector<Difference> Differences;
  std::vector<int> Begin;
  /// By how much a value counts in the mean gradient.
  std::vector<glm::dvec3> Mean;
};

} // namespace hop
