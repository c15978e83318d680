#pragma once

#include "Kernel/LineBasis.h"

// Simplices are evaluated in two steps. Blossoming all but the last `Order` levels of de Casteljau's
// algorithm leaves a control net of degree `Order` with the value and all derivatives up to that
// order at the point: net_m = sum over |a| = p - Order of B_a c_(a + m). Instead of running the
// levels one by one, the basis of degree p - Order is computed once for all components (and all
// layers of a wedge).
namespace hop::kernel
{
namespace
{

/// Most basis functions of a triangle and of a tetrahedron.
constexpr int MaximumTriangle = (MaximumDegree + 1) * (MaximumDegree + 2) / 2;
constexpr int MaximumTetrahedron = MaximumTriangle * (MaximumDegree + 3) / 3;

/// Basis functions of a triangle.
constexpr int triangleCount(int degree)
{
  return (degree + 1) * (degree + 2) / 2;
}

/// value[n][k] = n over k, by Pascal's triangle.
struct Binomials
{
  double value[MaximumLine][MaximumLine] = {};

  constexpr Binomials()
  {
    for (int n = 0; n <= MaximumDegree; ++n)
    {
      this->value[n][0] = 1.0;
      for (int k = 1; k <= n; ++k)
      {
        this->value[n][k] = this->value[n - 1][k - 1] + this->value[n - 1][k];
      }
    }
  }
};

constexpr Binomials binomials;

/// Row n, entry i at n (n + 1) / 2 + i: C(n, i) u^i b^(n - i) for all n up to the degree.
template <class Number>
inline void homogeneousLines(int degree, Number b, Number u, Number* lines)
{
  lines[0] = Number{} + 1.0;
  for (int n = 1; n <= degree; ++n)
  {
    const Number* lower = lines;
    lines += n;
    lines[0] = b * lower[0];
    for (int i = 1; i < n; ++i)
    {
      lines[i] = b * lower[i] + u * lower[i - 1];
    }
    lines[n] = u * lower[n - 1];
  }
}

/// The part of a simplex' basis with third index k, i fastest, then j. `scale` is
/// C(degree, k) w^k. \return the end of what was written
template <class Number>
inline Number* basisLayer(
  int degree, int k, const Number* lines, Number v, Number scale, Number* basis)
{
  const int layerDegree = degree - k;
  Number power = scale;
  for (int j = 0; j <= layerDegree; ++j)
  {
    const int n = layerDegree - j;
    const Number factor = binomials.value[layerDegree][j] * power;
    for (int i = 0; i <= n; ++i)
    {
      basis[i] = factor * lines[n * (n + 1) / 2 + i];
    }
    basis += n + 1;
    power *= v;
  }
  return basis;
}

template <class Number>
inline void triangleBasis(int degree, const Number* u, Number* basis)
{
  Number lines[MaximumTriangle];
  homogeneousLines(degree, Number(1.0 - u[0] - u[1]), u[0], lines);
  basisLayer(degree, 0, lines, u[1], Number{} + 1.0, basis);
}

template <class Number>
inline void tetrahedronBasis(int degree, const Number* u, Number* basis)
{
  Number lines[MaximumTriangle];
  homogeneousLines(degree, Number(1.0 - u[0] - u[1] - u[2]), u[0], lines);
  Number power = Number{} + 1.0;
  for (int k = 0; k <= degree; ++k)
  {
    basis = basisLayer(degree, k, lines, u[1], Number(binomials.value[degree][k] * power), basis);
    power *= u[2];
  }
}

/// How many components are summed in one pass.
constexpr int componentsAtOnce(int components, int netSize)
{
  // Sums that stay in registers: processors up to AVX2 have 16 of them, of which four are left for basis functions and
  // coefficients. With more sums, some are written to memory in each step; with fewer, the basis is read more often.
  constexpr int mostSums = 12;
  int atOnce = components;
  while (atOnce * netSize > mostSums && atOnce > 1)
  {
    atOnce /= 2;
  }
  return atOnce;
}

/// Adds a row of basis functions to the net.
/// \param starts index of the first coefficient under each point of the net
template <class Layout, int Size, int AtOnce>
inline void addRow(const typename Layout::Basis* basis, int count, const double* coefficients,
  const int (&starts)[Size], int firstComponent, typename Layout::Sum (&sum)[Size][AtOnce])
{
  for (int i = 0; i < count; ++i)
  {
    for (int m = 0; m < Size; ++m)
    {
      for (int c = 0; c < AtOnce; ++c)
      {
        const int index = (starts[m] + i) * Layout::components + firstComponent + c;
        sum[m][c] += basis[i] * Layout::load(coefficients, index);
      }
    }
  }
}

/// Points of a triangular net: (0,0) (1,0) [(2,0)] (0,1) [(1,1) (0,2)].
template <int Order>
constexpr int triangleNetSize = Order == 2 ? 6 : 3;

template <class Layout, int Order>
inline void triangleNet(int p, const typename Layout::Basis* basis, const double* coefficients,
  typename Layout::Sum (&net)[triangleNetSize<Order>][Layout::components])
{
  constexpr int size = triangleNetSize<Order>;
  constexpr int atOnce = componentsAtOnce(Layout::components, size);
  for (int first = 0; first < Layout::components; first += atOnce)
  {
    typename Layout::Sum sum[size][atOnce] = {};
    const typename Layout::Basis* rowBasis = basis;
    int row = 0;
    for (int j = 0; j <= p - Order; ++j)
    {
      const int next = row + p + 1 - j;
      const int count = p - Order - j + 1;
      if constexpr (Order == 2)
      {
        addRow<Layout>(rowBasis, count, coefficients,
          { row, row + 1, row + 2, next, next + 1, next + p - j }, first, sum);
      }
      else
      {
        addRow<Layout>(rowBasis, count, coefficients, { row, row + 1, next }, first, sum);
      }
      rowBasis += count;
      row = next;
    }
    for (int m = 0; m < size; ++m)
    {
      for (int c = 0; c < atOnce; ++c)
      {
        net[m][first + c] = sum[m][c];
      }
    }
  }
}

/// Points of a tetrahedral net: the triangular one, then (0,0,1) [(1,0,1) (0,1,1) (0,0,2)].
template <int Order>
constexpr int tetrahedronNetSize = Order == 2 ? 10 : 4;

template <class Layout, int Order>
inline void tetrahedronNet(int p, const typename Layout::Basis* basis, const double* coefficients,
  typename Layout::Sum (&net)[tetrahedronNetSize<Order>][Layout::components])
{
  constexpr int size = tetrahedronNetSize<Order>;
  constexpr int atOnce = componentsAtOnce(Layout::components, size);
  for (int first = 0; first < Layout::components; first += atOnce)
  {
    typename Layout::Sum sum[size][atOnce] = {};
    const typename Layout::Basis* rowBasis = basis;
    int layer = 0;
    for (int k = 0; k <= p - Order; ++k)
    {
      const int n = p - k;
      int row = layer;
      // Rows of the same j one and two layers up.
      int above = layer + triangleCount(n);
      int highest = above + triangleCount(n - 1);
      layer = above;
      for (int j = 0; j <= n - Order; ++j)
      {
        const int next = row + n + 1 - j;
        const int count = n - Order - j + 1;
        if constexpr (Order == 2)
        {
          addRow<Layout>(rowBasis, count, coefficients,
            { row, row + 1, row + 2, next, next + 1, next + n - j, above, above + 1, above + n - j,
              highest },
            first, sum);
        }
        else
        {
          addRow<Layout>(rowBasis, count, coefficients, { row, row + 1, next, above }, first, sum);
        }
        rowBasis += count;
        row = next;
        above += n - j;
        highest += n - 1 - j;
      }
    }
    for (int m = 0; m < size; ++m)
    {
      for (int c = 0; c < atOnce; ++c)
      {
        net[m][first + c] = sum[m][c];
      }
    }
  }
}

} // namespace
} // namespace hop::kernel
