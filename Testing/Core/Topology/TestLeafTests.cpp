#include "Topology/LeafTests.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

/// F = z - g(x, y) with the coefficients 0.3 of g but for one: it rises along z everywhere.
std::vector<double> above(int i, int j, double coefficient)
{
  std::vector<double> values;
  for (int k = 0; k < 2; ++k)
  {
    for (int n = 0; n < 9; ++n)
    {
      values.push_back(k - (n == i + 3 * j ? coefficient : 0.3));
    }
  }
  return values;
}

LeafSurface examine(const std::vector<double>& values, std::uint8_t& signs)
{
  return LeafTests({ 2, 2, 1 }).examine(values, 1e-12, signs);
}

LeafSurface examine(const std::vector<double>& values)
{
  std::uint8_t signs = 0;
  return examine(values, signs);
}

TEST(LeafTests, FindsADisc)
{
  std::uint8_t signs = 0;
  EXPECT_EQ(examine(above(1, 1, 0.3), signs), LeafSurface::Disc);
  EXPECT_EQ(signs, 0xF0);
  EXPECT_EQ(examine(above(0, 0, 1.3), signs), LeafSurface::Disc);
  EXPECT_EQ(signs, 0xE0);
}

TEST(LeafTests, FindsThatThereIsNothing)
{
  std::vector<double> values = above(1, 1, 0.3);
  for (double& value : values)
  {
    value += 1.0;
  }
  EXPECT_EQ(examine(values), LeafSurface::Empty);
}

TEST(LeafTests, ClosedCurvesInFacesAreNotDecided)
{
  // At the middle of the face above g is 0.75 * 0.3 + 0.25 * 4 > 1: the surface leaves the leaf by a closed curve.
  EXPECT_EQ(examine(above(1, 1, 4.0)), LeafSurface::Undecided);
}

TEST(LeafTests, TwoPointsOnAnEdgeAreNotDecided)
{
  EXPECT_EQ(examine(above(1, 0, 4.0)), LeafSurface::Undecided);
}

TEST(LeafTests, TwoArcsInAFaceAreNotDecided)
{
  // Above, g is larger than one at two opposite corners.
  std::vector<double> values = above(0, 0, 1.5);
  values[8] = -1.5;
  values[17] = -0.5;
  EXPECT_EQ(examine(values), LeafSurface::Undecided);
}

TEST(LeafTests, ZerosAtCornersAreTold)
{
  EXPECT_EQ(examine(above(0, 0, 1.0)), LeafSurface::ZeroAtCorner);
}

TEST(LeafTests, FieldsThatRiseNowhereAreNotDecided)
{
  // A saddle through the middle of the leaf.
  std::vector<double> values;
  for (int k = 0; k < 2; ++k)
  {
    for (int n = 0; n < 9; ++n)
    {
      values.push_back((n % 3 - 1.05) * (n / 3 - 1.05) + 0.01 * k);
    }
  }
  EXPECT_EQ(examine(values), LeafSurface::Undecided);
}

} // namespace
} // namespace hop::testing
