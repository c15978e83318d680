#pragma once

#include "Kernel/Lanes.h"
#include "Kernel/LineBasis.h"

namespace hop::kernel
{
namespace
{

/// The bases along the three coordinates of a point (or vector of points).
template <class Layout, int Order, int Degree, class = void>
class TensorBasis
{
public:
  using Number = typename Layout::Basis;

  TensorBasis(const int (&degrees)[3], const Number (&u)[3])
    : Lines{ { degrees[0], u[0] }, { degrees[1], u[1] }, { degrees[2], u[2] } }
  {
  }

  template <int Axis>
  const auto& along() const
  {
    return this->Lines[Axis];
  }

private:
  LineBasis<Number, Order, Degree> Lines[3];
};

/// One point, of the same degree along all coordinates: the coordinates go through the recurrences together, as lanes
/// of one vector.
template <class Layout, int Order, int Degree>
class TensorBasis<Layout, Order, Degree, typename Layout::template IfSinglePoint<Degree>>
{
public:
  TensorBasis(const int (&degrees)[3], const double (&u)[3])
    : Lines(degrees[0], Together{ u[0], u[1], u[2], 0.0 })
  {
  }

  template <int Axis>
  auto along() const
  {
    return [this](int order, int i) { return this->Lines(order, i)[Axis]; };
  }

private:
  using Together = Vector<double, 4>;
  LineBasis<Together, Order, Degree> Lines;
};

} // namespace
} // namespace hop::kernel
