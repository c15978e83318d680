#include "Run/SpacingAdvice.h"

#include <gtest/gtest.h>

#include <limits>

namespace hop
{
namespace
{

Particle bentParticle(double curvatureMagnitude, double spacing)
{
  Particle particle;
  particle.curvature.magnitude = curvatureMagnitude;
  particle.curvature.mean = 0.5 * curvatureMagnitude; // a tube
  particle.spacing = spacing;
  return particle;
}

/// Particles of one curvature magnitude and spacing.
Distribution evenlyBent(std::size_t count, double curvatureMagnitude, double spacing)
{
  Distribution distribution;
  distribution.particles.assign(count, bentParticle(curvatureMagnitude, spacing));
  return distribution;
}

/// Curvature times spacing is 5 here, and particles follow 2 pi/6 at most.
const Distribution sphere = evenlyBent(100, 10.0, 0.5);

double twice(double)
{
  return 200.0;
}

TEST(SpacingAdvice, WarnsAboveTwoOfAHundred)
{
  Distribution distribution = evenlyBent(100, 1.0, 0.5);
  distribution.report.particlesUndersampled = 2;
  EXPECT_FALSE(hasTooManyUndersampled(distribution));
  distribution.report.particlesUndersampled = 3;
  EXPECT_TRUE(hasTooManyUndersampled(distribution));
}

/// Halved areas from 0.5 on, to two digits: 0.125 leaves curvature times spacing above 2 pi/6, 0.088 does not.
TEST(SpacingAdvice, IsTheLargestSpacingTriedThatFollowsTheSurface)
{
  double asked = 0.0;
  const SpacingAdvice advice = adviseSpacing(sphere, { 0.5, 0.0 }, 1.0,
    [&](double spacing)
    {
      EXPECT_EQ(asked, 0.0) << "asked once";
      asked = spacing;
      return 771.6;
    });
  EXPECT_DOUBLE_EQ(advice.spacing, 0.088);
  EXPECT_DOUBLE_EQ(asked, 0.088);
  EXPECT_EQ(advice.count, 772);
  EXPECT_FALSE(advice.isSingular);
}

/// What a user types has two digits in world units, whatever the unit of the run is.
TEST(SpacingAdvice, IsRoundedInWorldUnits)
{
  double asked = 0.0;
  const SpacingAdvice advice = adviseSpacing(sphere, { 0.5, 0.0 }, 2.0,
    [&](double spacing)
    {
      asked = spacing;
      return 200.0;
    });
  EXPECT_DOUBLE_EQ(advice.spacing, 0.18);
  EXPECT_DOUBLE_EQ(asked, 0.09) << "in the unit of the run";
  EXPECT_EQ(advice.unit, 2.0);
}

TEST(SpacingAdvice, TakesTenTimesTheParticlesAtMost)
{
  const auto times = [](double factor) { return [factor](double) { return factor * 100.0; }; };
  EXPECT_DOUBLE_EQ(adviseSpacing(sphere, { 0.5, 0.0 }, 1.0, times(10.0)).spacing, 0.088);
  const SpacingAdvice none = adviseSpacing(sphere, { 0.5, 0.0 }, 1.0, times(10.1));
  EXPECT_EQ(none.spacing, 0.0);
  EXPECT_EQ(none.count, 0);
}

/// Half of the particles stand at a tip that has less than a hundredth of the area.
TEST(SpacingAdvice, CountsParticlesByTheirArea)
{
  Distribution distribution = evenlyBent(50, 0.1, 1.0);
  const Distribution tip = evenlyBent(50, 100.0, 0.1);
  distribution.particles.insert(
    distribution.particles.end(), tip.particles.begin(), tip.particles.end());
  EXPECT_DOUBLE_EQ(adviseSpacing(distribution, { 1.0, 0.0 }, 1.0, twice).spacing, 0.71);
  const Distribution largerTip = evenlyBent(2, 100.0, 0.1);
  distribution.particles.insert(
    distribution.particles.end(), largerTip.particles.begin(), largerTip.particles.end());
  EXPECT_EQ(adviseSpacing(distribution, { 1.0, 0.0 }, 1.0, twice).spacing, 0.0);
}

/// With a given number of particles there is no spacing to begin with but that of the flattest place.
TEST(SpacingAdvice, BeginsAtTheLargestSpacingWhereANumberWasGiven)
{
  Distribution distribution = evenlyBent(100, 10.0, 0.6);
  distribution.particles[0] = bentParticle(10.0, 0.1);
  EXPECT_DOUBLE_EQ(adviseSpacing(distribution, { 0.0, 0.0 }, 1.0, twice).spacing, 0.075);
}

/// Sixteen times closer is not close enough: curvature times spacing is 2.2 there.
TEST(SpacingAdvice, EstimatesNothingWhereNoSpacingTriedFollows)
{
  const Distribution wire = evenlyBent(100, 70.4, 0.5);
  const SpacingAdvice advice = adviseSpacing(wire, { 0.5, 0.0 }, 1.0,
    [](double)
    {
      ADD_FAILURE() << "estimates take time";
      return 0.0;
    });
  EXPECT_EQ(advice.spacing, 0.0);
}

TEST(SpacingAdvice, KnowsWhereTheSurfaceIsSingular)
{
  Distribution distribution = evenlyBent(100, 10.0, 0.5);
  distribution.particles[42] = bentParticle(1000.0, 0.5);
  SpacingAdvice advice = adviseSpacing(distribution, { 0.5, 0.0 }, 1.0, twice);
  EXPECT_EQ(advice.worst, 42u);
  EXPECT_FALSE(advice.isSingular) << "a thin tube";
  distribution.particles[42] = bentParticle(2001.0, 0.5);
  EXPECT_TRUE(adviseSpacing(distribution, { 0.5, 0.0 }, 1.0, twice).isSingular);
  distribution.particles[42] = bentParticle(std::numeric_limits<double>::infinity(), 0.5);
  EXPECT_TRUE(adviseSpacing(distribution, { 0.5, 0.0 }, 1.0, twice).isSingular);
  Distribution reported = evenlyBent(100, 10.0, 0.5);
  reported.report.singularPoints = 1;
  EXPECT_TRUE(adviseSpacing(reported, { 0.5, 0.0 }, 1.0, twice).isSingular);
}

} // namespace
} // namespace hop
