// The weights of a splat, and how far it makes a surface.
#include "Common/SplatProfile.h"

#include <gtest/gtest.h>

#include <cmath>

using hop::SplatProfile;

TEST(SplatProfile, FallsFromOneInTheMiddleToZeroAtTheRim)
{
  for (const double sharpness : { 0.1, 2., 20. })
  {
    const SplatProfile profile{ sharpness };
    EXPECT_DOUBLE_EQ(profile.weight(0.), 1.) << sharpness;
    EXPECT_DOUBLE_EQ(profile.weight(1.), 0.) << sharpness;
    for (int step = 1; step <= 100; ++step)
    {
      EXPECT_LT(profile.weight(0.01 * step), profile.weight(0.01 * (step - 1)))
        << sharpness << ", " << step;
    }
  }
}

TEST(SplatProfile, IsSteeperTheSharperItIs)
{
  for (const double radius : { 0.1, 0.5, 0.9 })
  {
    EXPECT_LT(SplatProfile{ 4. }.weight(radius), SplatProfile{ 2. }.weight(radius)) << radius;
    EXPECT_LT(SplatProfile{ 2. }.weight(radius), SplatProfile{ 0.5 }.weight(radius)) << radius;
  }
}

TEST(SplatProfile, RadiusIsTheInverseOfWeight)
{
  for (const double sharpness : { 0.1, 2., 20. })
  {
    const SplatProfile profile{ sharpness };
    for (const double weight : { 1e-3, 0.05, 0.5, 0.99 })
    {
      EXPECT_NEAR(profile.weight(profile.radiusOf(weight)), weight, 1e-12)
        << sharpness << ", " << weight;
    }
  }
}

TEST(SplatProfile, ReachesToWhereTheWeightIsATwentieth)
{
  EXPECT_NEAR(hop::splatReach(), 0.928, 5e-4);
  // The profile itself, written out.
  const double atRim = std::exp(-2.);
  const double gaussian = std::exp(-2. * hop::splatReach() * hop::splatReach());
  EXPECT_NEAR((gaussian - atRim) / (1. - atRim), 1. / 20., 1e-12);
}
