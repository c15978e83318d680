#include "Elements/ScaledPolynomial.h"

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

ScaledPolynomial one(Domain domain, const Degrees& degrees)
{
  return scaled(domain, degrees, std::vector<double>(coefficientCount(domain, degrees), 1.0));
}

bool isZero(const ScaledPolynomial& polynomial)
{
  return std::all_of(
    polynomial.values.begin(), polynomial.values.end(), [](double value) { return value == 0.0; });
}

bool differ(const ScaledPolynomial& a, const ScaledPolynomial& b, double tolerance)
{
  bool result = false;
  const double* other = b.values.data();
  visitMultiplicities(a.domain, a.degrees, a.values.data(),
    [&](double multiplicity, double value)
    { result = result || std::abs((value - *other++) / multiplicity) > tolerance; });
  return result;
}

int stepAlong(const ScaledPolynomial& polynomial, int axis)
{
  return coefficientIndex(
    polynomial.domain, polynomial.degrees, { axis == 0, axis == 1, axis == 2 });
}

double binomial(int n, int k)
{
  return binomials(n)[k];
}

} // namespace hop
