#include "Surface/Energy.h"

#include <gtest/gtest.h>

namespace hop
{
namespace
{

TEST(Energy, ConstantsOfHexagonalPacking)
{
  EXPECT_NEAR(HexagonalDistance, 0.5 / std::cos(Pi / 6.0), 1e-15);
  EXPECT_NEAR(pairEnergy(HexagonalDistance), 0.1184710, 5e-8);
  EXPECT_NEAR(pairEnergyDerivative(HexagonalDistance), -0.961483, 5e-7);
  EXPECT_NEAR(pairEnergySecondDerivative(HexagonalDistance), 6.22404, 5e-6);
  EXPECT_NEAR(idealEnergy(), 0.7108259, 5e-8);
}

TEST(Energy, DerivativesAgreeWithFiniteDifferences)
{
  constexpr double h = 1e-5;
  for (double r = 0.05; r < 0.999; r += 0.01)
  {
    const double first = (pairEnergy(r + h) - pairEnergy(r - h)) / (2.0 * h);
    const double second = (pairEnergyDerivative(r + h) - pairEnergyDerivative(r - h)) / (2.0 * h);
    EXPECT_NEAR(pairEnergyDerivative(r), first, 1e-6 * (1.0 + std::abs(first))) << r;
    EXPECT_NEAR(pairEnergySecondDerivative(r), second, 1e-6 * (1.0 + std::abs(second))) << r;
  }
}

TEST(Energy, FallsToZeroAtDistanceOneAndIsConvex)
{
  for (double r = 0.02; r < 1.0; r += 0.01)
  {
    EXPECT_GT(pairEnergy(r), 0.0) << r;
    EXPECT_LT(pairEnergyDerivative(r), 0.0) << r;
    EXPECT_GT(pairEnergySecondDerivative(r), 0.0) << r;
  }
  for (const double r : { 1.0, 1.0 + 1e-12, 1.5, 1e300 })
  {
    EXPECT_EQ(pairEnergy(r), 0.0);
    EXPECT_EQ(pairEnergyDerivative(r), 0.0);
    EXPECT_EQ(pairEnergySecondDerivative(r), 0.0);
  }
  // Continuous at r = 1, with two derivatives.
  EXPECT_NEAR(pairEnergy(1.0 - 1e-6), 0.0, 1e-15);
  EXPECT_NEAR(pairEnergyDerivative(1.0 - 1e-6), 0.0, 1e-10);
  EXPECT_NEAR(pairEnergySecondDerivative(1.0 - 1e-6), 0.0, 1e-5);
}

TEST(Energy, IsFiniteForParticlesInOnePlace)
{
  EXPECT_TRUE(std::isfinite(pairEnergy(0.0)));
  EXPECT_TRUE(std::isfinite(pairEnergyDerivative(0.0)));
  EXPECT_TRUE(std::isfinite(pairEnergySecondDerivative(0.0)));
  EXPECT_GT(pairEnergy(0.0), 1e5);
}

} // namespace
} // namespace hop
