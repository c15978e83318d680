#pragma once

#include "Kernel/SimplexNet.h"
#include "Kernel/TensorBasis.h"

// Jets of an element at one vector of points. `Degree` > 0: all degrees of the element are this,
// known to the compiler; 0: they are read from the element.
namespace hop::kernel
{
namespace
{

/// value, u, v, w [, uu, uv, uw, vv, vw, ww]
template <int Order>
constexpr int quantityCount = Order == 2 ? 10 : 4;

template <class Layout, int Order>
using Jet = typename Layout::Sum[quantityCount<Order>][Layout::components];

/// Where the derivative of order (a, b, c) in (u, v, w) stands in a jet.
constexpr int quantityOf(int a, int b, int c)
{
  constexpr int pure[3] = { 4, 7, 9 };
  switch (a + b + c)
  {
    case 0:
      return 0;
    case 1:
      return a ? 1 : b ? 2 : 3;
    default:
      return a == 2 ? pure[0] : b == 2 ? pure[1] : c == 2 ? pure[2] : !c ? 5 : !b ? 6 : 8;
  }
}

/// Contracts with the basis and its first `Orders - 1` derivatives; derivative order c goes to
/// target(c).
template <int Orders, class Layout, class Basis, class Values, class Target>
inline void contractInto(const Basis& basis, int count, const Values& values, const Target& target)
{
  typename Layout::Sum result[Orders][Layout::components];
  contract<Orders>(basis, count, values, result);
  for (int order = 0; order < Orders; ++order)
  {
    for (int c = 0; c < Layout::components; ++c)
    {
      target(order)[c] = result[order][c];
    }
  }
}

/// Sum factorisation, one coordinate after the other.
struct Hexahedron
{
  template <class Layout, int Order, int Degree>
  static void jet(const int (&degrees)[3], const double* coefficients,
    const typename Layout::Basis (&u)[3], Jet<Layout, Order>& jet)
  {
    const int p = Degree ? Degree : degrees[0];
    const int q = Degree ? Degree : degrees[1];
    const int r = Degree ? Degree : degrees[2];
    const TensorBasis<Layout, Order, Degree> basis(degrees, u);
    const auto& bu = basis.template along<0>();
    const auto& bv = basis.template along<1>();
    const auto& bw = basis.template along<2>();

    Planes<Layout, Order> planes;
    for (int k = 0; k <= r; ++k)
    {
      typename Layout::Sum rows[Order + 1][MaximumLine][Layout::components];
      for (int j = 0; j <= q; ++j)
      {
        const int row = (p + 1) * (j + (q + 1) * k) * Layout::components;
        contractInto<Order + 1, Layout>(
          bu, p + 1,
          [&](int i, int c)
          { return Layout::load(coefficients, row + i * Layout::components + c); },
          [&](int a) { return rows[a][j]; });
      }
      contractRows<Layout, Order>(bv, q + 1, rows, k, planes);
    }
    contractPlanes<Layout, Order>(bw, r + 1, planes, jet);
  }

private:
  /// [derivative order in u][in v][k]; entries beyond total order `Order` are not used.
  template <class Layout, int Order>
  using Planes = typename Layout::Sum[Order + 1][Order + 1][MaximumLine][Layout::components];

  template <class Layout, int Order, int A = 0, class Line, class Rows>
  static void contractRows(
    const Line& bv, int count, const Rows& rows, int k, Planes<Layout, Order>& planes)
  {
    contractInto<Order + 1 - A, Layout>(
      bv, count, [&](int j, int c) { return rows[A][j][c]; },
      [&](int b) { return planes[A][b][k]; });
    if constexpr (A < Order)
    {
      contractRows<Layout, Order, A + 1>(bv, count, rows, k, planes);
    }
  }

  template <class Layout, int Order, int A = 0, int B = 0, class Line>
  static void contractPlanes(
    const Line& bw, int count, const Planes<Layout, Order>& planes, Jet<Layout, Order>& jet)
  {
    contractInto<Order + 1 - A - B, Layout>(
      bw, count, [&](int k, int c) { return planes[A][B][k][c]; },
      [&](int order) { return jet[quantityOf(A, B, order)]; });
    if constexpr (A + B < Order)
    {
      contractPlanes<Layout, Order, A, B + 1>(bw, count, planes, jet);
    }
    else if constexpr (A < Order)
    {
      contractPlanes<Layout, Order, A + 1, 0>(bw, count, planes, jet);
    }
  }
};

struct Tetrahedron
{
  template <class Layout, int Order, int Degree>
  static void jet(const int (&degrees)[3], const double* coefficients,
    const typename Layout::Basis (&u)[3], Jet<Layout, Order>& jet)
  {
    const int p = Degree ? Degree : degrees[0];
    typename Layout::Basis basis[MaximumTetrahedron];
    typename Layout::Sum linear[4][Layout::components];
    if (p < Order)
    {
      tetrahedronBasis(0, u, basis);
      tetrahedronNet<Layout, 1>(p, basis, coefficients, linear);
      clearSecond<Layout, Order>(jet);
    }
    else
    {
      typename Layout::Sum net[tetrahedronNetSize<Order>][Layout::components];
      tetrahedronBasis(p - Order, u, basis);
      tetrahedronNet<Layout, Order>(p, basis, coefficients, net);
      for (int c = 0; c < Layout::components; ++c)
      {
        reduce<Layout, Order>(p, u, net, c, linear, jet);
      }
    }
    const typename Layout::Basis b = 1.0 - u[0] - u[1] - u[2];
    const double scale = p;
    for (int c = 0; c < Layout::components; ++c)
    {
      jet[0][c] =
        b * linear[0][c] + u[0] * linear[1][c] + u[1] * linear[2][c] + u[2] * linear[3][c];
      for (int axis = 0; axis < 3; ++axis)
      {
        jet[1 + axis][c] = scale * (linear[1 + axis][c] - linear[0][c]);
      }
    }
  }

private:
  template <class Layout, int Order>
  static void clearSecond(Jet<Layout, Order>& jet)
  {
    for (int quantity = 4; quantity < quantityCount<Order>; ++quantity)
    {
      for (int c = 0; c < Layout::components; ++c)
      {
        jet[quantity][c] = typename Layout::Sum{};
      }
    }
  }

  /// Second derivatives from a quadratic net, and the net one degree lower.
  template <class Layout, int Order, class Net, class Linear>
  static void reduce(int p, const typename Layout::Basis (&u)[3], const Net& net, int c,
    Linear& linear, Jet<Layout, Order>& jet)
  {
    if constexpr (Order == 1)
    {
      for (int m = 0; m < 4; ++m)
      {
        linear[m][c] = net[m][c];
      }
    }
    else
    {
      const typename Layout::Basis b = 1.0 - u[0] - u[1] - u[2];
      // Corner m of the linear net lies between these of the quadratic one.
      constexpr int between[4][4] = { { 0, 1, 3, 6 }, { 1, 2, 4, 7 }, { 3, 4, 5, 8 },
        { 6, 7, 8, 9 } };
      for (int m = 0; m < 4; ++m)
      {
        const auto& [i0, i1, i2, i3] = between[m];
        linear[m][c] = b * net[i0][c] + u[0] * net[i1][c] + u[1] * net[i2][c] + u[2] * net[i3][c];
      }
      const double scale = p * (p - 1);
      for (int a = 0, quantity = 4; a < 3; ++a)
      {
        const auto along = net[between[a + 1][0]][c] - net[0][c];
        for (int d = a; d < 3; ++d, ++quantity)
        {
          const auto across = net[between[a + 1][d + 1]][c] - net[between[0][d + 1]][c];
          jet[quantity][c] = scale * (across - along);
        }
      }
    }
  }
};

/// Triangle first, then the line.
struct Wedge
{
  template <class Layout, int Order, int Degree>
  static void jet(const int (&degrees)[3], const double* coefficients,
    const typename Layout::Basis (&u)[3], Jet<Layout, Order>& jet)
  {
    const int p = Degree ? Degree : degrees[0];
    const int r = Degree ? Degree : degrees[2];
    typename Layout::Basis basis[MaximumTriangle];
    triangleBasis(p < Order ? 0 : p - Order, u, basis);
    Layers<Layout, Order> layers;
    for (int k = 0; k <= r; ++k)
    {
      const double* layer = coefficients + triangleCount(p) * k * Layout::width;
      triangleJet<Layout, Order>(p, u, basis, layer, k, layers);
    }
    const LineBasis<typename Layout::Basis, Order, Degree> bw(r, u[2]);
    const auto finish = [&](auto orders, int inTriangle, int a, int b)
    {
      contractInto<decltype(orders)::value, Layout>(
        bw, r + 1, [&](int k, int c) { return layers[inTriangle][k][c]; },
        [&](int order) { return jet[quantityOf(a, b, order)]; });
    };
    finish(Number<Order + 1>(), 0, 0, 0);
    finish(Number<Order>(), 1, 1, 0);
    finish(Number<Order>(), 2, 0, 1);
    if constexpr (Order == 2)
    {
      finish(Number<1>(), 3, 2, 0);
      finish(Number<1>(), 4, 1, 1);
      finish(Number<1>(), 5, 0, 2);
    }
  }

private:
  template <int Value>
  struct Number
  {
    static constexpr int value = Value;
  };

  /// [value, u, v, uu, uv, vv][k]
  template <class Layout, int Order>
  using Layers = typename Layout::Sum[triangleNetSize<Order>][MaximumLine][Layout::components];

  template <class Layout, int Order>
  static void triangleJet(int p, const typename Layout::Basis (&u)[3],
    const typename Layout::Basis* basis, const double* coefficients, int k,
    Layers<Layout, Order>& layers)
  {
    typename Layout::Sum linear[3][Layout::components];
    if (p < Order)
    {
      triangleNet<Layout, 1>(p, basis, coefficients, linear);
      for (int d = 3; d < triangleNetSize<Order>; ++d)
      {
        for (int c = 0; c < Layout::components; ++c)
        {
          layers[d][k][c] = typename Layout::Sum{};
        }
      }
    }
    else
    {
      typename Layout::Sum net[triangleNetSize<Order>][Layout::components];
      triangleNet<Layout, Order>(p, basis, coefficients, net);
      for (int c = 0; c < Layout::components; ++c)
      {
        reduce<Layout, Order>(p, u, net, k, c, linear, layers);
      }
    }
    const typename Layout::Basis b = 1.0 - u[0] - u[1];
    const double scale = p;
    for (int c = 0; c < Layout::components; ++c)
    {
      layers[0][k][c] = b * linear[0][c] + u[0] * linear[1][c] + u[1] * linear[2][c];
      layers[1][k][c] = scale * (linear[1][c] - linear[0][c]);
      layers[2][k][c] = scale * (linear[2][c] - linear[0][c]);
    }
  }

  /// Second derivatives from a quadratic net, and the net one degree lower.
  template <class Layout, int Order, class Net, class Linear>
  static void reduce(int p, const typename Layout::Basis (&u)[3], const Net& net, int k, int c,
    Linear& linear, Layers<Layout, Order>& layers)
  {
    if constexpr (Order == 1)
    {
      for (int m = 0; m < 3; ++m)
      {
        linear[m][c] = net[m][c];
      }
    }
    else
    {
      const typename Layout::Basis b = 1.0 - u[0] - u[1];
      linear[0][c] = b * net[0][c] + u[0] * net[1][c] + u[1] * net[3][c];
      linear[1][c] = b * net[1][c] + u[0] * net[2][c] + u[1] * net[4][c];
      linear[2][c] = b * net[3][c] + u[0] * net[4][c] + u[1] * net[5][c];
      const double scale = p * (p - 1);
      const auto alongU = net[1][c] - net[0][c];
      const auto alongV = net[3][c] - net[0][c];
      layers[3][k][c] = scale * (net[2][c] - net[1][c] - alongU);
      layers[4][k][c] = scale * (net[4][c] - net[3][c] - alongU);
      layers[5][k][c] = scale * (net[5][c] - net[3][c] - alongV);
    }
  }
};

} // namespace
} // namespace hop::kernel
