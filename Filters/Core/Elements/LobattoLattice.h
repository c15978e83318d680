#pragma once

#include "Elements/Domain.h"

#include <array>
#include <vector>

namespace hop
{

/// A matrix for numbers along a line, row by row.
struct LineMatrix
{
  int rows = 0;
  int columns = 0;
  std::vector<double> entries;
};

/// Takes Bernstein coefficients of a line to values at points, or to derivatives.
LineMatrix bernsteinValues(int degree, const std::vector<double>& points);
LineMatrix bernsteinSlopes(int degree, const std::vector<double>& points);

/// Applies a matrix along each coordinate to numbers on a lattice of a cube, one axis after the other (sum factorisation,
/// Orszag 1980): with n points along an axis some 3 n^4 products instead of n^6.
/// \param values at as many points as the matrices' columns say, in the order of coefficientIndex; of each point as many
/// side by side as there are
/// \return of as many points as the matrices' rows say
std::vector<double> alongAxes(
  const std::array<const LineMatrix*, 3>& matrices, const std::vector<double>& values);

/// Values and derivatives along the three axes, each as alongAxes() would give them.
/// \param numbers of one component after the other, each in the order of coefficientIndex; so are the results
std::array<std::vector<double>, 4> gradientsAlongAxes(const std::array<LineMatrix, 3>& values,
  const std::array<LineMatrix, 3>& slopes, const std::vector<double>& numbers);

/// The lattice of the Gauss-Lobatto-Legendre points of a cube, and the polynomial that has given values there.
class LobattoLattice
{
public:
  explicit LobattoLattice(int degree);

  int degree() const { return static_cast<int>(this->Line.size()) - 1; }
  /// Coordinates of the points along each axis.
  const std::vector<double>& line() const { return this->Line; }

  /// Bernstein coefficients, of one polynomial or of several side by side. They are computed by way of the coefficients of
  /// Legendre polynomials: these are as small as the values, and those of high degrees, whose Bernstein coefficients are
  /// large, are small where the field is smooth. So doubles do where the matrix of Bernstein polynomials, with entries of
  /// 2^degree an axis, wants extended precision.
  std::vector<double> toBernstein(const std::vector<double>& values) const;

private:
  std::vector<double> Line;
  LineMatrix ToLegendre;
  LineMatrix FromLegendre;
};

} // namespace hop
