#include "Kernel/Simd.h"
#include "Kernel/SimdPortable.h"

#include <gtest/gtest.h>

#include <cstdint>

// Vectors of the compiler, where it has some, and those in plain C++ do the same.
namespace hop::kernel
{
namespace
{

template <class V>
void expectLanes(const V& v, double a, double b, double c, double d)
{
  EXPECT_EQ(v[0], a);
  EXPECT_EQ(v[1], b);
  EXPECT_EQ(v[2], c);
  EXPECT_EQ(v[3], d);
}

template <class V>
class Simd : public ::testing::Test
{
};

using Types = ::testing::Types<Vector<double, 4>, portable::LaneArray<double, 4>, Vector<float, 4>,
  portable::LaneArray<float, 4>>;
TYPED_TEST_SUITE(Simd, Types);

TYPED_TEST(Simd, ComputesLaneByLane)
{
  using V = TypeParam;
  using Number = std::decay_t<decltype(V{}[0])>;
  const V a{ 1, 2, 3, 4 }, b{ 8, 4, 2, 1 };
  const Number two = 2;
  expectLanes(V(a + b), 9, 6, 5, 5);
  expectLanes(V(a - b), -7, -2, 1, 3);
  expectLanes(V(a * b), 8, 8, 6, 4);
  expectLanes(V(a / b), 0.125, 0.5, 1.5, 4);
  expectLanes(V(a + two), 3, 4, 5, 6);
  expectLanes(V(two + a), 3, 4, 5, 6);
  expectLanes(V(a - two), -1, 0, 1, 2);
  expectLanes(V(two - a), 1, 0, -1, -2);
  expectLanes(V(a * two), 2, 4, 6, 8);
  expectLanes(V(two * a), 2, 4, 6, 8);
  expectLanes(V(a / two), 0.5, 1, 1.5, 2);
  expectLanes(V(two / b), 0.25, 0.5, 1, 2);
  V c = a;
  c += b;
  expectLanes(c, 9, 6, 5, 5);
  c -= a;
  expectLanes(c, 8, 4, 2, 1);
  c *= a;
  expectLanes(c, 8, 8, 6, 4);
  c += two;
  c -= two;
  c *= two;
  expectLanes(c, 16, 16, 12, 8);
  expectLanes(V{}, 0, 0, 0, 0);
}

TYPED_TEST(Simd, ChoosesComparesAndMoves)
{
  using V = TypeParam;
  using Number = std::decay_t<decltype(V{}[0])>;
  const V a{ 1, 2, 3, 4 }, b{ 4, 2, 2, 5 };
  const Number two = 2;
  expectLanes(V(least(a, b)), 1, 2, 2, 4);
  expectLanes(V(greatest(a, b)), 4, 2, 3, 5);
  const auto inOrder = a <= b;
  static_assert(sizeof(inOrder) == sizeof(V));
  expectLanes(inOrder, -1, -1, 0, -1);
  expectLanes(a <= two, -1, -1, 0, 0);
  expectLanes(V(select(inOrder, a, b)), 1, 2, 2, 4);
  expectLanes(V(shuffle<0, 4, 1, 5>(a, b)), 1, 4, 2, 2);
  expectLanes(V(shuffle<7, 6, 5, 4>(a, b)), 5, 2, 2, 4);
  Number numbers[5] = { 9, 1, 2, 3, 4 };
  expectLanes(load<V>(numbers + 1), 1, 2, 3, 4);
  store(b, numbers + 1);
  EXPECT_EQ(numbers[0], 9);
  EXPECT_EQ(numbers[4], 5);
}

TEST(Simd, ShiftsBitsOfFloats)
{
  using Floats = portable::LaneArray<float, 4>;
  using Integers = portable::LaneArray<std::int32_t, 4>;
  const Integers bits = bitCast<Integers>(Floats{ 1.0f, 2.0f, 4.0f, -1.0f });
  EXPECT_EQ(bits[0], 0x3f800000);
  expectLanes(bits >> 23, 127, 128, 129, -129);
  const std::int32_t hundred = 100;
  expectLanes(hundred - (bits >> 23), -27, -28, -29, 229);
  using Wide = Vector<std::int32_t, 4>;
  expectLanes(Wide(hundred - (bitCast<Wide>(bits) >> 23)), -27, -28, -29, 229);
}

} // namespace
} // namespace hop::kernel
