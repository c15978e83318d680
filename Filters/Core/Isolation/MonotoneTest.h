#pragma once

#include "Elements/Bernstein.h"

#include <array>
#include <vector>

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

  /// Of the coefficients of a derivative in a row of the lattice a term of `count` ones from `first` on: of the n-th of them
  /// (constant + slope n) (c_(plus + n) - c_(minus + n)).
  struct Difference
  {
    int first = 0;
    int count = 0;
    int plus = 0;
    int minus = 0;
    double constant = 0.0;
    double slope = 0.0;
  };
  struct Row
  {
    int start = 0;
    int length = 0;
    /// Of the differences along each axis the first, and where the last axis ends.
    std::array<int, 4> begin{};
  };
  /// Coefficients of the three derivatives in a row.
  struct Slopes
  {
    std::array<std::array<double, MaximumDegree + 1>, 3> along;

    glm::dvec3 at(int i) const
    {
      return { this->along[0][i], this->along[1][i], this->along[2][i] };
    }
  };

  void listDifferencesOf(Domain domain, const Degrees& degrees, Row& row, int j, int k);
  void findSlopes(const std::vector<double>& values, const Row& row, Slopes& slopes) const;

  std::vector<Row> Rows;
  std::vector<Difference> Differences;
  /// Weight of each value in the mean gradient, which is the mean of the derivatives' coefficients times their number.
  std::vector<glm::dvec3> Mean;
};

} // namespace hop
