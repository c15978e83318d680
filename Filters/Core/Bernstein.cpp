#include "Bernstein.h"

#include "KernelAccess.h"

#include <algorithm>

namespace hop
{
namespace
{

constexpr int MaximumLine = MaximumDegree + 1;

// The kernels write a jet as 40 doubles, a gradient as the first 16 of them.
static_assert(sizeof(Jet) == 40 * sizeof(double));

/// Values of the univariate Bernstein polynomials of degree p at t.
void lineBasis(int p, double t, double* basis)
{
  basis[0] = 1.0;
  for (int n = 1; n <= p; ++n)
  {
    basis[n] = t * basis[n - 1];
    for (int i = n - 1; i > 0; --i)
    {
      basis[i] = (1.0 - t) * basis[i] + t * basis[i - 1];
    }
    basis[0] *= 1.0 - t;
  }
}

/// p! / (i! j! ...) with the rest of p in the last place.
double multinomial(int p, std::initializer_list<int> parts)
{
  double result = 1.0;
  int n = p;
  for (int part : parts)
  {
    for (int i = 1; i <= part; ++i, --n)
    {
      result *= static_cast<double>(n) / i;
    }
  }
  return result;
}

double power(double base, int exponent)
{
  double result = 1.0;
  for (int i = 0; i < exponent; ++i)
  {
    result *= base;
  }
  return result;
}

/// Values along one lattice line, halved: `line` keeps the first half, `rest` gets the second.
template <class Value>
void halve(std::vector<Value>& line, std::vector<Value>& rest)
{
  const std::size_t n = line.size();
  rest.resize(n);
  for (std::size_t step = 0; step < n; ++step)
  {
    rest[n - 1 - step] = line[n - 1];
    for (std::size_t i = n - 1; i > step; --i)
    {
      line[i] = 0.5 * (line[i] + line[i - 1]);
    }
  }
}

} // namespace

Jet evaluateGradient(const BernsteinForm& form, const ReferencePoint& u)
{
  Jet jet;
  kernelsOf(form.domain).gradient(plainElement(form), &u.xyz.x, &jet.value.x);
  return jet;
}

Jet evaluateHessian(const BernsteinForm& form, const ReferencePoint& u)
{
  Jet jet;
  kernelsOf(form.domain).hessian(plainElement(form), &u.xyz.x, &jet.value.x);
  return jet;
}

void evaluateBasis(Domain domain, const Degrees& degrees, const ReferencePoint& u, double* basis)
{
  const auto [p, q, r] = degrees;
  const glm::dvec3& t = u.xyz;
  double bu[MaximumLine], bv[MaximumLine], bw[MaximumLine];
  lineBasis(p, t.x, bu);
  lineBasis(q, t.y, bv);
  lineBasis(r, t.z, bw);
  int index = 0;
  for (const auto& [i, j, k] : latticePoints(domain, degrees))
  {
    switch (domain)
    {
      case Domain::Tetrahedron:
        basis[index] = multinomial(p, { i, j, k }) * power(t.x, i) * power(t.y, j) * power(t.z, k) *
          power(1.0 - t.x - t.y - t.z, p - i - j - k);
        break;
      case Domain::Wedge:
        basis[index] = multinomial(p, { i, j }) * power(t.x, i) * power(t.y, j) *
          power(1.0 - t.x - t.y, p - i - j) * bw[k];
        break;
      default:
        basis[index] = bu[i] * bv[j] * bw[k];
    }
    ++index;
  }
}

template <class Value>
void bisect(Domain domain, const Degrees& degrees, const LatticePoint& direction,
  std::vector<Value>& coefficients, std::vector<Value>& second)
{
  second.resize(coefficients.size());
  std::vector<Value> line, rest;
  std::vector<int> where;
  for (const LatticePoint& start : latticePoints(domain, degrees))
  {
    const auto along = [&](int step)
    {
      return LatticePoint{ start.i + step * direction.i, start.j + step * direction.j,
        start.k + step * direction.k };
    };
    if (inLattice(domain, degrees, along(-1)))
    {
      continue; // not the first point of its line
    }
    line.clear();
    where.clear();
    for (int step = 0; inLattice(domain, degrees, along(step)); ++step)
    {
      where.push_back(coefficientIndex(domain, degrees, along(step)));
      line.push_back(coefficients[where.back()]);
    }
    halve(line, rest);
    for (std::size_t n = 0; n < where.size(); ++n)
    {
      coefficients[where[n]] = line[n];
      second[where[n]] = rest[n];
    }
  }
}

template void bisect(Domain, const Degrees&, const LatticePoint&, std::vector<Coefficient>&,
  std::vector<Coefficient>&);
template void bisect(
  Domain, const Degrees&, const LatticePoint&, std::vector<glm::dvec3>&, std::vector<glm::dvec3>&);
template void bisect(
  Domain, const Degrees&, const LatticePoint&, std::vector<double>&, std::vector<double>&);

Range fieldRange(const BernsteinForm& form)
{
  const int count = coefficientCount(form.domain, form.degrees);
  Range range{ controlPoint(form, 0).w, controlPoint(form, 0).w };
  for (int i = 1; i < count; ++i)
  {
    const double f = controlPoint(form, i).w;
    range.lower = std::min(range.lower, f);
    range.upper = std::max(range.upper, f);
  }
  return range;
}

} // namespace hop
