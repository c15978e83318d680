#include "Elements/BernsteinProduct.h"

#include "Elements/LatticeRows.h"
#include "Kernel/InstructionSet.h"

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

/// Highest degree of any polynomial here: those of a Jacobian determinant times a weight are the highest, and half as high.
constexpr int MaximumKeptDegree = 2 * MaximumPolynomialDegree;

/// Binomial coefficients n over k, 0 <= k <= n <= MaximumKeptDegree: looked up for every coefficient of every polynomial.
class BinomialTable
{
public:
  BinomialTable()
  {
    for (int n = 0; n <= MaximumKeptDegree; ++n)
    {
      for (int k = 0; k <= n; ++k)
      {
        this->Rows[n][k] = computedBinomial(n, k);
      }
    }
  }

  const double* row(int n) const { return this->Rows[n].data(); }

private:
  std::array<std::array<double, MaximumKeptDegree + 1>, MaximumKeptDegree + 1> Rows{};
};

/// n over 0, n over 1, ...
const double* binomials(int n)
{
  static const BinomialTable table;
  return table.row(n);
}

double binomial(int n, int k)
{
  return binomials(n)[k];
}

/// The multinomial factors of a row's basis functions, one a simplex of which the domain is the product, but for the
/// binomial coefficients along the row, which are those of its length less one: a! / (i! j! k!) = (a over k) (a - k over j)
/// (a - k - j over i).
double rowMultiplicity(Domain domain, const Degrees& degrees, int j, int k)
{
  switch (domain)
  {
    case Domain::Hexahedron:
    case Domain::Wedge:
      return binomial(degrees[1], j) * binomial(degrees[2], k);
    case Domain::Tetrahedron:
      return binomial(degrees[2], k) * binomial(degrees[1] - k, j);
  }
  unknownDomain();
}

/// Calls visit(multiplicity, value) for all coefficients: with the multinomial factor of a basis function.
template <class Value, class Visit>
void visitMultiplicities(Domain domain, const Degrees& degrees, Value* values, const Visit& visit)
{
  visitLatticeRows(domain, degrees,
    [&](int j, int k, int length)
    {
      const double ofRow = rowMultiplicity(domain, degrees, j, k);
      const double* alongRow = binomials(length - 1);
      for (int i = 0; i < length; ++i)
      {
        visit(ofRow * alongRow[i], values[i]);
      }
      values += length;
    });
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

/// Distance of coefficients that are neighbours on a line along an axis that is a factor of its own.
int stepAlong(const ScaledPolynomial& polynomial, int axis)
{
  return coefficientIndex(
    polynomial.domain, polynomial.degrees, { axis == 0, axis == 1, axis == 2 });
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

/// Whether some Bernstein coefficients of two polynomials of the same degrees differ by more than a tolerance.
bool differ(const ScaledPolynomial& a, const ScaledPolynomial& b, double tolerance)
{
  bool result = false;
  const double* other = b.values.data();
  visitMultiplicities(a.domain, a.degrees, a.values.data(),
    [&](double multiplicity, double value)
    { result = result || std::abs((value - *other++) / multiplicity) > tolerance; });
  return result;
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

ScaledPolynomial scaled(Domain domain, const Degrees& degrees, std::vector<double> coefficients)
{
  visitMultiplicities(domain, degrees, coefficients.data(),
    [](double multiplicity, double& value) { value *= multiplicity; });
  return { domain, degrees, std::move(coefficients) };
}

std::vector<double> unscaled(ScaledPolynomial polynomial)
{
  visitMultiplicities(polynomial.domain, polynomial.degrees, polynomial.values.data(),
    [](double multiplicity, double& value) { value /= multiplicity; });
  return std::move(polynomial.values);
}

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
