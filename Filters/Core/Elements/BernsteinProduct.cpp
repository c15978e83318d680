#include "Elements/BernsteinProduct.h"

#include "Elements/LatticeRows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hop
{
namespace
{

double computedBinomial(int n, int k)
{
  double result = 1.0;
  for (int i = 1; i <= k; ++i)
  {
    result *= static_cast<double>(n - k + i) / i;
  }
  return result;
}

/// Binomial coefficients n over k, 0 <= k <= n <= MaximumPolynomialDegree: looked up for every coefficient of every
/// polynomial.
class BinomialTable
{
public:
  BinomialTable()
  {
    for (int n = 0; n <= MaximumPolynomialDegree; ++n)
    {
      for (int k = 0; k <= n; ++k)
      {
        this->Rows[n][k] = computedBinomial(n, k);
      }
    }
  }

  double at(int n, int k) const { return this->Rows[n][k]; }

private:
  std::array<std::array<double, MaximumPolynomialDegree + 1>, MaximumPolynomialDegree + 1> Rows{};
};

double binomial(int n, int k)
{
  static const BinomialTable table;
  // Fields of derivatives have factors of higher degrees.
  return n <= MaximumPolynomialDegree ? table.at(n, k) : computedBinomial(n, k);
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

/// The constant 1.
ScaledPolynomial one(Domain domain, const Degrees& degrees)
{
  return scaled(domain, degrees, std::vector<double>(coefficientCount(domain, degrees), 1.0));
}

/// A lattice point's numbers in a simplex of its domain: along its axes, then the rest up to the degree, which belongs to
/// b = 1 - u (- v - w).
std::array<int, 4> barycentric(
  const SimplexFactor& factor, const Degrees& degrees, const LatticePoint& point)
{
  const std::array<int, 3> index{ point.i, point.j, point.k };
  std::array<int, 4> result{};
  int rest = degrees[factor.axis];
  for (int n = 0; n < factor.dimension; ++n)
  {
    result[n] = index[factor.axis + n];
    rest -= result[n];
  }
  result[factor.dimension] = rest;
  return result;
}

/// The lattice point with one more of a barycentric number.
LatticePoint oneMore(const SimplexFactor& factor, LatticePoint point, int number)
{
  const int axis = factor.axis + number;
  const int step = number < factor.dimension ? 1 : 0;
  return { point.i + step * (axis == 0), point.j + step * (axis == 1),
    point.k + step * (axis == 2) };
}

/// A zero polynomial of one degree less in a simplex of its domain.
ScaledPolynomial oneDegreeLess(const ScaledPolynomial& polynomial, const SimplexFactor& factor)
{
  ScaledPolynomial result{ polynomial.domain, polynomial.degrees, {} };
  for (int a = factor.axis; a < factor.end(); ++a)
  {
    --result.degrees[a];
  }
  result.values.resize(coefficientCount(result.domain, result.degrees));
  return result;
}

/// The quotient of a polynomial and 1 = u (+ v + w) + b in a triangle or tetrahedron of its domain: of one degree less
/// there. What the division leaves over is dropped. A coefficient p_a of the product is the sum of all quotient's
/// q_(a - e_k), so that each q follows from those nearer to a corner of the simplex; starting at the nearest corner
/// errors hardly grow.
/// \pre the degree is positive
ScaledPolynomial dividedByOne(const ScaledPolynomial& polynomial, const SimplexFactor& factor)
{
  const Domain domain = polynomial.domain;
  ScaledPolynomial result = oneDegreeLess(polynomial, factor);
  const auto quotientAt =
    [&](const LatticePoint& point, const std::array<int, 4>& numbers, int corner)
  {
    const LatticePoint upper = oneMore(factor, point, corner);
    double value = polynomial.values[coefficientIndex(domain, polynomial.degrees, upper)];
    for (int other = 0; other <= factor.dimension; ++other)
    {
      const LatticePoint step = oneMore(factor, {}, other);
      const LatticePoint before{ upper.i - step.i, upper.j - step.j, upper.k - step.k };
      if (other != corner && numbers[other] > 0)
      {
        value -= result.values[coefficientIndex(domain, result.degrees, before)];
      }
    }
    return value;
  };
  for (int largest = result.degrees[factor.axis]; largest >= 0; --largest)
  {
    std::size_t n = 0;
    visitLatticePoints(domain, result.degrees,
      [&](const LatticePoint& point)
      {
        const std::array<int, 4> numbers = barycentric(factor, result.degrees, point);
        const auto end = numbers.begin() + factor.dimension + 1;
        const auto most = std::max_element(numbers.begin(), end);
        if (*most == largest)
        {
          result.values[n] = quotientAt(point, numbers, static_cast<int>(most - numbers.begin()));
        }
        ++n;
      });
  }
  return result;
}

/// Calls visit(start) for every line of the lattice along an axis that is a factor of its own.
template <class Visit>
void visitLines(const ScaledPolynomial& polynomial, int axis, const Visit& visit)
{
  Degrees ends = polynomial.degrees;
  ends[axis] = 0;
  visitLatticePoints(polynomial.domain, ends, visit);
}

/// Distance of coefficients that are neighbours on such a line.
int stepAlong(const ScaledPolynomial& polynomial, int axis)
{
  return coefficientIndex(
    polynomial.domain, polynomial.degrees, { axis == 0, axis == 1, axis == 2 });
}

/// dividedByOne() along a line: from both of its ends to the middle.
ScaledPolynomial dividedByOneAlong(const ScaledPolynomial& polynomial, int axis)
{
  const Domain domain = polynomial.domain;
  ScaledPolynomial result = oneDegreeLess(polynomial, factorOf(domain, axis));
  const int degree = result.degrees[axis];
  const int pStep = stepAlong(polynomial, axis);
  const int qStep = stepAlong(result, axis);
  visitLines(polynomial, axis,
    [&](const LatticePoint& start)
    {
      const double* p = &polynomial.values[coefficientIndex(domain, polynomial.degrees, start)];
      double* q = &result.values[coefficientIndex(domain, result.degrees, start)];
      for (int i = degree; 2 * i >= degree; --i)
      {
        q[i * qStep] = p[(i + 1) * pStep] - (i < degree ? q[(i + 1) * qStep] : 0.0);
      }
      for (int i = 0; 2 * i < degree; ++i)
      {
        q[i * qStep] = p[i * pStep] - (i > 0 ? q[(i - 1) * qStep] : 0.0);
      }
    });
  return result;
}

/// The nearest polynomial of one degree less along a line, still written with all coefficients. Of degree n are
/// the coefficients whose n-th difference is zero: what is taken away is a multiple of (-1)^i C(n,i) (Lutterkort, Peters
/// and Reif 1999, Polynomial degree reduction in the L2-norm equals best Euclidean approximation of Bezier coefficients).
ScaledPolynomial nearestOfLowerDegree(ScaledPolynomial polynomial, int axis)
{
  const int n = polynomial.degrees[axis];
  // In the scaled basis the coefficients are C(n,i) a_i, and what is taken away is (-1)^i C(n,i)^2.
  double norm2 = 0.0;
  for (int i = 0; i <= n; ++i)
  {
    norm2 += binomial(n, i) * binomial(n, i);
  }
  const int step = stepAlong(polynomial, axis);
  visitLines(polynomial, axis,
    [&](const LatticePoint& start)
    {
      double* line =
        &polynomial.values[coefficientIndex(polynomial.domain, polynomial.degrees, start)];
      double difference = 0.0;
      for (int i = 0; i <= n; ++i)
      {
        difference += (i % 2 == 0 ? 1.0 : -1.0) * line[i * step];
      }
      for (int i = 0; i <= n; ++i)
      {
        line[i * step] -=
          (i % 2 == 0 ? 1.0 : -1.0) * binomial(n, i) * binomial(n, i) * difference / norm2;
      }
    });
  return polynomial;
}

/// Largest change of a Bernstein coefficient by nearestOfLowerDegree().
double changeToLowerDegree(const ScaledPolynomial& polynomial, int axis)
{
  const int n = polynomial.degrees[axis];
  const int step = stepAlong(polynomial, axis);
  double norm2 = 0.0;
  for (int i = 0; i <= n; ++i)
  {
    norm2 += binomial(n, i) * binomial(n, i);
  }
  double largest = 0.0;
  visitLines(polynomial, axis,
    [&](const LatticePoint& start)
    {
      const double* line =
        &polynomial.values[coefficientIndex(polynomial.domain, polynomial.degrees, start)];
      double difference = 0.0;
      for (int i = 0; i <= n; ++i)
      {
        difference += (i % 2 == 0 ? 1.0 : -1.0) * line[i * step];
      }
      largest = std::max(
        largest, std::abs(difference) / multiplicity(polynomial.domain, polynomial.degrees, start));
    });
  return largest * binomial(n, n / 2) / norm2;
}

/// Whether some Bernstein coefficients of two polynomials of the same degrees differ by more than a tolerance.
bool differ(const ScaledPolynomial& a, const ScaledPolynomial& b, double tolerance)
{
  bool result = false;
  std::size_t n = 0;
  visitLatticePoints(a.domain, a.degrees,
    [&](const LatticePoint& point)
    {
      result = result ||
        std::abs((a.values[n] - b.values[n]) / multiplicity(a.domain, a.degrees, point)) >
          tolerance;
      ++n;
    });
  return result;
}

/// Takes one degree away along an axis that is a factor of its own, if no coefficient changes by more than a tolerance.
bool lowerAlong(int axis, double tolerance, ScaledPolynomial& polynomial)
{
  const bool isLower = !(changeToLowerDegree(polynomial, axis) > tolerance);
  if (isLower)
  {
    polynomial = dividedByOneAlong(nearestOfLowerDegree(std::move(polynomial), axis), axis);
  }
  return isLower;
}

/// The same in a triangle or tetrahedron.
bool lowerIn(const SimplexFactor& factor, double tolerance, ScaledPolynomial& polynomial)
{
  ScaledPolynomial lower = dividedByOne(polynomial, factor);
  const bool isLower = !differ(elevated(lower, polynomial.degrees), polynomial, tolerance);
  if (isLower)
  {
    polynomial = std::move(lower);
  }
  return isLower;
}

} // namespace

ScaledPolynomial scaled(Domain domain, const Degrees& degrees, std::vector<double> coefficients)
{
  auto value = coefficients.begin();
  visitLatticePoints(domain, degrees,
    [&](const LatticePoint& point) { *value++ *= multiplicity(domain, degrees, point); });
  return { domain, degrees, std::move(coefficients) };
}

std::vector<double> unscaled(ScaledPolynomial polynomial)
{
  auto value = polynomial.values.begin();
  visitLatticePoints(polynomial.domain, polynomial.degrees,
    [&](const LatticePoint& point)
    { *value++ /= multiplicity(polynomial.domain, polynomial.degrees, point); });
  return std::move(polynomial.values);
}

ScaledPolynomial elevated(ScaledPolynomial polynomial, const Degrees& degrees)
{
  for (const SimplexFactor& factor : facts(polynomial.domain).factors)
  {
    const int missing = degrees[factor.axis] - polynomial.degrees[factor.axis];
    Degrees along{ 0, 0, 0 };
    std::fill(along.begin() + factor.axis, along.begin() + factor.end(), missing);
    polynomial = missing > 0 ? polynomial * one(polynomial.domain, along) : std::move(polynomial);
  }
  return polynomial;
}

ScaledPolynomial lowered(ScaledPolynomial polynomial, double tolerance)
{
  for (const SimplexFactor& factor : facts(polynomial.domain).factors)
  {
    bool isLower = true;
    while (isLower && polynomial.degrees[factor.axis] > 0)
    {
      isLower = factor.dimension == 1 ? lowerAlong(factor.axis, tolerance, polynomial)
                                      : lowerIn(factor, tolerance, polynomial);
    }
  }
  return polynomial;
}

ScaledPolynomial derivative(const ScaledPolynomial& polynomial, int axis)
{
  const Domain domain = polynomial.domain;
  const SimplexFactor& factor = factorOf(domain, axis);
  ScaledPolynomial result{ domain, polynomial.degrees, {} };
  if (polynomial.degrees[axis] == 0)
  {
    result.values.assign(polynomial.values.size(), 0.0);
    return result;
  }
  result = oneDegreeLess(polynomial, factor);
  // In the scaled basis: d/du of s u^i v^j b^l, with b = 1 - u - v of degree l = p - i - j.
  const auto at = [&](const LatticePoint& place)
  { return polynomial.values[coefficientIndex(domain, polynomial.degrees, place)]; };
  auto value = result.values.begin();
  visitLatticePoints(domain, result.degrees,
    [&](const LatticePoint& point)
    {
      const std::array<int, 4> numbers = barycentric(factor, result.degrees, point);
      const int along = numbers[axis - factor.axis];
      const int rest = numbers[factor.dimension];
      const LatticePoint next = oneMore(factor, point, axis - factor.axis);
      *value++ = (along + 1) * at(next) - (rest + 1) * at(point);
    });
  return result;
}

bool isZero(const ScaledPolynomial& polynomial)
{
  return std::all_of(
    polynomial.values.begin(), polynomial.values.end(), [](double value) { return value == 0.0; });
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
      addProduct(factor, elevated(*term, sum.degrees), one(domain, { 0, 0, 0 }), sum);
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
  // A row of a times a row of b goes to one row of the sum.
  const double* left = a.values.data();
  visitLatticeRows(a.domain, a.degrees,
    [&](int leftJ, int leftK, int leftCount)
    {
      const double* right = b.values.data();
      visitLatticeRows(b.domain, b.degrees,
        [&](int rightJ, int rightK, int rightCount)
        {
          double* out = &sum.values[coefficientIndex(
            sum.domain, sum.degrees, { 0, leftJ + rightJ, leftK + rightK })];
          for (int i = 0; i < leftCount; ++i)
          {
            const double scale = factor * left[i];
            for (int n = 0; n < rightCount; ++n)
            {
              out[i + n] += scale * right[n];
            }
          }
          right += rightCount;
        });
      left += leftCount;
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
