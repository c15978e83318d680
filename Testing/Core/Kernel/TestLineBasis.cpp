#include "AvailableParts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

/// The derivative of that order of Bernstein polynomial i of degree p: by its definition and the rule for its
/// derivatives.
double bernstein(int order, int p, int i, double t)
{
  if (i < 0 || i > p)
  {
    return 0.0;
  }
  if (order > 0)
  {
    return p * (bernstein(order - 1, p - 1, i - 1, t) - bernstein(order - 1, p - 1, i, t));
  }
  double binomial = 1.0;
  for (int n = 0; n < i; ++n)
  {
    binomial *= static_cast<double>(p - n) / (n + 1);
  }
  return binomial * std::pow(t, i) * std::pow(1.0 - t, p - i);
}

/// Each derivative of a polynomial of degree p amplifies rounding by about p^2.
double toleranceOf(int order, int p)
{
  return 1e-14 * std::pow(p * p, order);
}

/// Calls use(t, values) for places along a line and beyond its ends; values(order, i).
template <class Use>
void forPlaces(const KernelParts& parts, int degree, const Use& use)
{
  std::vector<double> t(parts.lanes);
  std::vector<double> result(3 * (degree + 1) * parts.lanes);
  for (int first = -1; first <= 11; first += parts.lanes)
  {
    for (int lane = 0; lane < parts.lanes; ++lane)
    {
      t[lane] = 0.1 * std::min(first + lane, 11);
    }
    parts.lineBasis(degree, t.data(), result.data());
    for (int lane = 0; lane < parts.lanes; ++lane)
    {
      use(t[lane],
        [&](int order, int i) { return result[(order * (degree + 1) + i) * parts.lanes + lane]; });
    }
  }
}

class LineBasis : public ::testing::TestWithParam<CompiledParts>
{
};

TEST_P(LineBasis, HasTheValuesAndDerivativesOfItsDefinition)
{
  for (int degree = 1; degree <= 10; ++degree)
  {
    forPlaces(GetParam().parts, degree,
      [&](double t, const auto& values)
      {
        for (int order = 0; order < 3; ++order)
        {
          for (int i = 0; i <= degree; ++i)
          {
            EXPECT_NEAR(
              values(order, i), bernstein(order, degree, i, t), toleranceOf(order, degree) * 10.0)
              << "degree " << degree << ", order " << order << ", i " << i << ", t " << t;
          }
        }
      });
  }
}

TEST_P(LineBasis, SumsToOneAndDerivativesToZeroUpToTheHighestDegree)
{
  for (const int degree : { 1, 2, 3, 7, 15, kernel::MaximumDegree })
  {
    forPlaces(GetParam().parts, degree,
      [&](double t, const auto& values)
      {
        if (t < 0.0 || t > 1.0)
        {
          return; // terms of both signs cancel there
        }
        for (int order = 0; order < 3; ++order)
        {
          double sum = 0.0;
          for (int i = 0; i <= degree; ++i)
          {
            sum += values(order, i);
          }
          EXPECT_NEAR(sum, order == 0 ? 1.0 : 0.0, toleranceOf(order, degree))
            << degree << ' ' << t;
        }
      });
  }
}

TEST_P(LineBasis, OfThreeCoordinatesTogetherIsThatOfEach)
{
  constexpr int degree = KernelParts::TensorDegree;
  const double u[3] = { 0.2, 0.5, 0.9 };
  double together[3][3][degree + 1];
  GetParam().parts.tensorBasis(u, together[0][0]);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int order = 0; order < 3; ++order)
    {
      for (int i = 0; i <= degree; ++i)
      {
        EXPECT_NEAR(together[axis][order][i], bernstein(order, degree, i, u[axis]),
          toleranceOf(order, degree));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, LineBasis, ::testing::ValuesIn(availableParts()), nameOfParts);

} // namespace
} // namespace hop::testing
