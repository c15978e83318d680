#include "Elements/Space.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>

namespace hop
{
namespace
{

template <class A, class B, class = void>
struct HasDifference : std::false_type
{
};
template <class A, class B>
struct HasDifference<A, B, std::void_t<decltype(std::declval<A>() - std::declval<B>())>>
  : std::true_type
{
};

template <class A, class B, class = void>
struct HasSum : std::false_type
{
};
template <class A, class B>
struct HasSum<A, B, std::void_t<decltype(std::declval<A>() + std::declval<B>())>> : std::true_type
{
};

TEST(Space, PointsAndVectorsOfBothSpacesDoNotMix)
{
  EXPECT_TRUE((HasDifference<WorldPoint, WorldPoint>::value));
  EXPECT_FALSE((HasDifference<WorldPoint, ReferencePoint>::value));
  EXPECT_FALSE((HasDifference<WorldVector, ReferenceVector>::value));
  EXPECT_TRUE((HasSum<WorldPoint, WorldVector>::value));
  EXPECT_FALSE((HasSum<WorldPoint, ReferenceVector>::value));
  EXPECT_FALSE((HasSum<WorldPoint, WorldPoint>::value)) << "points are not added";
  EXPECT_FALSE((std::is_convertible<WorldPoint, ReferencePoint>::value));
  EXPECT_FALSE((std::is_convertible<WorldVector, ReferenceVector>::value));
  EXPECT_FALSE((std::is_convertible<WorldPoint, WorldVector>::value));
}

TEST(Space, DifferencesOfPointsAreVectors)
{
  const WorldPoint a{ { 1, 2, 3 } }, b{ { 0, 5, -1 } };
  const WorldVector d = a - b;
  EXPECT_EQ(d.xyz, glm::dvec3(1, -3, 4));
  EXPECT_EQ((b + d).xyz, a.xyz);
  EXPECT_EQ((-d).xyz, (b - a).xyz);
}

TEST(Space, VectorsAreALinearSpace)
{
  const ReferenceVector a{ { 1, 2, 3 } }, b{ { -2, 0, 5 } };
  EXPECT_EQ((a + b).xyz, glm::dvec3(-1, 2, 8));
  EXPECT_EQ((a - b).xyz, glm::dvec3(3, 2, -2));
  EXPECT_EQ((0.5 * a).xyz, glm::dvec3(0.5, 1.0, 1.5));
  EXPECT_EQ(dot(a, b), 13.0);
  EXPECT_DOUBLE_EQ(length(ReferenceVector{ { 2, -3, 6 } }), 7.0);
}

TEST(Space, AngleBetweenKnownVectors)
{
  const double pi = std::acos(-1.0);
  const WorldVector x{ { 1, 0, 0 } };
  for (const double angle : { 0.0, 1e-9, 0.3, 0.5 * pi, 2.0, pi - 1e-9, pi })
  {
    // Lengths do not matter; small angles and angles near pi keep all their digits.
    const WorldVector y{ { 1e-3 * std::cos(angle), 1e-3 * std::sin(angle), 0.0 } };
    EXPECT_NEAR(angleBetween(x, y), angle, 1e-14);
    EXPECT_NEAR(angleBetween(y, 1e5 * x), angle, 1e-14);
  }
  EXPECT_EQ(angleBetween(x, WorldVector{}), 0.0);
  EXPECT_EQ(angleBetween(WorldVector{}, WorldVector{}), 0.0);
}

} // namespace
} // namespace hop
