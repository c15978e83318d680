#pragma once

#include "Kernel/Hidden.h"
#include "Kernel/Jets.h"
#include "Kernel/LambdaTwo.h"
#include "Kernel/Lines.h"
#include "Kernel/MatrixRows.h"
#include "Kernel/Near.h"
#include "Kernel/PlaneCell.h"
#include "Kernel/RowProducts.h"
#include "Kernel/Sweep.h"

#include <utility>

namespace hop::kernel
{
namespace
{

/// Quotient rule: with A = w R, R_a = (A_a - w_a R) / w and
/// R_ab = (A_ab - w_a R_b - w_b R_a - w_ab R) / w.
template <int Order, class Sum, class Weight, int Components>
inline void divide(
  Sum (&jet)[quantityCount<Order>][Components], const Weight (&w)[quantityCount<Order>][1])
{
  const Weight inverse = 1.0 / w[0][0];
  for (int c = 0; c < Components; ++c)
  {
    jet[0][c] *= inverse;
    for (int a = 1; a < 4; ++a)
    {
      jet[a][c] = (jet[a][c] - w[a][0] * jet[0][c]) * inverse;
    }
    if constexpr (Order == 2)
    {
      for (int a = 1, quantity = 4; a < 4; ++a)
      {
        for (int b = a; b < 4; ++b, ++quantity)
        {
          jet[quantity][c] = (jet[quantity][c] - w[a][0] * jet[b][c] - w[b][0] * jet[a][c] -
                               w[quantity][0] * jet[0][c]) *
            inverse;
        }
      }
    }
  }
}

/// The jet of a polynomial or rational element.
template <class Shape, int PointLanes, int ComponentLanes, int Order, int Degree>
inline void elementJet(const Element& element, const Vector<double, PointLanes> (&u)[3],
  Jet<Layout<PointLanes, ComponentLanes, 4>, Order>& jet)
{
  Shape::template jet<Layout<PointLanes, ComponentLanes, 4>, Order, Degree>(
    element.degrees, element.coefficients, u, jet);
  if (element.weights)
  {
    using WeightLayout = Layout<PointLanes, 1, 1>;
    Jet<WeightLayout, Order> weight;
    Shape::template jet<WeightLayout, Order, 0>(element.degrees, element.weights, u, weight);
    divide<Order>(jet, weight);
  }
}

/// The next points, one a lane; past the end the last one again, so that the tail of a batch is
/// computed like the rest of it.
template <int PointLanes>
inline void loadPoints(
  const double* points, int first, int count, Vector<double, PointLanes> (&u)[3])
{
  double lanes[3][PointLanes];
  for (int lane = 0; lane < PointLanes; ++lane)
  {
    const int point = first + lane < count ? first + lane : count - 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes[axis][lane] = points[3 * point + axis];
    }
  }
  std::memcpy(u, lanes, sizeof(lanes));
}

template <class Shape, int PointLanes, int Order, int Degree>
void batchOfDegree(
  const Element& element, const double* points, int count, double* jets, std::ptrdiff_t stride)
{
  for (int first = 0; first < count; first += PointLanes)
  {
    Vector<double, PointLanes> u[3];
    loadPoints<PointLanes>(points, first, count, u);
    Jet<Layout<PointLanes, 1, 4>, Order> jet;
    elementJet<Shape, PointLanes, 1, Order, Degree>(element, u, jet);
    for (int row = 0; row < 4 * quantityCount<Order>; ++row)
    {
      std::memcpy(jets + row * stride + first, &jet[row / 4][row % 4], sizeof(jet[0][0]));
    }
  }
}

template <class Shape, int ComponentLanes, int Order, int Degree>
void pointOfDegree(const Element& element, const double* point, double* result)
{
  const double u[3] = { point[0], point[1], point[2] };
  Jet<Layout<1, ComponentLanes, 4>, Order> jet;
  elementJet<Shape, 1, ComponentLanes, Order, Degree>(element, u, jet);
  using Sum = typename Layout<1, ComponentLanes, 4>::Sum;
  const Sum* values = jet[0];
  for (int i = 0; i < 4 / ComponentLanes * quantityCount<Order>; ++i)
  {
    std::memcpy(result + i * ComponentLanes, values + i, sizeof(Sum));
  }
}

/// Up to these, there are kernels of elements of one degree along all axes, which the compiler knows. At single points
/// that pays up to high degrees, as it breaks up chains of sums; the sums of batches fill the registers anyhow. Chosen
/// by experiment (Testing/Benchmarks/kernel_benchmark.cpp shows the times); higher ones make the library larger.
constexpr int HighestBatchDegree = 4;
constexpr int HighestPointDegree = 8;

/// The degree to call the kernel of; 0: the one for all.
inline int compiledDegree(const Element& element, int highest)
{
  const auto [p, q, r] = element.degrees;
  return p == q && q == r && p <= highest ? p : 0;
}

template <class Shape, int PointLanes, int Order, int... Degrees>
inline void callBatch(std::integer_sequence<int, Degrees...>, const Element& element,
  const double* points, int count, double* jets, std::ptrdiff_t stride)
{
  constexpr BatchFunction functions[] = { batchOfDegree<Shape, PointLanes, Order, Degrees>... };
  functions[compiledDegree(element, HighestBatchDegree)](element, points, count, jets, stride);
}

template <class Shape, int ComponentLanes, int Order, int... Degrees>
inline void callPoint(
  std::integer_sequence<int, Degrees...>, const Element& element, const double* where, double* jet)
{
  constexpr PointFunction functions[] = { pointOfDegree<Shape, ComponentLanes, Order, Degrees>... };
  functions[compiledDegree(element, HighestPointDegree)](element, where, jet);
}

template <class Shape, int PointLanes, int Order>
void batch(
  const Element& element, const double* points, int count, double* jets, std::ptrdiff_t stride)
{
  callBatch<Shape, PointLanes, Order>(std::make_integer_sequence<int, HighestBatchDegree + 1>(),
    element, points, count, jets, stride);
}

template <class Shape, int ComponentLanes, int Order>
void point(const Element& element, const double* where, double* jet)
{
  callPoint<Shape, ComponentLanes, Order>(
    std::make_integer_sequence<int, HighestPointDegree + 1>(), element, where, jet);
}

template <class Shape, int PointLanes, int ComponentLanes>
constexpr DomainKernels makeDomainKernels()
{
  return { batch<Shape, PointLanes, 1>, batch<Shape, PointLanes, 2>,
    point<Shape, ComponentLanes, 1>, point<Shape, ComponentLanes, 2> };
}

/// \tparam PointLanes points in a vector of a batch
/// \tparam ComponentLanes components (x, y, z, f) in a vector where there is one point
template <int PointLanes, int ComponentLanes>
constexpr Kernels makeKernels()
{
  static_assert(PointLanes <= MaximumLanes);
  return { makeDomainKernels<Hexahedron, PointLanes, ComponentLanes>(),
    makeDomainKernels<Tetrahedron, PointLanes, ComponentLanes>(),
    makeDomainKernels<Wedge, PointLanes, ComponentLanes>(), sweepBlocks, findNear<PointLanes>,
    measurePlaneCell<PointLanes>, bisectLines<ComponentLanes>, bisectNumbers<PointLanes>,
    boundComponents<ComponentLanes>, findHidden<PointLanes>, addRowProducts<PointLanes>,
    multiplyMatrix<PointLanes>, lambdaTwoOf<PointLanes> };
}

} // namespace
} // namespace hop::kernel
