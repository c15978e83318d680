#include "Elements/Bernstein.h"

#include "Elements/KernelAccess.h"

namespace hop
{
namespace
{

/// Basis functions of a line, at most.
constexpr int MaximumLine = MaximumPolynomialDegree + 1;

// The kernels write a jet as 40 doubles, a gradient as the first 16 of them.
static_assert(sizeof(Jet) == 40 * sizeof(double));

/// p! / (i! j! ... n!), where n is what the parts i, j, ... leave of p.
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

} // namespace

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
      case Domain::Hexahedron:
        basis[index] = bu[i] * bv[j] * bw[k];
        break;
      case Domain::Tetrahedron:
        basis[index] = multinomial(p, { i, j, k }) * power(t.x, i) * power(t.y, j) * power(t.z, k) *
          power(1.0 - t.x - t.y - t.z, p - i - j - k);
        break;
      case Domain::Wedge:
        basis[index] = multinomial(p, { i, j }) * power(t.x, i) * power(t.y, j) *
          power(1.0 - t.x - t.y, p - i - j) * bw[k];
        break;
    }
    ++index;
  }
}

Range fieldRange(const BernsteinForm& form)
{
  const int count = coefficientCount(form.domain, form.degrees);
  Range range{ controlPoint(form, 0).w, controlPoint(form, 0).w };
  for (int i = 1; i < count; ++i)
  {
    range.include(controlPoint(form, i).w);
  }
  return range;
}

} // namespace hop
