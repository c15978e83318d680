#include "Surface/SizingFunction.h"

#include <gtest/gtest.h>

#include <vector>

namespace hop
{
namespace
{

const std::vector<double> spacings{ 1e-3, 0.05, 0.5, 20.0 };
const std::vector<double> densities{ 0.0, 1.0, 7.0, 15.0 };
/// D s / 2 pi, up to the automatic bound and beyond it.
const std::vector<double> shares{ 0.0, 0.01, 0.2, 0.5, 0.99, 1.0, 7.9, 8.0, 30.0, 1e6 };

/// The curvature magnitude for which one spacing covers a share of a full circle.
double curvatureOf(double share, double spacing)
{
  return share * 2.0 * Pi / spacing;
}

TEST(SizingFunction, IsEvenWithoutAngularDensity)
{
  const SizingFunction sizing{ 0.3, 0.0 };
  for (const double curvature : { 0.0, 1.0, 1e6 })
  {
    EXPECT_EQ(sizing.at(curvature), 0.3);
    EXPECT_NEAR(sizing.range(curvature), std::sqrt(3.0) * 0.3, 1e-15);
  }
}

/// Eq. (6) without its misprint: r = alpha d, alpha = beta (1 + rho D s / 2 pi) / s.
TEST(SizingFunction, IsTheCorrectedEquationSix)
{
  const double beta = 0.5 / std::cos(Pi / 6.0);
  for (const double s : spacings)
  {
    for (const double rho : densities)
    {
      const SizingFunction sizing{ s, rho };
      for (const double share : { 0.0, 0.01, 0.2, 0.5, 0.99, 4.0, 7.99 })
      {
        const double D = curvatureOf(share, s);
        const double alpha = beta * (1.0 + rho * D * s / (2.0 * Pi)) / s;
        // Neighbours of hexagonal packing stand at r = beta; the energy ends at r = 1.
        EXPECT_NEAR(alpha * sizing.at(D), beta, 1e-12);
        EXPECT_NEAR(alpha * sizing.range(D), 1.0, 1e-12);
      }
    }
  }
}

TEST(SizingFunction, KnownValues)
{
  const SizingFunction sizing{ 0.5, 7.0 };
  EXPECT_DOUBLE_EQ(sizing.at(0.0), 0.5);
  EXPECT_DOUBLE_EQ(sizing.at(Pi), 0.5 / (1.0 + 7.0 / 4.0)) << "a quarter of a circle a spacing";
  EXPECT_DOUBLE_EQ(sizing.at(2.0 * Pi / 0.5), 0.5 / 8.0) << "a full circle";
  EXPECT_DOUBLE_EQ(sizing.at(1e9), 0.5 / 57.0) << "no more than eight circles";
  EXPECT_DOUBLE_EQ((SizingFunction{ 0.5, 7.0, 0.1 }).at(1e9), 0.1) << "the smallest spacing";
  EXPECT_DOUBLE_EQ((SizingFunction{ 0.5, 7.0, 0.1 }).at(0.0), 0.5);
  EXPECT_DOUBLE_EQ((SizingFunction{ 0.5, 7.0, 3.0 }).at(0.0), 0.5) << "which is no larger than s";
}

TEST(SizingFunction, StaysBetweenItsBounds)
{
  for (const double s : spacings)
  {
    for (const double rho : densities)
    {
      const SizingFunction sizing{ s, rho };
      for (const double share : shares)
      {
        const double h = sizing.at(curvatureOf(share, s));
        EXPECT_GE(h, s / (1.0 + 8.0 * rho) * (1.0 - 1e-12));
        EXPECT_LE(h, s);
      }
    }
  }
}

TEST(SizingFunction, FallsWithCurvatureUntilTheBound)
{
  for (const double s : spacings)
  {
    for (const double rho : { 1.0, 7.0, 15.0 })
    {
      const SizingFunction sizing{ s, rho };
      for (std::size_t i = 1; i < shares.size(); ++i)
      {
        const double before = sizing.at(curvatureOf(shares[i - 1], s));
        const double after = sizing.at(curvatureOf(shares[i], s));
        if (shares[i] <= 8.0)
        {
          EXPECT_LT(after, before) << shares[i];
        }
        else
        {
          EXPECT_NEAR(after, before, 1e-12 * s) << shares[i];
        }
      }
    }
  }
}

TEST(SizingFunction, GrowsWithTheSpacingAtAnyCurvatureBelowTheBound)
{
  for (const double rho : densities)
  {
    for (const double curvature : { 0.0, 0.1, 2.0, 50.0 })
    {
      const double largest = curvature > 0.0 ? 16.0 * Pi / curvature : 10.0;
      double before = 0.0;
      for (double s = 0.05 * largest; s <= largest; s += 0.05 * largest)
      {
        const double h = SizingFunction{ s, rho }.at(curvature);
        EXPECT_GT(h, before) << s;
        before = h;
      }
    }
  }
}

TEST(SizingFunction, FallsWithAngularDensityWhereTheSurfaceBends)
{
  for (std::size_t i = 1; i < densities.size(); ++i)
  {
    const SizingFunction sparse{ 0.5, densities[i - 1] }, dense{ 0.5, densities[i] };
    EXPECT_EQ(dense.at(0.0), sparse.at(0.0));
    EXPECT_LT(dense.at(2.0), sparse.at(2.0));
  }
}

TEST(SizingFunction, ScalesWithTheUnitOfLength)
{
  const SizingFunction metres{ 0.5, 7.0 }, millimetres{ 500.0, 7.0 };
  EXPECT_NEAR(millimetres.at(2.0 / 1000.0), 1000.0 * metres.at(2.0), 1e-9);
}

} // namespace
} // namespace hop
