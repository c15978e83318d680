#pragma once

#include <cstring>
#include <type_traits>

// Everything that the kernels are made of is local to the file that includes it, so that every
// instruction set gets its own copy.
namespace hop::kernel
{
namespace
{

/// `Count` doubles in one register, for compilers that have such a type; one double everywhere.
template <int Count>
struct Lanes
{
#if defined(__GNUC__)
  typedef double Type __attribute__((vector_size(Count * sizeof(double))));
#else
  static_assert(Count == 1, "this compiler has no vector types known here");
  using Type = double;
#endif
};

template <>
struct Lanes<1>
{
  using Type = double;
};

/// How the work is laid over the lanes: either they hold points, and coefficients are single
/// numbers; or they hold components (x, y, z, f) of the coefficients, and there is one point.
/// \tparam Width numbers in a coefficient: 4, or 1 for the weights.
template <int PointLanes, int ComponentLanes, int Width>
struct Layout
{
  static_assert(PointLanes == 1 || ComponentLanes == 1);
  /// Coordinates and basis functions.
  using Basis = typename Lanes<PointLanes>::Type;
  using Coefficient = typename Lanes<ComponentLanes>::Type;
  /// Basis times coefficient.
  using Sum = typename Lanes<PointLanes * ComponentLanes>::Type;
  static constexpr int width = Width;
  /// Coefficients (of this layout) that make up a coefficient of the element.
  static constexpr int components = Width / ComponentLanes;

  /// void where lanes hold components and the degree is known to the compiler, and high enough for
  /// common recurrences to pay; else no type.
  template <int Degree>
  using IfSinglePoint = std::enable_if_t<(ComponentLanes > 1 && Degree > 2)>;

  static Coefficient load(const double* coefficients, int index)
  {
    Coefficient result;
    std::memcpy(&result, coefficients + index * ComponentLanes, sizeof(result));
    return result;
  }
};

} // namespace
} // namespace hop::kernel
