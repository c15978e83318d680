#pragma once

#include "Elements/Bernstein.h"

namespace hop
{

/// How a polynomial rises along some direction.
enum class Monotony
{
  None,
  /// It never falls. It may stand still in places where it is not zero and all its values have one sign, as the square
  /// of a velocity less a constant does at a wall.
  Weak,
  /// It rises everywhere, at a thousandth of its average slope or more.
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
/// Derivation: Documentation/algorithm.md, section Isolation.
class MonotoneTest
{
public:
  MonotoneTest(Domain domain, const Degrees& degrees);

  /// \param values one coefficient a lattice point
  /// \return what is certain of the derivative along the mean gradient
  Monotony monotony(const std::vector<double>& values) const;

  /// Whether the polynomial rises along its mean gradient, weakly at least.
  bool rises(const std::vector<double>& values) const
  {
    return this->monotony(values) != Monotony::None;
  }

  /// The coefficients of the derivative along a direction, elevated to the polynomial's degrees.
  std::vector<double> derivative(
    const std::vector<double>& values, const glm::dvec3& direction) const;

private:
  void listDifferences(Domain domain, const Degrees& degrees);
  void sumMean(std::size_t points);

  /// weight (c_plus - c_minus): one term of a coefficient of a derivative.
  struct Difference
  {
    int plus = 0;
    int minus = 0;
    double weight = 0.0;
  };

  /// Coefficients of the three derivatives at a lattice point.
  glm::dvec3 gradient(const std::vector<double>& values, std::size_t point) const;

  /// The coefficient of the derivative along an axis at a lattice point is the sum of the differences Begin[n] to
  /// Begin[n + 1] - 1, n = 3 point + axis.
  std::vector<Difference> Differences;
  std::vector<int> Begin;
  /// Weight of each value in the mean gradient, which is the mean of the derivatives' coefficients times their number.
  std::vector<glm::dvec3> Mean;
};

} // namespace hop
