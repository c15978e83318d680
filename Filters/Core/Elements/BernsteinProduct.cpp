#include "Elements/BernsteinProduct.h"

#include "Elements/LatticeRows.h"
#include "Kernel/InstructionSet.h"

#include <algorithm>
#include <utility>

namespace hop
{
namespace
{

Degrees addedDegrees(const Degrees& a, const Degrees& b)
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

/// The product with 1 = u + b along an axis that is a factor of its own: of one degree more there.
ScaledPolynomial timesOneAlong(const ScaledPolynomial& polynomial, int axis)
{
  ScaledPolynomial result{ polynomial.domain, polynomial.degrees, {} };
  ++result.degrees[axis];
  result.values.resize(coefficientCount(result.domain, result.degrees));
  const std::size_t step = stepAlong(polynomial, axis);
  const std::size_t length = step * (polynomial.degrees[axis] + 1);
  double* to = result.values.data();
  for (const double* from = polynomial.values.data();
       from != polynomial.values.data() + polynomial.values.size(); from += length)
  {
    std::copy_n(from, step, to);
    for (std::size_t i = step; i < length; ++i)
    {
      to[i] = from[i] + from[i - step];
    }
    std::copy_n(from + length - step, step, to + length);
    to += length + step;
  }
  return result;
}

/// The rows of a polynomial's lattice with zeros before, between and behind them.
class PaddedRows
{
public:
  /// \param margin zeros between two rows
  PaddedRows(const ScaledPolynomial& polynomial, int margin)
    : Columns(polynomial.degrees[1] + 1)
    , Stride(polynomial.degrees[0] + 1 + margin)
    , Margin(margin)
    , Values(margin + Stride * Columns * (polynomial.degrees[2] + 1), 0.0)
  {
    const double* from = polynomial.values.data();
    visitLatticeRows(polynomial.domain, polynomial.degrees,
      [&](int j, int k, int length)
      {
        std::copy_n(from, length, &this->Values[this->indexOf(j, k)]);
        from += length;
      });
  }

  const double* row(int j, int k) const { return &this->Values[this->indexOf(j, k)]; }

private:
  std::size_t indexOf(int j, int k) const
  {
    return this->Margin + this->Stride * (k * this->Columns + j);
  }

  std::size_t Columns;
  std::size_t Stride;
  std::size_t Margin;
  std::vector<double> Values;
};

/// The rows of a polynomial's lattice, times a factor; those that a simplex has not are empty.
class RowsOfFactor
{
public:
  RowsOfFactor(double factor, const ScaledPolynomial& polynomial)
    : Columns(polynomial.degrees[1] + 1)
    , Values(polynomial.values)
    , Rows(Columns * (polynomial.degrees[2] + 1), { nullptr, 0, nullptr })
  {
    for (double& value : this->Values)
    {
      value *= factor;
    }
    const double* from = this->Values.data();
    visitLatticeRows(polynomial.domain, polynomial.degrees,
      [&](int j, int k, int length)
      {
        this->Rows[k * this->Columns + j] = { from, length, nullptr };
        from += length;
      });
  }

  /// With nothing on the right.
  const kernel::RowPair& row(int j, int k) const { return this->Rows[k * this->Columns + j]; }

private:
  std::size_t Columns;
  std::vector<double> Values;
  std::vector<kernel::RowPair> Rows;
};

} // namespace

ScaledPolynomial elevated(ScaledPolynomial polynomial, const Degrees& degrees)
{
  for (const SimplexFactor& factor : facts(polynomial.domain).factors)
  {
    const int missing = degrees[factor.axis] - polynomial.degrees[factor.axis];
    if (factor.dimension == 1)
    {
      for (int n = 0; n < missing; ++n)
      {
        polynomial = timesOneAlong(polynomial, factor.axis);
      }
    }
    else if (missing > 0)
    {
      Degrees along{ 0, 0, 0 };
      std::fill(along.begin() + factor.axis, along.begin() + factor.end(), missing);
      polynomial = polynomial * one(polynomial.domain, along);
    }
  }
  return polynomial;
}

ScaledPolynomial sumOf(const std::vector<std::pair<double, const ScaledPolynomial*>>& terms)
{
  const Domain domain = terms.front().second->domain;
  ScaledPolynomial sum{ domain, { 0, 0, 0 }, { 0.0 } };
  for (const auto& [factor, term] : terms)
  {
    for (int a = 0; a < 3 && !isZero(*term); ++a)
    {
      sum.degrees[a] = std::max(sum.degrees[a], term->degrees[a]);
    }
  }
  sum.values.assign(coefficientCount(domain, sum.degrees), 0.0);
  for (const auto& [factor, term] : terms)
  {
    if (!isZero(*term))
    {
      const ScaledPolynomial alike = elevated(*term, sum.degrees);
      for (std::size_t i = 0; i < sum.values.size(); ++i)
      {
        sum.values[i] += factor * alike.values[i];
      }
    }
  }
  return sum;
}

ScaledPolynomial operator*(const ScaledPolynomial& a, const ScaledPolynomial& b)
{
  ScaledPolynomial product{ a.domain, addedDegrees(a.degrees, b.degrees), {} };
  product.values.assign(coefficientCount(product.domain, product.degrees), 0.0);
  addProduct(1.0, a, b, product);
  return product;
}

void addProduct(
  double factor, const ScaledPolynomial& a, const ScaledPolynomial& b, ScaledPolynomial& sum)
{
  // A row of a times a row of b goes to one row of the sum. Numbers of the shorter rows are multiplied by whole rows of the
  // longer ones.
  const bool isShorter = a.degrees[0] <= b.degrees[0];
  const RowsOfFactor left(factor, isShorter ? a : b);
  const Degrees& ofLeft = (isShorter ? a : b).degrees;
  const Degrees& ofRight = (isShorter ? b : a).degrees;
  const PaddedRows right(isShorter ? b : a, ofLeft[0] + kernel::MaximumLanes);
  const kernel::RowProductsFunction addRowProducts = kernel::current().rowProducts;
  std::vector<kernel::RowPair> pairs;
  std::vector<double> row(sum.degrees[0] + kernel::MaximumLanes);
  double* out = sum.values.data();
  visitLatticeRows(sum.domain, sum.degrees,
    [&](int j, int k, int length)
    {
      pairs.clear();
      for (int leftK = std::max(0, k - ofRight[2]); leftK <= std::min(k, ofLeft[2]); ++leftK)
      {
        for (int leftJ = std::max(0, j - ofRight[1]); leftJ <= std::min(j, ofLeft[1]); ++leftJ)
        {
          pairs.push_back(left.row(leftJ, leftK));
          pairs.back().right = right.row(j - leftJ, k - leftK);
        }
      }
      std::copy_n(out, length, row.begin());
      addRowProducts(pairs.data(), static_cast<std::ptrdiff_t>(pairs.size()), length, row.data());
      out = std::copy_n(row.begin(), length, out);
    });
}

std::vector<double> squareField(Domain domain, const Degrees& degrees, int width,
  const std::vector<double>& control, const std::vector<double>& weights, Coefficient* result)
{
  const ScaledPolynomial weight = scaled(domain, degrees, weights);
  ScaledPolynomial square{ domain, addedDegrees(degrees, degrees), {} };
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
