// Which particles lie beside a layer of the surface that is a step higher or lower.
#include "Particles/MarkLayers.h"
#include "Particles/SplatParticles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
constexpr float Radius = 0.1f;

// Rows of particles along x on both sides of x = 0, at which splats end; those on the right are higher by a step, and all
// lie on a circle of this curvature otherwise.
hop::SplatParticles Particles(double step, double curvature)
{
  hop::SplatParticles particles;
  particles.ClipStride = 12;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = -4; column < 4; ++column)
    {
      const double x = Radius * (column + 0.5);
      const double slope = -curvature * x;
      const double length = std::hypot(1., slope);
      const double z = -0.5 * curvature * x * x + (x > 0. ? step * Radius : 0.);
      particles.CentreRadius.insert(
        particles.CentreRadius.end(), { float(x), Radius * row, float(z), Radius });
      particles.Normal.insert(
        particles.Normal.end(), { float(-slope / length), 0.f, float(1. / length), 2.f });
      const float outward = x > 0. ? -1.f : 1.f;
      particles.Clip.insert(particles.Clip.end(), { outward, 0.f, 0.f, float(std::abs(x)) });
      particles.Clip.insert(particles.Clip.end(), 8, 0.f);
      particles.PointIds.push_back(static_cast<vtkIdType>(particles.PointIds.size()));
    }
  }
  hop::MarkLayers(particles);
  return particles;
}
}

TEST(MarkLayers, MarksParticlesOnBothSidesOfAStep)
{
  for (const double step : { 0.2, -0.7 })
  {
    const hop::SplatParticles particles = Particles(step, 0.);
    EXPECT_TRUE(particles.HasLayers);
    for (std::size_t i = 0; i < particles.PointIds.size(); ++i)
    {
      const bool isBeside = std::abs(particles.CentreRadius[4 * i]) < Radius;
      EXPECT_EQ(particles.Normal[4 * i + 3], isBeside ? 2.5f : 2.f);
    }
  }
}

TEST(MarkLayers, MarksNothingWhereTheSurfaceGoesOn)
{
  EXPECT_FALSE(Particles(0.03, 0.).HasLayers);
  EXPECT_FALSE(Particles(0., 4.).HasLayers); // the normal turns by 0.4 from particle to particle
}

// Two sheets, the upper one a few columns longer: nothing ends above the middle of the overlap. The distance is in radii.
TEST(MarkLayers, MarksSheetsThatLieOverEachOther)
{
  for (const double height : { 0.3, 0.8 })
  {
    hop::SplatParticles particles;
    particles.ClipStride = 12;
    for (int sheet = 0; sheet < 2; ++sheet)
    {
      for (int column = 0; column < 12 - 4 * sheet; ++column)
      {
        const double x = Radius * (column + 0.3 * sheet);
        particles.CentreRadius.insert(
          particles.CentreRadius.end(), { float(x), 0.f, float(sheet * height * Radius), Radius });
        particles.Normal.insert(particles.Normal.end(), { 0.f, 0.f, 1.f, 2.f });
        particles.Clip.insert(particles.Clip.end(), 12, 0.f);
        particles.PointIds.push_back(static_cast<vtkIdType>(particles.PointIds.size()));
      }
    }
    hop::SplatParticles apart = particles;
    hop::MarkLayers(particles);
    EXPECT_TRUE(particles.HasLayers);
    for (int column = 0; column < 8; ++column)
    {
      EXPECT_EQ(particles.Normal[4 * column + 3], 2.5f) << height << " below at " << column;
      EXPECT_EQ(particles.Normal[4 * (12 + column) + 3], 2.5f) << height << " above at " << column;
    }
    EXPECT_EQ(particles.Normal[4 * 11 + 3], 2.f);
    for (std::size_t i = 12; i < apart.PointIds.size(); ++i)
    {
      apart.Normal[4 * i + 3] = 4.f; // another isovalue
    }
    hop::MarkLayers(apart);
    EXPECT_FALSE(apart.HasLayers);
  }
}
