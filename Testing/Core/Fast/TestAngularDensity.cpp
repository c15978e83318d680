// Eq. (6) on thin tubes: how many particles stand around them.

#include "Fast/FastDistribution.h"

#include "AnalyticFields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double radius = 0.02;

/// A surface in the cube [-1,1]^3.
Distribution distribute(const KnownSurface& surface, const SizingFunction& sizing)
{
  MeshRecipe recipe;
  recipe.field = surface.field;
  const ElementMesh mesh = makeMesh(recipe);
  DistributionParameters parameters;
  parameters.sizing = sizing;
  return distributeFast({ &mesh, 0.0, 1e-10 }, parameters, {}, {});
}

/// Along the z axis.
Distribution onTube(const SizingFunction& sizing)
{
  return distribute(cylinder(radius), sizing);
}

/// The number of particles around that their number on the middle half of the tube tells: with N particles on an area
/// A the spacing of hexagonal packing is sqrt(2 A/(sqrt(3) N)).
double countAround(const Distribution& distribution)
{
  int count = 0;
  for (const Particle& p : distribution.particles)
  {
    count += std::abs(p.position.xyz.z) < 0.5;
  }
  const double around = 2.0 * Pi * radius;
  return around / std::sqrt(2.0 * around / (std::sqrt(3.0) * count));
}

/// By s/R.
class AngularDensityOfThinSurfaces : public ::testing::TestWithParam<double>
{
};

INSTANTIATE_TEST_SUITE_P(
  Fast, AngularDensityOfThinSurfaces, ::testing::Values(1.0, 2.0, 5.0, 10.0, 20.0, 40.0));

TEST_P(AngularDensityOfThinSurfaces, IsTheNumberOfParticlesAround)
{
  const double spacing = this->GetParam() * radius;
  for (const double density : { 6.0, 10.0, 15.0 })
  {
    const Distribution result = onTube({ spacing, density });
    const double wanted = density + 2.0 * Pi * radius / spacing;
    EXPECT_NEAR(countAround(result) / wanted, 1.0, 0.15) << density;
    EXPECT_EQ(result.report.particlesUndersampled, 0) << density;
  }
}

TEST_P(AngularDensityOfThinSurfaces, IsToldWhereFewerThanSixStandAround)
{
  const double spacing = this->GetParam() * radius;
  const Distribution result = onTube({ spacing, 2.0 });
  const auto count = static_cast<std::int64_t>(result.particles.size());
  ASSERT_GT(count, 0);
  EXPECT_EQ(
    result.report.particlesUndersampled, 2.0 + 2.0 * Pi * radius / spacing < 6.0 ? count : 0);
}

/// Also off the corners of the elements' boxes, where other numbers of boxes hold the sphere.
TEST_P(AngularDensityOfThinSurfaces, GivesASmallComponentSixParticlesAndMore)
{
  for (const glm::dvec3& center : { glm::dvec3(0.0), glm::dvec3(0.31, 0.27, -0.43) })
  {
    for (const double density : { 6.0, 10.0 })
    {
      const Distribution result =
        distribute(sphere(center, radius), { this->GetParam() * radius, density });
      EXPECT_GE(result.particles.size(), 6u) << density;
    }
  }
}

TEST(AngularDensity, EndsAtTheSmallestSpacing)
{
  constexpr double spacing = 20.0 * radius, smallest = 1.5 * radius;
  const Distribution result = onTube({ spacing, 10.0, smallest });
  EXPECT_NEAR(
    countAround(result), 2.0 * Pi * radius / smallest, 0.15 * 2.0 * Pi * radius / smallest);
  for (const Particle& p : result.particles)
  {
    EXPECT_GE(p.spacing, 0.999 * smallest);
  }
}

} // namespace
} // namespace hop::testing
