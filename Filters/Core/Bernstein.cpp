#include "Bernstein.h"

#include <algorithm>

namespace hop
{
namespace
{

constexpr int MaximumLine = MaximumDegree + 1;
constexpr int MaximumTriangle = (MaximumDegree + 1) * (MaximumDegree + 2) / 2;
constexpr int MaximumTetrahedron = MaximumTriangle * (MaximumDegree + 3) / 3;

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

/// Derivatives of degree-p polynomials from values of those one degree lower:
/// B'_i,p = p (B_{i-1,p-1} - B_{i,p-1}).
void differenceBasis(int p, const double* lower, double* derivative)
{
  derivative[0] = -p * lower[0];
  for (int i = 1; i < p; ++i)
  {
    derivative[i] = p * (lower[i - 1] - lower[i]);
  }
  derivative[p] = p * lower[p - 1];
}

/// Value, first and second derivative of the univariate basis at one coordinate.
struct LineJet
{
  double order[3][MaximumLine];

  LineJet(int p, double t)
  {
    double lower[MaximumLine]{};
    double lowest[MaximumLine]{};
    lineBasis(p, t, this->order[0]);
    lineBasis(p - 1, t, lower);
    differenceBasis(p, lower, this->order[1]);
    if (p == 1)
    {
      this->order[2][0] = this->order[2][1] = 0.0;
      return;
    }
    lineBasis(p - 2, t, lowest);
    differenceBasis(p - 1, lowest, lower);
    differenceBasis(p, lower, this->order[2]);
  }
};

Coefficient contract(const double* basis, const Coefficient* values, int count)
{
  Coefficient sum = basis[0] * values[0];
  for (int i = 1; i < count; ++i)
  {
    sum += basis[i] * values[i];
  }
  return sum;
}

/// Sum factorisation, one coordinate after the other. Order = 1: gradient, 2: Hessian.
template <int Order>
Jet hexahedronJet(const BernsteinForm& form, const ReferencePoint& u)
{
  const auto [p, q, r] = form.degrees;
  const LineJet bu(p, u.xyz.x), bv(q, u.xyz.y), bw(r, u.xyz.z);

  // [order in u][order in v][k]; combinations beyond total order `Order` are not needed.
  Coefficient layers[Order + 1][Order + 1][MaximumLine];
  for (int k = 0; k <= r; ++k)
  {
    Coefficient rows[Order + 1][MaximumLine];
    for (int j = 0; j <= q; ++j)
    {
      const Coefficient* row = form.coefficients + (p + 1) * (j + (q + 1) * k);
      for (int a = 0; a <= Order; ++a)
      {
        rows[a][j] = contract(bu.order[a], row, p + 1);
      }
    }
    for (int a = 0; a <= Order; ++a)
    {
      for (int b = 0; a + b <= Order; ++b)
      {
        layers[a][b][k] = contract(bv.order[b], rows[a], q + 1);
      }
    }
  }
  const auto finish = [&](int a, int b, int c)
  { return contract(bw.order[c], layers[a][b], r + 1); };

  Jet jet;
  jet.value = finish(0, 0, 0);
  jet.first = { finish(1, 0, 0), finish(0, 1, 0), finish(0, 0, 1) };
  if constexpr (Order == 2)
  {
    jet.second = { finish(2, 0, 0), finish(1, 1, 0), finish(1, 0, 1), finish(0, 2, 0),
      finish(0, 1, 1), finish(0, 0, 2) };
  }
  return jet;
}

/// One step of de Casteljau's algorithm on a triangle, in place: degree p to p - 1.
void reduceTriangle(int p, const double (&b)[3], Coefficient* c)
{
  int source = 0;
  int target = 0;
  for (int j = 0; j < p; ++j)
  {
    const int above = source + p + 1 - j;
    for (int i = 0; i < p - j; ++i)
    {
      c[target++] = b[0] * c[source + i] + b[1] * c[source + i + 1] + b[2] * c[above + i];
    }
    source = above;
  }
}

/// Value and derivatives on a triangle: de Casteljau's algorithm down to degree two holds them all.
/// Order of results: value, u, v, uu, uv, vv.
template <int Order>
void triangleJet(int p, double u, double v, const Coefficient* coefficients, Coefficient (&jet)[6])
{
  const double b[3] = { 1.0 - u - v, u, v };
  Coefficient c[MaximumTriangle];
  std::copy_n(coefficients, (p + 1) * (p + 2) / 2, c);
  for (int degree = p; degree > 2; --degree)
  {
    reduceTriangle(degree, b, c);
  }
  std::fill(jet + 3, jet + 6, Coefficient(0.0));
  if (p > 1)
  {
    if constexpr (Order == 2)
    {
      const double scale = p * (p - 1);
      // The six coefficients stand at (0,0) (1,0) (2,0) (0,1) (1,1) (0,2).
      jet[3] = scale * (c[2] - 2.0 * c[1] + c[0]);
      jet[4] = scale * (c[4] - c[1] - c[3] + c[0]);
      jet[5] = scale * (c[5] - 2.0 * c[3] + c[0]);
    }
    reduceTriangle(2, b, c);
  }
  jet[0] = b[0] * c[0] + b[1] * c[1] + b[2] * c[2];
  jet[1] = static_cast<double>(p) * (c[1] - c[0]);
  jet[2] = static_cast<double>(p) * (c[2] - c[0]);
}

template <int Order>
Jet wedgeJet(const BernsteinForm& form, const ReferencePoint& u)
{
  const int p = form.degrees[0];
  const int r = form.degrees[2];
  const int layerSize = (p + 1) * (p + 2) / 2;
  const LineJet bw(r, u.xyz.z);
  Coefficient layers[6][MaximumLine];
  for (int k = 0; k <= r; ++k)
  {
    Coefficient layer[6];
    triangleJet<Order>(p, u.xyz.x, u.xyz.y, form.coefficients + layerSize * k, layer);
    for (int d = 0; d < 6; ++d)
    {
      layers[d][k] = layer[d];
    }
  }
  const auto finish = [&](int inTriangle, int inLine)
  { return contract(bw.order[inLine], layers[inTriangle], r + 1); };

  Jet jet;
  jet.value = finish(0, 0);
  jet.first = { finish(1, 0), finish(2, 0), finish(0, 1) };
  if constexpr (Order == 2)
  {
    jet.second = { finish(3, 0), finish(4, 0), finish(1, 1), finish(5, 0), finish(2, 1),
      finish(0, 2) };
  }
  return jet;
}

/// One step of de Casteljau's algorithm on a tetrahedron, in place: degree p to p - 1.
void reduceTetrahedron(int p, const double (&b)[4], Coefficient* c)
{
  int source = 0;
  int target = 0;
  for (int k = 0; k < p; ++k)
  {
    const int layer = p - k;
    int above = source + (layer + 1) * (layer + 2) / 2;
    const int nextLayer = above;
    for (int j = 0; j < layer; ++j)
    {
      const int nextRow = source + layer + 1 - j;
      for (int i = 0; i < layer - j; ++i)
      {
        c[target++] = b[0] * c[source + i] + b[1] * c[source + i + 1] + b[2] * c[nextRow + i] +
          b[3] * c[above + i];
      }
      source = nextRow;
      above += layer - j;
    }
    source = nextLayer;
  }
}

template <int Order>
Jet tetrahedronJet(const BernsteinForm& form, const ReferencePoint& u)
{
  const int p = form.degrees[0];
  const double b[4] = { 1.0 - u.xyz.x - u.xyz.y - u.xyz.z, u.xyz.x, u.xyz.y, u.xyz.z };
  Coefficient c[MaximumTetrahedron];
  std::copy_n(form.coefficients, coefficientCount(form.domain, form.degrees), c);
  for (int degree = p; degree > 2; --degree)
  {
    reduceTetrahedron(degree, b, c);
  }
  Jet jet;
  if (p > 1)
  {
    if constexpr (Order == 2)
    {
      // The ten coefficients stand at (000) (100) (200) (010) (110) (020) (001) (101) (011) (002).
      const double scale = p * (p - 1);
      jet.second = { scale * (c[2] - 2.0 * c[1] + c[0]), scale * (c[4] - c[1] - c[3] + c[0]),
        scale * (c[7] - c[1] - c[6] + c[0]), scale * (c[5] - 2.0 * c[3] + c[0]),
        scale * (c[8] - c[3] - c[6] + c[0]), scale * (c[9] - 2.0 * c[6] + c[0]) };
    }
    reduceTetrahedron(2, b, c);
  }
  const double scale = p;
  jet.value = b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3];
  jet.first = { scale * (c[1] - c[0]), scale * (c[2] - c[0]), scale * (c[3] - c[0]) };
  return jet;
}

template <int Order>
Jet polynomialJet(const BernsteinForm& form, const ReferencePoint& u)
{
  switch (form.domain)
  {
    case Domain::Tetrahedron:
      return tetrahedronJet<Order>(form, u);
    case Domain::Wedge:
      return wedgeJet<Order>(form, u);
    default:
      return hexahedronJet<Order>(form, u);
  }
}

/// The weights of a rational element as an element of their own; f holds the weight.
template <int Order>
Jet weightJet(const BernsteinForm& form, const ReferencePoint& u)
{
  constexpr int maximumCount = MaximumLine * MaximumLine * MaximumLine;
  static_assert(
    maximumCount >= MaximumTetrahedron && maximumCount >= MaximumTriangle * MaximumLine);
  Coefficient weights[maximumCount];
  const int count = coefficientCount(form.domain, form.degrees);
  for (int i = 0; i < count; ++i)
  {
    weights[i] = Coefficient(form.weights[i]);
  }
  return polynomialJet<Order>({ form.domain, form.degrees, weights, nullptr }, u);
}

/// Quotient rule: with A = w R, R_a = (A_a - w_a R) / w and
/// R_ab = (A_ab - w_a R_b - w_b R_a - w_ab R) / w.
Jet quotient(const Jet& a, const Jet& w)
{
  constexpr int row[6] = { 0, 0, 0, 1, 1, 2 };
  constexpr int column[6] = { 0, 1, 2, 1, 2, 2 };
  Jet jet;
  jet.value = a.value / w.value;
  for (int i = 0; i < 3; ++i)
  {
    jet.first[i] = (a.first[i] - w.first[i] * jet.value) / w.value;
  }
  for (int i = 0; i < 6; ++i)
  {
    jet.second[i] = (a.second[i] - w.first[row[i]] * jet.first[column[i]] -
                      w.first[column[i]] * jet.first[row[i]] - w.second[i] * jet.value) /
      w.value;
  }
  return jet;
}

template <int Order>
Jet evaluate(const BernsteinForm& form, const ReferencePoint& u)
{
  const Jet jet = polynomialJet<Order>(form, u);
  if (!form.weights)
  {
    return jet;
  }
  Jet rational = quotient(jet, weightJet<Order>(form, u));
  if constexpr (Order < 2)
  {
    rational.second = {};
  }
  return rational;
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

} // namespace

Jet evaluateGradient(const BernsteinForm& form, const ReferencePoint& u)
{
  return evaluate<1>(form, u);
}

Jet evaluateHessian(const BernsteinForm& form, const ReferencePoint& u)
{
  return evaluate<2>(form, u);
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
