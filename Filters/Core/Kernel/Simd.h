#pragma once

// The only place that knows which vectors the compiler has: vector extensions of GCC and Clang (clang-cl too), or plain
// C++. HOP_PORTABLE_VECTORS asks for plain C++ everywhere (CMake: -DHOP_GNU_VECTORS=OFF).
//
// Kernels are written once, in terms of these names. `Number` is float, double or std::int32_t:
//   Vector<Number, Count>     numbers that are computed with together; one number itself where Count is 1
//   + - * /  += -= *=  [i]    lane by lane; one of the two operands may be a number
//   a <= b                    per lane -1 where it holds, else 0; the lanes are integers as wide as a number
//   a >> n                    shift of integers
//   least, greatest           the first or the second operand, as `<` or `>` says
//   select(m, a, b)           a where m is -1, b where it is 0; m comes from a comparison
//   squareRoot(a)             of doubles
//   shuffle<i...>(a, b)       lanes of a followed by those of b, by number
//
// Whatever is made of vectors is local to the file that includes it (namespaces without a name), so that each
// instruction set has its own copy: of two copies of an inline function, the linker would keep either.

#if (defined(__GNUC__) || defined(__clang__)) && !defined(HOP_PORTABLE_VECTORS)
#include "Kernel/SimdGnu.h"
#else
#include "Kernel/SimdPortable.h"
#endif

#include <cmath>
#include <cstring>

namespace hop::kernel
{
namespace
{

#if (defined(__GNUC__) || defined(__clang__)) && !defined(HOP_PORTABLE_VECTORS)
namespace simd = gnu;
#else
namespace simd = portable;
#endif

template <class Number, int Count>
struct VectorOf
{
  using Type = typename simd::VectorOf<Number, Count>::Type;
};

template <class Number>
struct VectorOf<Number, 1>
{
  using Type = Number;
};

template <class Number, int Count>
using Vector = typename VectorOf<Number, Count>::Type;

/// Doubles to compute with together in registers of so many bits; one where the compiler has no vectors.
template <int Bits>
constexpr int DoublesIn = simd::FitsRegisters ? Bits / 64 : 1;

using simd::greatest;
using simd::least;
using simd::select;
using simd::shuffle;

/// The same bits as another type: from and to memory, between floats and integers.
template <class To, class From>
inline To bitCast(From from)
{
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

/// \param from need not be aligned
template <class V, class Number>
inline V load(const Number* from)
{
  V result;
  std::memcpy(&result, from, sizeof(result));
  return result;
}

/// \param to need not be aligned
template <class V, class Number>
inline void store(V value, Number* to)
{
  std::memcpy(to, &value, sizeof(value));
}

inline double squareRoot(double a)
{
  return std::sqrt(a);
}

template <class V>
inline V squareRoot(V a)
{
  constexpr int count = sizeof(V) / sizeof(double);
  for (int i = 0; i < count; ++i)
  {
    a[i] = std::sqrt(a[i]);
  }
  return a;
}

} // namespace
} // namespace hop::kernel
