#pragma once

#include <cstdint>
#include <type_traits>

// Simd.h in plain C++: loops over arrays, which compilers turn into vector instructions as far as they can.
namespace hop::kernel
{
namespace
{
namespace portable
{

/// An array need not end up in a register: where one number does as well, one is faster.
constexpr bool FitsRegisters = false;

template <class Number, int Count>
struct LaneArray
{
  using Mask =
    LaneArray<std::conditional_t<sizeof(Number) == 4, std::int32_t, std::int64_t>, Count>;

  Number lanes[Count];

  Number& operator[](int i) { return this->lanes[i]; }
  const Number& operator[](int i) const { return this->lanes[i]; }

  friend LaneArray operator+(const LaneArray& a, const LaneArray& b)
  {
    return eachLane([&](int i) { return a[i] + b[i]; });
  }
  friend LaneArray operator-(const LaneArray& a, const LaneArray& b)
  {
    return eachLane([&](int i) { return a[i] - b[i]; });
  }
  friend LaneArray operator*(const LaneArray& a, const LaneArray& b)
  {
    return eachLane([&](int i) { return a[i] * b[i]; });
  }
  friend LaneArray operator/(const LaneArray& a, const LaneArray& b)
  {
    return eachLane([&](int i) { return a[i] / b[i]; });
  }
  friend LaneArray operator>>(const LaneArray& a, int bits)
  {
    return eachLane([&](int i) { return a[i] >> bits; });
  }
  friend Mask operator<=(const LaneArray& a, const LaneArray& b)
  {
    return Mask::eachLane([&](int i) { return a[i] <= b[i] ? -1 : 0; });
  }

  friend LaneArray operator+(const LaneArray& a, Number b) { return a + all(b); }
  friend LaneArray operator+(Number a, const LaneArray& b) { return all(a) + b; }
  friend LaneArray operator-(const LaneArray& a, Number b) { return a - all(b); }
  friend LaneArray operator-(Number a, const LaneArray& b) { return all(a) - b; }
  friend LaneArray operator*(const LaneArray& a, Number b) { return a * all(b); }
  friend LaneArray operator*(Number a, const LaneArray& b) { return all(a) * b; }
  friend LaneArray operator/(const LaneArray& a, Number b) { return a / all(b); }
  friend LaneArray operator/(Number a, const LaneArray& b) { return all(a) / b; }
  friend Mask operator<=(const LaneArray& a, Number b) { return a <= all(b); }

  template <class Other>
  LaneArray& operator+=(const Other& other)
  {
    return *this = *this + other;
  }
  template <class Other>
  LaneArray& operator-=(const Other& other)
  {
    return *this = *this - other;
  }
  template <class Other>
  LaneArray& operator*=(const Other& other)
  {
    return *this = *this * other;
  }

  /// The array of the numbers numberOf(i).
  template <class NumberOf>
  static LaneArray eachLane(const NumberOf& numberOf)
  {
    LaneArray result;
    for (int i = 0; i < Count; ++i)
    {
      result.lanes[i] = numberOf(i);
    }
    return result;
  }
  static LaneArray all(Number value)
  {
    return eachLane([=](int) { return value; });
  }
};

template <class Number, int Count>
struct VectorOf
{
  using Type = LaneArray<Number, Count>;
};

// Of single numbers.
template <class Number>
inline Number least(Number a, Number b)
{
  return a < b ? a : b;
}

template <class Number>
inline Number greatest(Number a, Number b)
{
  return a > b ? a : b;
}

template <class Number>
inline Number select(bool mask, Number a, Number b)
{
  return mask ? a : b;
}

template <class Number, int Count>
inline LaneArray<Number, Count> select(const typename LaneArray<Number, Count>::Mask& mask,
  const LaneArray<Number, Count>& a, const LaneArray<Number, Count>& b)
{
  return LaneArray<Number, Count>::eachLane([&](int i) { return mask[i] ? a[i] : b[i]; });
}

template <class Number, int Count>
inline LaneArray<Number, Count> least(
  const LaneArray<Number, Count>& a, const LaneArray<Number, Count>& b)
{
  return LaneArray<Number, Count>::eachLane([&](int i) { return a[i] < b[i] ? a[i] : b[i]; });
}

template <class Number, int Count>
inline LaneArray<Number, Count> greatest(
  const LaneArray<Number, Count>& a, const LaneArray<Number, Count>& b)
{
  return LaneArray<Number, Count>::eachLane([&](int i) { return a[i] > b[i] ? a[i] : b[i]; });
}

template <int Lane, class Number, int Count>
inline Number laneOf(const LaneArray<Number, Count>& a, const LaneArray<Number, Count>& b)
{
  if constexpr (Lane < Count)
  {
    return a[Lane];
  }
  else
  {
    return b[Lane - Count];
  }
}

template <int... Lanes, class Number, int Count>
inline LaneArray<Number, Count> shuffle(
  const LaneArray<Number, Count>& a, const LaneArray<Number, Count>& b)
{
  static_assert(sizeof...(Lanes) == Count);
  return { { laneOf<Lanes>(a, b)... } };
}

} // namespace portable
} // namespace
} // namespace hop::kernel
