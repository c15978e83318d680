#pragma once

#include "Kernel/Kernels.h"

namespace hop::kernel
{
namespace
{

/// Most basis functions along a line.
constexpr int MaximumLine = MaximumDegree + 1;

/// Degree n - 1 to n of the univariate Bernstein basis: B_i,n = (1 - t) B_i,n-1 + t B_i-1,n-1.
/// basis[-1] and basis[n] are zero before.
template <class Number>
inline void raise(int n, Number t, Number* basis)
{
  const Number s = 1.0 - t;
  for (int i = n; i >= 0; --i)
  {
    basis[i] = s * basis[i] + t * basis[i - 1];
  }
}

/// Univariate Bernstein polynomials of degree p at t with derivatives up to Order:
/// B'_i,p = p (B_i-1,p-1 - B_i,p-1), and once more for B''.
/// \tparam Degree p where the compiler shall know it, else 0
template <class Number, int Order, int Degree>
class LineBasis
{
public:
  /// Derivative `order` of basis function i.
  const Number& operator()(int order, int i) const { return this->Orders[order][i]; }

  LineBasis(int degree, Number t)
  {
    const int p = Degree ? Degree : degree;
    Number padded[MaximumLine + 2];
    for (int i = 0; i < p + 3; ++i)
    {
      padded[i] = Number{};
    }
    Number* basis = padded + 2;
    basis[0] += 1.0;
    for (int n = 1; n < p; ++n)
    {
      if (Order == 2 && n == p - 1)
      {
        this->setSecond(p, basis);
      }
      raise(n, t, basis);
    }
    for (int i = 0; i <= p; ++i)
    {
      this->Orders[1][i] = static_cast<double>(p) * (basis[i - 1] - basis[i]);
    }
    raise(p, t, basis);
    for (int i = 0; i <= p; ++i)
    {
      this->Orders[0][i] = basis[i];
    }
    if (Order == 2 && p == 1)
    {
      this->Orders[Order][0] = this->Orders[Order][1] = Number{};
    }
  }

private:
  Number Orders[Order + 1][MaximumLine];

  void setSecond(int p, const Number* lowest)
  {
    const double scale = p * (p - 1);
    for (int i = 0; i <= p; ++i)
    {
      this->Orders[Order][i] = scale * (lowest[i - 2] - 2.0 * lowest[i - 1] + lowest[i]);
    }
  }
};

/// result[a][c] = sum over i of basis(a, i) values(i, c), for `Orders` rows of the basis at once.
template <int Orders, class Basis, class Sum, int Components, class Values>
inline void contract(
  const Basis& basis, int count, const Values& values, Sum (&result)[Orders][Components])
{
  // Sums start at zero rather than at the first term: the terms of i = 0 would be kept in registers that the sums need.
  Sum sum[Orders][Components] = {};
  for (int i = 0; i < count; ++i)
  {
    for (int c = 0; c < Components; ++c)
    {
      const auto value = values(i, c);
      for (int a = 0; a < Orders; ++a)
      {
        sum[a][c] += basis(a, i) * value;
      }
    }
  }
  for (int a = 0; a < Orders; ++a)
  {
    for (int c = 0; c < Components; ++c)
    {
      result[a][c] = sum[a][c];
    }
  }
}

} // namespace
} // namespace hop::kernel
