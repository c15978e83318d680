#include "Elements/LobattoLattice.h"

#include "Elements/Bernstein.h"
#include "Elements/NodalBasis.h"
#include "Kernel/InstructionSet.h"

namespace hop
{

namespace
{

using Extended = long double;

LineMatrix zeros(std::size_t rows, int columns)
{
  return { static_cast<int>(rows), columns, std::vector<double>(rows * columns) };
}

/// P_0 to P_n at x, by Legendre's recurrence n P_n = (2n - 1) x P_{n-1} - (n - 1) P_{n-2}.
std::vector<Extended> legendreAt(Extended x, int n)
{
  std::vector<Extended> values{ 1.0L, x };
  for (int k = 2; k <= n; ++k)
  {
    values.push_back(((2 * k - 1) * x * values[k - 1] - (k - 1) * values[k - 2]) / k);
  }
  return values;
}

/// Takes values at the Gauss-Lobatto-Legendre points to coefficients of Legendre polynomials, by the points' quadrature with
/// the weights 2 / (n (n + 1) P_n^2): it takes sum P_k P_l for 2 / (2k + 1) where k = l < n, for 2 / n where k = l = n, and
/// for 0 else.
LineMatrix toLegendre(int n)
{
  const std::vector<Extended> points = gaussLobattoPoints(n);
  LineMatrix matrix = zeros(n + 1, n + 1);
  for (int i = 0; i <= n; ++i)
  {
    const std::vector<Extended> p = legendreAt(2.0L * points[i] - 1.0L, n);
    const Extended weight = 2.0L / (n * (n + 1) * p[n] * p[n]);
    for (int k = 0; k <= n; ++k)
    {
      const Extended square = k < n ? 2.0L / (2 * k + 1) : 2.0L / n;
      matrix.entries[k * (n + 1) + i] = static_cast<double>(weight * p[k] / square);
    }
  }
  return matrix;
}

/// Bernstein coefficients of degree n of the Legendre polynomials on [0, 1]: (-1)^(k + i) C(k,i) of degree k, which are
/// elevated.
LineMatrix fromLegendre(int n)
{
  LineMatrix matrix = zeros(n + 1, n + 1);
  for (int k = 0; k <= n; ++k)
  {
    std::vector<Extended> coefficients;
    Extended size = k % 2 == 0 ? 1.0L : -1.0L;
    for (int i = 0; i <= k; ++i)
    {
      coefficients.push_back(size);
      size *= -static_cast<Extended>(k - i) / (i + 1);
    }
    for (int degree = k + 1; degree <= n; ++degree)
    {
      coefficients.push_back(coefficients.back());
      for (int i = degree - 1; i > 0; --i)
      {
        coefficients[i] = (i * coefficients[i - 1] + (degree - i) * coefficients[i]) / degree;
      }
    }
    for (int i = 0; i <= n; ++i)
    {
      matrix.entries[i * (n + 1) + k] = static_cast<double>(coefficients[i]);
    }
  }
  return matrix;
}

/// Applies a matrix along the first axis: the lines, one below the other, times the transposed matrix.
std::vector<double> alongFirstAxis(const LineMatrix& matrix, const std::vector<double>& values)
{
  std::vector<double> transposed(matrix.entries.size());
  for (int row = 0; row < matrix.rows; ++row)
  {
    for (int column = 0; column < matrix.columns; ++column)
    {
      transposed[column * matrix.rows + row] = matrix.entries[row * matrix.columns + column];
    }
  }
  const int lines = static_cast<int>(values.size()) / matrix.columns;
  std::vector<double> result(static_cast<std::size_t>(lines) * matrix.rows);
  kernel::current().matrix(
    values.data(), lines, matrix.columns, transposed.data(), matrix.rows, result.data());
  return result;
}

/// Applies a matrix along one axis.
/// \param row numbers of a point and of those beside it along the axes before this one
std::vector<double> alongAxis(const LineMatrix& matrix, int row, const std::vector<double>& values)
{
  if (row == 1)
  {
    return alongFirstAxis(matrix, values);
  }
  const std::size_t step = static_cast<std::size_t>(row) * matrix.columns;
  const std::size_t blocks = values.size() / step;
  std::vector<double> result(blocks * matrix.rows * row);
  for (std::size_t block = 0; block < blocks; ++block)
  {
    kernel::current().matrix(matrix.entries.data(), matrix.rows, matrix.columns,
      values.data() + block * step, row, result.data() + block * matrix.rows * row);
  }
  return result;
}

} // namespace

LineMatrix bernsteinValues(int degree, const std::vector<double>& points)
{
  LineMatrix matrix = zeros(points.size(), degree + 1);
  double* row = matrix.entries.data();
  for (const double t : points)
  {
    lineBasis(degree, t, row);
    row += matrix.columns;
  }
  return matrix;
}

LineMatrix bernsteinSlopes(int degree, const std::vector<double>& points)
{
  LineMatrix matrix = zeros(points.size(), degree + 1);
  double* row = matrix.entries.data();
  for (const double t : points)
  {
    // B'_i,p = p (B_i-1,p-1 - B_i,p-1), from the last one on, in place.
    lineBasis(degree - 1, t, row);
    row[degree] = degree * row[degree - 1];
    for (int i = degree - 1; i > 0; --i)
    {
      row[i] = degree * (row[i - 1] - row[i]);
    }
    row[0] *= -degree;
    row += matrix.columns;
  }
  return matrix;
}

std::vector<double> alongAxes(
  const std::array<const LineMatrix*, 3>& matrices, const std::vector<double>& values)
{
  const int points = matrices[0]->columns * matrices[1]->columns * matrices[2]->columns;
  int row = static_cast<int>(values.size()) / points;
  const std::vector<double>* from = &values;
  std::vector<double> result;
  for (const LineMatrix* matrix : matrices)
  {
    result = alongAxis(*matrix, row, *from);
    from = &result;
    row *= matrix->rows;
  }
  return result;
}

std::array<std::vector<double>, 4> gradientsAlongAxes(const std::array<LineMatrix, 3>& values,
  const std::array<LineMatrix, 3>& slopes, const std::vector<double>& numbers)
{
  const int line = values[0].rows;
  const int plane = line * values[1].rows;
  const std::vector<double> value = alongAxis(values[0], 1, numbers);
  const std::vector<double> slope = alongAxis(slopes[0], 1, numbers);
  const std::vector<double> valueOfPlane = alongAxis(values[1], line, value);
  return { alongAxis(values[2], plane, valueOfPlane),
    alongAxis(values[2], plane, alongAxis(values[1], line, slope)),
    alongAxis(values[2], plane, alongAxis(slopes[1], line, value)),
    alongAxis(slopes[2], plane, valueOfPlane) };
}

LobattoLattice::LobattoLattice(int degree)
  : ToLegendre(toLegendre(degree))
  , FromLegendre(fromLegendre(degree))
{
  const std::vector<Extended> points = gaussLobattoPoints(degree);
  this->Line.assign(points.begin(), points.end());
}

std::vector<double> LobattoLattice::toBernstein(const std::vector<double>& values) const
{
  const LineMatrix* to = &this->ToLegendre;
  const LineMatrix* from = &this->FromLegendre;
  return alongAxes({ from, from, from }, alongAxes({ to, to, to }, values));
}

} // namespace hop
