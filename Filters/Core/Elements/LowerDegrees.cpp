#include "Elements/LowerDegrees.h"

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

/// The lines of a polynomial along an axis that is a factor of its own, from which degrees are taken away. Row i holds
/// coefficient i of all lines, so that lines are computed side by side.
class LineRows
{
public:
  LineRows(const ScaledPolynomial& polynomial, int axis);

  /// Takes one degree away if no Bernstein coefficient changes by more than a tolerance.
  /// \pre degree() > 0
  bool lower(double tolerance);

  int degree() const { return static_cast<int>(this->Rows.size()) - 1; }
  ScaledPolynomial polynomial() const;

private:
  void findDifferences();
  double changeToLowerDegree() const;
  void takeNearestOfLowerDegree();
  void divideByOne();

  /// Lines between neighbours of one line.
  std::size_t Step;
  int Axis;
  Domain ItsDomain;
  Degrees Ends;
  /// Of the lines' first coefficients.
  std::vector<double> Multiplicities;
  std::vector<double> Values;
  std::vector<double*> Rows;
  /// The n-th difference of each line's coefficients.
  std::vector<double> Differences;
};

LineRows::LineRows(const ScaledPolynomial& polynomial, int axis)
  : Step(stepAlong(polynomial, axis))
  , Axis(axis)
  , ItsDomain(polynomial.domain)
  , Ends(polynomial.degrees)
  , Values(polynomial.values.size())
{
  const std::size_t count = polynomial.degrees[axis] + 1;
  this->Ends[axis] = 0;
  this->Multiplicities = one(this->ItsDomain, this->Ends).values;
  const std::size_t lines = this->Multiplicities.size();
  this->Differences.resize(lines);
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Rows.push_back(&this->Values[i * lines]);
    for (std::size_t line = 0; line < lines; line += this->Step)
    {
      std::copy_n(&polynomial.values[line * count + i * this->Step], this->Step,
        &this->Values[i * lines + line]);
    }
  }
}

ScaledPolynomial LineRows::polynomial() const
{
  const std::size_t lines = this->Multiplicities.size();
  ScaledPolynomial result{ this->ItsDomain, this->Ends, {} };
  result.degrees[this->Axis] = this->degree();
  result.values.resize(lines * this->Rows.size());
  for (std::size_t i = 0; i < this->Rows.size(); ++i)
  {
    for (std::size_t line = 0; line < lines; line += this->Step)
    {
      std::copy_n(this->Rows[i] + line, this->Step,
        &result.values[line * this->Rows.size() + i * this->Step]);
    }
  }
  return result;
}

/// Sum of the squares of what nearestOfLowerDegree() takes away, as Bernstein coefficients.
double squaredNorm(int n)
{
  double norm2 = 0.0;
  for (int i = 0; i <= n; ++i)
  {
    norm2 += binomial(n, i) * binomial(n, i);
  }
  return norm2;
}

bool LineRows::lower(double tolerance)
{
  this->findDifferences();
  const bool isLower = !(this->changeToLowerDegree() > tolerance);
  if (isLower)
  {
    this->takeNearestOfLowerDegree();
    this->divideByOne();
  }
  return isLower;
}

void LineRows::findDifferences()
{
  std::fill(this->Differences.begin(), this->Differences.end(), 0.0);
  for (int i = 0; i <= this->degree(); ++i)
  {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const double* row = this->Rows[i];
    for (std::size_t line = 0; line < this->Differences.size(); ++line)
    {
      this->Differences[line] += sign * row[line];
    }
  }
}

/// Largest change of a Bernstein coefficient by takeNearestOfLowerDegree().
double LineRows::changeToLowerDegree() const
{
  const int n = this->degree();
  double largest = 0.0;
  for (std::size_t line = 0; line < this->Differences.size(); ++line)
  {
    largest = std::max(largest, std::abs(this->Differences[line]) / this->Multiplicities[line]);
  }
  return largest * binomial(n, n / 2) / squaredNorm(n);
}

/// The nearest polynomials of one degree less, still written with all coefficients. Of degree n - 1 are the coefficients
/// whose n-th difference is zero: what is taken away is a multiple of (-1)^i C(n,i) (Lutterkort, Peters and Reif 1999,
/// Polynomial degree reduction in the L2-norm equals best Euclidean approximation of Bezier coefficients). In the scaled
/// basis the coefficients are C(n,i) a_i, and what is taken away is a multiple of (-1)^i C(n,i)^2.
void LineRows::takeNearestOfLowerDegree()
{
  const int n = this->degree();
  const double norm2 = squaredNorm(n);
  for (int i = 0; i <= n; ++i)
  {
    const double share = (i % 2 == 0 ? 1.0 : -1.0) * binomial(n, i) * binomial(n, i) / norm2;
    double* row = this->Rows[i];
    for (std::size_t line = 0; line < this->Differences.size(); ++line)
    {
      row[line] -= share * this->Differences[line];
    }
  }
}

/// dividedByOne() along all lines: from both of their ends to the middle, where a row is left over.
void LineRows::divideByOne()
{
  const int n = this->degree();
  const auto subtract = [this](int from, int what)
  {
    double* row = this->Rows[from];
    const double* other = this->Rows[what];
    for (std::size_t line = 0; line < this->Differences.size(); ++line)
    {
      row[line] -= other[line];
    }
  };
  const int middle = n / 2;
  for (int i = n - 1; i > middle; --i)
  {
    subtract(i, i + 1);
  }
  for (int i = 1; i < middle; ++i)
  {
    subtract(i, i - 1);
  }
  this->Rows.erase(this->Rows.begin() + middle);
}

/// Takes degrees away along an axis that is a factor of its own, as long as no step changes a coefficient by more than a
/// tolerance.
ScaledPolynomial loweredAlong(int axis, double tolerance, ScaledPolynomial polynomial)
{
  if (polynomial.degrees[axis] == 0)
  {
    return polynomial;
  }
  LineRows rows(polynomial, axis);
  while (rows.degree() > 0 && rows.lower(tolerance))
  {
  }
  return rows.degree() < polynomial.degrees[axis] ? rows.polynomial() : std::move(polynomial);
}

/// Takes one degree away in a triangle or tetrahedron, if no coefficient changes by more than a tolerance.
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

/// In the scaled basis: d/du of s u^i v^j b^l, with b = 1 - u - v of degree l = p - i - j.
void differentiateIn(const SimplexFactor& factor, const ScaledPolynomial& polynomial, int axis,
  ScaledPolynomial& result)
{
  const auto at = [&](const LatticePoint& place)
  { return polynomial.values[coefficientIndex(polynomial.domain, polynomial.degrees, place)]; };
  auto value = result.values.begin();
  visitLatticePoints(result.domain, result.degrees,
    [&](const LatticePoint& point)
    {
      const std::array<int, 4> numbers = barycentric(factor, result.degrees, point);
      const int along = numbers[axis - factor.axis];
      const int rest = numbers[factor.dimension];
      const LatticePoint next = oneMore(factor, point, axis - factor.axis);
      *value++ = (along + 1) * at(next) - (rest + 1) * at(point);
    });
}

/// The same along an axis that is a factor of its own.
void differentiateLines(const ScaledPolynomial& polynomial, int axis, ScaledPolynomial& result)
{
  const int step = stepAlong(polynomial, axis);
  const int n = polynomial.degrees[axis];
  const double* from = polynomial.values.data();
  auto value = result.values.begin();
  while (value != result.values.end())
  {
    for (int i = 0; i < n; ++i)
    {
      for (int line = 0; line < step; ++line, ++from)
      {
        *value++ = (i + 1) * from[step] - (n - i) * from[0];
      }
    }
    from += step;
  }
}

} // namespace

ScaledPolynomial lowered(ScaledPolynomial polynomial, double tolerance)
{
  for (const SimplexFactor& factor : facts(polynomial.domain).factors)
  {
    if (factor.dimension == 1)
    {
      polynomial = loweredAlong(factor.axis, tolerance, std::move(polynomial));
      continue;
    }
    while (polynomial.degrees[factor.axis] > 0 && lowerIn(factor, tolerance, polynomial))
    {
    }
  }
  return polynomial;
}

ScaledPolynomial derivative(const ScaledPolynomial& polynomial, int axis)
{
  const SimplexFactor& factor = factorOf(polynomial.domain, axis);
  if (polynomial.degrees[axis] == 0)
  {
    return { polynomial.domain, polynomial.degrees,
      std::vector<double>(polynomial.values.size(), 0.0) };
  }
  ScaledPolynomial result = oneDegreeLess(polynomial, factor);
  if (factor.dimension == 1)
  {
    differentiateLines(polynomial, axis, result);
  }
  else
  {
    differentiateIn(factor, polynomial, axis, result);
  }
  return result;
}

} // namespace hop
