#pragma once

#include "Kernel/Simd.h"

#include <type_traits>

// Local to the file that includes it, see Simd.h.
namespace hop::kernel
{
namespace
{

/// How the work is laid over the lanes. Either lanes hold points, and coefficients are single numbers; or lanes hold
/// components (x, y, z, f) of the coefficients, and there is one point.
/// \tparam Width numbers in a coefficient: 4, or 1 for the weights.
template <int PointLanes, int ComponentLanes, int Width>
struct Layout
{
  static_assert(PointLanes == 1 || ComponentLanes == 1);
  static_assert(Width % ComponentLanes == 0);
  /// Coordinates and basis functions.
  using Basis = Vector<double, PointLanes>;
  using Coefficient = Vector<double, ComponentLanes>;
  /// Basis times coefficient.
  using Sum = Vector<double, PointLanes * ComponentLanes>;
  static constexpr int width = Width;
  /// Coefficients of this layout that make up a coefficient of the element.
  static constexpr int components = Width / ComponentLanes;

  /// From this degree on, the recurrences of all coordinates together (TensorBasis) take less time than one after the
  /// other. 3 was chosen by experiment: vectors of lower degrees cost more to fill than they save.
  static constexpr int LowestDegreeTogether = 3;

  /// void where lanes hold components and the degree is known to the compiler and high enough for the recurrences of
  /// all coordinates to run together; else no type.
  template <int Degree>
  using IfSinglePoint = std::enable_if_t<(ComponentLanes > 1 && Degree >= LowestDegreeTogether)>;

  /// \param index counts coefficients of this layout
  static Coefficient load(const double* coefficients, int index)
  {
    return kernel::load<Coefficient>(coefficients + index * ComponentLanes);
  }
};

} // namespace
} // namespace hop::kernel
