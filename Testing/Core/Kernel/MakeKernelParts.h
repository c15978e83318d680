#pragma once

#include "Kernel/Lanes.h"
#include "Kernel/LineBasis.h"
#include "Kernel/SimplexNet.h"
#include "Kernel/Sweep.h"
#include "Kernel/TensorBasis.h"

#include "KernelParts.h"

// Compiled once an instruction set, and as local to the file that includes it as the kernels are.
namespace hop::testing
{
namespace
{

using namespace kernel;

template <int Lanes>
void lineBasis(int degree, const double* t, double* result)
{
  using Number = Vector<double, Lanes>;
  const LineBasis<Number, 2, 0> basis(degree, load<Number>(t));
  for (int order = 0; order < 3; ++order)
  {
    for (int i = 0; i <= degree; ++i, result += Lanes)
    {
      store(basis(order, i), result);
    }
  }
}

template <int Axis, class Basis>
void storeAlong(const Basis& basis, double* result)
{
  const auto& line = basis.template along<Axis>();
  for (int order = 0; order < 3; ++order)
  {
    for (int i = 0; i <= KernelParts::TensorDegree; ++i)
    {
      *result++ = line(order, i);
    }
  }
}

template <int ComponentLanes>
void tensorBasis(const double* u, double* result)
{
  constexpr int degree = KernelParts::TensorDegree;
  constexpr int numbers = 3 * (degree + 1);
  const int degrees[3] = { degree, degree, degree };
  const double point[3] = { u[0], u[1], u[2] };
  const TensorBasis<Layout<1, ComponentLanes, 4>, 2, degree> basis(degrees, point);
  storeAlong<0>(basis, result);
  storeAlong<1>(basis, result + numbers);
  storeAlong<2>(basis, result + 2 * numbers);
}

struct Triangle
{
  static constexpr int dimension = 2;
  static constexpr int mostFunctions = MaximumTriangle;
  template <int Order>
  static constexpr int netSize = triangleNetSize<Order>;

  static int count(int degree) { return triangleCount(degree); }
  template <class Number>
  static void basis(int degree, const Number* u, Number* result)
  {
    kernel::triangleBasis(degree, u, result);
  }
  template <class Layout, int Order, class Net>
  static void net(
    int degree, const typename Layout::Basis* basis, const double* coefficients, Net& net)
  {
    kernel::triangleNet<Layout, Order>(degree, basis, coefficients, net);
  }
};

struct Tetrahedron
{
  static constexpr int dimension = 3;
  static constexpr int mostFunctions = MaximumTetrahedron;
  template <int Order>
  static constexpr int netSize = tetrahedronNetSize<Order>;

  static int count(int degree) { return (degree + 1) * (degree + 2) * (degree + 3) / 6; }
  template <class Number>
  static void basis(int degree, const Number* u, Number* result)
  {
    kernel::tetrahedronBasis(degree, u, result);
  }
  template <class Layout, int Order, class Net>
  static void net(
    int degree, const typename Layout::Basis* basis, const double* coefficients, Net& net)
  {
    kernel::tetrahedronNet<Layout, Order>(degree, basis, coefficients, net);
  }
};

template <class Simplex, int Lanes>
void loadCoordinates(const double* from, Vector<double, Lanes> (&u)[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    u[axis] = load<Vector<double, Lanes>>(from + (axis < Simplex::dimension ? axis : 0) * Lanes);
  }
}

template <class Simplex, int Lanes>
void simplexBasis(int degree, const double* where, double* result)
{
  using Number = Vector<double, Lanes>;
  Number u[3];
  loadCoordinates<Simplex, Lanes>(where, u);
  Number basis[Simplex::mostFunctions];
  Simplex::basis(degree, u, basis);
  for (int i = 0; i < Simplex::count(degree); ++i)
  {
    store(basis[i], result + i * Lanes);
  }
}

template <class Simplex, int PointLanes, int ComponentLanes, int Order>
void netOfOrder(int degree, const double* where, const double* coefficients, double* result)
{
  using Layout = kernel::Layout<PointLanes, ComponentLanes, 4>;
  typename Layout::Basis u[3];
  loadCoordinates<Simplex, PointLanes>(where, u);
  typename Layout::Basis basis[Simplex::mostFunctions];
  Simplex::basis(degree - Order, u, basis);
  constexpr int size = Simplex::template netSize<Order>;
  typename Layout::Sum net[size][Layout::components];
  Simplex::template net<Layout, Order>(degree, basis, coefficients, net);
  for (int m = 0; m < size; ++m)
  {
    for (int c = 0; c < Layout::components; ++c, result += PointLanes * ComponentLanes)
    {
      store(net[m][c], result);
    }
  }
}

template <class Simplex, int PointLanes, int ComponentLanes>
void simplexNet(int degree, int order, const double* u, const double* coefficients, double* result)
{
  const auto net = order == 1 ? netOfOrder<Simplex, PointLanes, ComponentLanes, 1>
                              : netOfOrder<Simplex, PointLanes, ComponentLanes, 2>;
  net(degree, u, coefficients, result);
}

void inverseSquareRoots(const float* x, float* result)
{
  store(inverseSquareRoot(loadFloats(x)), result);
}

void pairEnergies(const float* t, float* result)
{
  Floats energy, first, second;
  pairEnergy(loadFloats(t), energy, first, second);
  store(energy, result);
  store(first, result + SweepLanes);
  store(second, result + 2 * SweepLanes);
}

void newtonSteps(const float* hessian, const float* gradient, float floor, float* result)
{
  const TangentialHessian h{ loadFloats(hessian), loadFloats(hessian + SweepLanes),
    loadFloats(hessian + 2 * SweepLanes) };
  const Tangential step =
    newtonStep(h, { loadFloats(gradient), loadFloats(gradient + SweepLanes) }, floor);
  store(step.x, result);
  store(step.y, result + SweepLanes);
}

/// As makeKernels().
template <int PointLanes, int ComponentLanes>
KernelParts makeKernelParts()
{
  KernelParts parts;
  parts.lanes = PointLanes;
  parts.lineBasis = lineBasis<PointLanes>;
  parts.tensorBasis = tensorBasis<ComponentLanes>;
  parts.triangleBasis = simplexBasis<Triangle, PointLanes>;
  parts.tetrahedronBasis = simplexBasis<Tetrahedron, PointLanes>;
  parts.triangleNet = { simplexNet<Triangle, PointLanes, 1>,
    simplexNet<Triangle, 1, ComponentLanes> };
  parts.tetrahedronNet = { simplexNet<Tetrahedron, PointLanes, 1>,
    simplexNet<Tetrahedron, 1, ComponentLanes> };
  parts.inverseSquareRoot = inverseSquareRoots;
  parts.pairEnergy = pairEnergies;
  parts.newtonStep = newtonSteps;
  return parts;
}

} // namespace
} // namespace hop::testing
