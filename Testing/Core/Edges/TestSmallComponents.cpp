#include "Edges/SmallComponents.h"

#include "Common/SplatProfile.h"
#include "Fast/FastDistribution.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.02;

Distribution distributeIn(const ElementMesh& mesh)
{
  DistributionParameters parameters;
  parameters.sizing = { spacing, 0.0 };
  return distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {});
}

/// The triangle that a plane cuts off a corner of a cube; its sides are so many spacings long.
ElementMesh cutCorner(double sides)
{
  MeshRecipe recipe;
  recipe.cells = 1;
  const double sum = sides * spacing / std::sqrt(2.0) - 3.0;
  recipe.field = [=](const glm::dvec3& x) { return x.x + x.y + x.z - sum; };
  return makeMesh(recipe);
}

TEST(SmallPieces, AreDrawnAboutAsLargeAsTheyAre)
{
  for (const double sides : { 0.05, 0.1, 0.2, 0.4 })
  {
    const Distribution result = distributeIn(cutCorner(sides));
    ASSERT_EQ(result.particles.size(), 1u) << sides;
    const Particle& particle = result.particles[0];
    ASSERT_TRUE(particle.clips[0].exists() && particle.clips[1].exists());
    const double sector = Pi - angleBetween(particle.clips[0].normal, particle.clips[1].normal);
    const double radius = splatReach() * particle.radiusPerSpacing * particle.spacing;
    const double drawn = 0.5 * sector * radius * radius;
    const double area = 0.25 * std::sqrt(3.0) * sides * sides * spacing * spacing;
    EXPECT_NEAR(drawn / area, 1.0, 0.1) << sides;
  }
}

TEST(SmallPieces, DoNotVanish)
{
  const Distribution result = distributeIn(cutCorner(1e-6));
  ASSERT_EQ(result.particles.size(), 1u);
  EXPECT_GT(result.particles[0].radiusPerSpacing, 0.01);
  EXPECT_LT(result.particles[0].radiusPerSpacing, 0.1);
}

TEST(SmallPieces, LeaveAllOthersAsTheyAre)
{
  for (const double sides : { 3.0, 10.0, 50.0 })
  {
    const Distribution result = distributeIn(cutCorner(sides));
    EXPECT_GT(result.particles.size(), 6u);
    for (const Particle& particle : result.particles)
    {
      EXPECT_EQ(particle.radiusPerSpacing, 1.0);
    }
  }
}

} // namespace
} // namespace hop::testing
