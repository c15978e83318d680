#include "Elements/BernsteinProduct.h"

#include <utility>

namespace hop
{
namespace
{

double binomial(int n, int k)
{
  double result = 1.0;
  for (int i = 1; i <= k; ++i)
  {
    result *= static_cast<double>(n - k + i) / i;
  }
  return result;
}

/// The multinomial factors of a basis function, one a simplex of which the domain is the product.
double multiplicity(Domain domain, const Degrees& degrees, const LatticePoint& point)
{
  const std::array<int, 3> index{ point.i, point.j, point.k };
  double result = 1.0;
  for (const SimplexFactor& factor : facts(domain).factors)
  {
    int rest = degrees[factor.axis];
    for (int axis = factor.axis; axis < factor.end(); ++axis)
    {
      result *= binomial(rest, index[axis]);
      rest -= index[axis];
    }
  }
  return result;
}

Degrees sumOf(const Degrees& a, const Degrees& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

/// Component c of control values, which stand `width` beside each other.
ScaledPolynomial component(
  Domain domain, const Degrees& degrees, int width, int c, const std::vector<double>& control)
{
  std::vector<double> coefficients;
  for (std::size_t i = c; i < control.size(); i += width)
  {
    coefficients.push_back(control[i]);
  }
  return scaled(domain, degrees, std::move(coefficients));
}

} // namespace

ScaledPolynomial scaled(Domain domain, const Degrees& degrees, std::vector<double> coefficients)
{
  auto value = coefficients.begin();
  for (const LatticePoint& point : latticePoints(domain, degrees))
  {
    *value++ *= multiplicity(domain, degrees, point);
  }
  return { domain, degrees, std::move(coefficients) };
}

std::vector<double> unscaled(ScaledPolynomial polynomial)
{
  auto value = polynomial.values.begin();
  for (const LatticePoint& point : latticePoints(polynomial.domain, polynomial.degrees))
  {
    *value++ /= multiplicity(polynomial.domain, polynomial.degrees, point);
  }
  return std::move(polynomial.values);
}

ScaledPolynomial operator*(const ScaledPolynomial& a, const ScaledPolynomial& b)
{
  ScaledPolynomial product{ a.domain, sumOf(a.degrees, b.degrees), {} };
  product.values.assign(coefficientCount(product.domain, product.degrees), 0.0);
  addProduct(1.0, a, b, product);
  return product;
}

void addProduct(
  double factor, const ScaledPolynomial& a, const ScaledPolynomial& b, ScaledPolynomial& sum)
{
  // The first index runs fastest in every domain: row by row of b, without looking up each place.
  const std::vector<LatticePoint> left = latticePoints(a.domain, a.degrees);
  const std::vector<LatticePoint> right = latticePoints(b.domain, b.degrees);
  for (std::size_t n = 0; n < left.size(); ++n)
  {
    const double scale = factor * a.values[n];
    const auto& [i, j, k] = left[n];
    for (std::size_t row = 0, end = 0; row < right.size(); row = end)
    {
      double* out = &sum.values[coefficientIndex(
        sum.domain, sum.degrees, { i, j + right[row].j, k + right[row].k })];
      for (end = row; end < right.size() && right[end].i == static_cast<int>(end - row); ++end)
      {
        out[end - row] += scale * b.values[end];
      }
    }
  }
}

std::vector<double> squareField(Domain domain, const Degrees& degrees, int width,
  const std::vector<double>& control, const std::vector<double>& weights, Coefficient* result)
{
  const ScaledPolynomial weight = scaled(domain, degrees, weights);
  ScaledPolynomial square{ domain, sumOf(degrees, degrees), {} };
  square.values.assign(coefficientCount(domain, square.degrees), 0.0);
  for (int c = 0; c < width; ++c)
  {
    const ScaledPolynomial factor = component(domain, degrees, width, c, control);
    if (c >= 3)
    {
      addProduct(1.0, factor, factor, square);
      continue;
    }
    const std::vector<double> elevated = unscaled(weight * factor);
    for (std::size_t i = 0; i < elevated.size(); ++i)
    {
      result[i][c] = elevated[i];
    }
  }
  const std::vector<double> field = unscaled(std::move(square));
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    result[i].w = field[i];
  }
  return unscaled(weight * weight);
}

} // namespace hop
