// How splats bend: shape operators fitted to the particles around.
#include "Particles/FitShapes.h"
#include "Particles/SplatParticles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>

namespace
{
constexpr double Spacing = 0.1;

// A surface that bends along x only: its slope dz/dx and curvature, as functions of x.
struct Profile
{
  std::function<double(double)> Height, Slope, Bend;
};

// A circle of curvature 4.
Profile Circle()
{
  const auto across = [](double x) { return std::sqrt(1. / 16. - x * x); };
  return { [across](double x) { return across(x) - 0.25; },
    [across](double x) { return -x / across(x); }, [](double) { return 4.; } };
}

// Flat up to x = 0, then a parabola of curvature 4 in its middle: the curvature jumps. What a particle
// at the jump knows of it is that of one side.
Profile HalfFlat()
{
  return { [](double x) { return x > 0. ? -2. * x * x : 0.; },
    [](double x) { return x > 0. ? -4. * x : 0.; },
    [](double x) { return x >= 0. ? 4. / std::pow(1. + 16. * x * x, 1.5) : 0.; } };
}

// Flat up to x = 0, then falling at 6 degrees.
Profile Edge()
{
  return { [](double x) { return x > 0. ? -0.1 * x : 0.; },
    [](double x) { return x > 0. ? -0.1 : 0.; }, [](double) { return 0.; } };
}

// Flat up to x = 0, then flat again a step of 0.3 spacings higher.
Profile Step()
{
  return { [](double x) { return x > 0. ? 0.3 * Spacing : 0.; }, [](double) { return 0.; },
    [](double) { return 0.; } };
}

void Append(hop::SplatParticles& particles, const Profile& profile, double x, double y)
{
  const double slope = profile.Slope(x);
  const double length = std::hypot(1., slope);
  const double bend = profile.Bend(x);
  const float values[] = { float(x), float(y), float(profile.Height(x)), float(Spacing) };
  const float normal[] = { float(-slope / length), 0.f, float(1. / length), 0.f };
  // The tangent is (1, 0, slope) / length.
  const double xx = bend / (length * length);
  const float shape[] = { float(xx), 0.f, float(xx * slope * slope), 0.f, 0.f, 0.f,
    float(xx * slope), 0.f };
  particles.CentreRadius.insert(particles.CentreRadius.end(), values, values + 4);
  particles.Normal.insert(particles.Normal.end(), normal, normal + 4);
  particles.Shape.insert(particles.Shape.end(), shape, shape + 8);
  particles.PointIds.push_back(static_cast<vtkIdType>(particles.PointIds.size()));
}

// Five by five particles; the one in the middle, number 12, at x = 0.
constexpr vtkIdType Middle = 12;

hop::SplatParticles ParticlesOn(const Profile& profile)
{
  hop::SplatParticles particles;
  for (int row = -2; row <= 2; ++row)
  {
    for (int column = -2; column <= 2; ++column)
    {
      Append(particles, profile, Spacing * column, Spacing * row);
    }
  }
  return particles;
}

double BendOfMiddle(const hop::SplatParticles& particles)
{
  return particles.Shape[8 * Middle];
}

// The largest distance from the profile of a paraboloid in its middle, along x, up to a radius.
double LargestError(const Profile& profile, double bend)
{
  double error = 0.;
  for (int i = -10; i <= 10; ++i)
  {
    const double x = 0.1 * i * Spacing;
    error = std::max(error, std::abs(-0.5 * bend * x * x - profile.Height(x)));
  }
  return error;
}
}

TEST(SplatShapes, OfACircleAreNearlyItsOwn)
{
  hop::SplatParticles particles = ParticlesOn(Circle());
  const double own = BendOfMiddle(particles);
  hop::FitShapes(particles);
  // A parabola that stays near the circle bends a little more than it.
  EXPECT_GT(BendOfMiddle(particles), own);
  EXPECT_LT(BendOfMiddle(particles), 1.1 * own);
  EXPECT_LT(LargestError(Circle(), BendOfMiddle(particles)), LargestError(Circle(), own));
  for (int entry : { 1, 2, 4, 5, 6 })
  {
    EXPECT_NEAR(particles.Shape[8 * Middle + entry], 0., 0.01) << entry;
  }
}

TEST(SplatShapes, FitBothSidesWhereTheCurvatureJumps)
{
  hop::SplatParticles particles = ParticlesOn(HalfFlat());
  const double own = BendOfMiddle(particles);
  hop::FitShapes(particles);
  EXPECT_LT(LargestError(HalfFlat(), BendOfMiddle(particles)), 0.6 * LargestError(HalfFlat(), own));
}

TEST(SplatShapes, DoNotBendAroundAnEdgeThatParticlesKnowOf)
{
  hop::SplatParticles unaware = ParticlesOn(Edge());
  hop::FitShapes(unaware);
  EXPECT_GT(BendOfMiddle(unaware), 0.3);

  hop::SplatParticles aware = ParticlesOn(Edge());
  aware.ClipStride = 12;
  aware.Clip.assign(12 * aware.GetNumberOfParticles(), 0.f);
  aware.Clip[12 * Middle] = 1.f; // x > 0 is cut off
  hop::SplatParticles filling = aware;
  hop::FitShapes(aware);
  EXPECT_NEAR(BendOfMiddle(aware), 0., 1e-5);

  // Where the surface is almost smooth, neighbours behind count less.
  filling.Clip[12 * Middle + 8] = hop::SplatParticles::OverlapAt(5.);
  hop::FitShapes(filling);
  EXPECT_LT(BendOfMiddle(filling), 0.8 * BendOfMiddle(unaware));
  EXPECT_GT(BendOfMiddle(filling), 0.1 * BendOfMiddle(unaware));
}

// The edge is one cell farther off than the faces of the particle's own cell.
TEST(SplatShapes, DoNotBendAroundAnEdgeThatOnlyNeighborsKnowOf)
{
  hop::SplatParticles particles = ParticlesOn(Edge());
  particles.ClipStride = 12;
  particles.Clip.assign(12 * particles.GetNumberOfParticles(), 0.f);
  for (vtkIdType i = 0; i < particles.GetNumberOfParticles(); ++i)
  {
    const float x = particles.CentreRadius[4 * i];
    if (x > 0.f)
    {
      particles.Clip[12 * i] = -1.f; // x < 0.03 is cut off
      particles.Clip[12 * i + 3] = x - 0.03f;
    }
  }
  hop::FitShapes(particles);
  EXPECT_NEAR(BendOfMiddle(particles), 0., 1e-5);
}

TEST(SplatShapes, DoNotSeeAnotherSheet)
{
  hop::SplatParticles alone = ParticlesOn(Circle());
  hop::SplatParticles two = alone;
  Profile above = Circle();
  above.Height = [](double x) { return Circle().Height(x) + Spacing; };
  Append(two, above, 0., 0.);
  hop::FitShapes(alone);
  hop::FitShapes(two);
  EXPECT_FLOAT_EQ(BendOfMiddle(alone), BendOfMiddle(two));
}

TEST(SplatShapes, DoNotBendTowardsALayerNearby)
{
  hop::SplatParticles particles = ParticlesOn(Step());
  hop::FitShapes(particles);
  EXPECT_NEAR(BendOfMiddle(particles), 0., 1e-5);
}

TEST(SplatShapes, OfAParticleWithoutNeighborsAreItsOwn)
{
  hop::SplatParticles particles;
  Append(particles, Circle(), 0., 0.);
  hop::FitShapes(particles);
  EXPECT_FLOAT_EQ(particles.Shape[0], 4.f);
  EXPECT_FLOAT_EQ(particles.Shape[1], 0.f);
}

TEST(SplatShapes, AreFoundInTimeWhateverTheRadii)
{
  // Radii of a hundred spacings: looking at all that they hold takes minutes.
  hop::SplatParticles particles;
  for (int i = 0; i < 40000; ++i)
  {
    Append(particles, Circle(), 1e-3 * (i % 200 - 100), 1e-3 * (i / 200));
    particles.CentreRadius.back() = 0.1f;
  }
  const std::clock_t start = std::clock(); // processor time: other programs do not count
  hop::FitShapes(particles);
  EXPECT_LT(std::clock() - start, 20 * CLOCKS_PER_SEC);
  constexpr int middle = 100 * 200 + 100;
  EXPECT_NEAR(particles.Shape[8 * middle], 4., 0.01);
}

TEST(SplatShapes, OfParticlesInOnePlaceAreTheirOwn)
{
  hop::SplatParticles particles;
  for (int i = 0; i < 1000; ++i)
  {
    Append(particles, Circle(), 0., 0.);
  }
  hop::FitShapes(particles);
  EXPECT_FLOAT_EQ(particles.Shape[0], 4.f);
}

TEST(SplatShapes, OfParticlesThatAreNotDrawnStayAsTheyAre)
{
  hop::SplatParticles particles = ParticlesOn(HalfFlat());
  particles.CentreRadius[4 * Middle + 3] = 0.f;
  const double own = BendOfMiddle(particles);
  hop::FitShapes(particles);
  EXPECT_EQ(BendOfMiddle(particles), own);
}
