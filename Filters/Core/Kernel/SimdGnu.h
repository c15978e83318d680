#pragma once

#include <cstdint>
#include <type_traits>

// Simd.h by the vector extensions of GCC and Clang, which have the operators already.
namespace hop::kernel
{
namespace
{
namespace gnu
{

/// Vectors wider than the registers of the instruction set are split by the compiler.
constexpr bool FitsRegisters = true;

template <class Number, int Count>
struct VectorOf
{
  typedef Number Type __attribute__((vector_size(Count * sizeof(Number))));
};

template <class V>
inline V least(V a, V b)
{
  return a < b ? a : b;
}

template <class V>
inline V greatest(V a, V b)
{
  return a > b ? a : b;
}

template <class Mask, class V>
inline V select(Mask mask, V a, V b)
{
  return mask ? a : b;
}

template <int... Lanes, class V>
inline V shuffle(V a, V b)
{
#if defined(__clang__) || __GNUC__ >= 12
  return __builtin_shufflevector(a, b, Lanes...);
#else
  using Number = std::decay_t<decltype(a[0])>;
  using Index = std::conditional_t<sizeof(Number) == 4, std::int32_t, std::int64_t>;
  return __builtin_shuffle(a, b, typename VectorOf<Index, sizeof...(Lanes)>::Type{ Lanes... });
#endif
}

} // namespace gnu
} // namespace
} // namespace hop::kernel
