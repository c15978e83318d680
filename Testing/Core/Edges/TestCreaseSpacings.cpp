#include "Edges/CreaseSpacings.h"

#include "DistributionMeasures.h"
#include "Fast/FastDistribution.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;
constexpr double spacing = 0.05;
constexpr double slope = 0.5;

/// A roof, z = 0.1 - slope |x|: its ridge runs along faces of elements, which match or do not.
ElementMesh roof(bool matching)
{
  MeshRecipe left, right;
  left.field = [](const glm::dvec3& x) { return x.z - 0.1 - slope * x.x; };
  right.field = [](const glm::dvec3& x) { return x.z - 0.1 + slope * x.x; };
  if (!matching)
  {
    return hangingMesh(left, right);
  }
  ElementMesh mesh;
  appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, right, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

Distribution distribute(
  const ElementMesh& mesh, double angularDensity, const ParallelFor& parallelFor = {})
{
  DistributionParameters parameters;
  parameters.sizing = { spacing, angularDensity };
  return distributeFast({ &mesh, 0.0, tolerance }, parameters, {}, parallelFor);
}

TEST(CreaseSpacings, AreThoseOfASurfaceThatTurnsWithinOneSpacing)
{
  // A quarter turn, rho = 8: 1 + 8/4 times denser along a line, whatever the spacing.
  EXPECT_NEAR(spacingAtCrease({ 0.1, 8.0 }, 0.5 * Pi), 0.1 / 3.0, 1e-12);
  EXPECT_NEAR(spacingAtCrease({ 7.0, 8.0 }, 0.5 * Pi), 7.0 / 3.0, 1e-12);
  EXPECT_EQ(spacingAtCrease({ 0.1, 8.0 }, 0.0), 0.1);
  EXPECT_EQ(spacingAtCrease({ 0.1, 0.0 }, 0.5 * Pi), 0.1);
}

class SpacingsAtARidge : public ::testing::TestWithParam<std::tuple<double, bool>>
{
};

INSTANTIATE_TEST_SUITE_P(CreaseSpacings, SpacingsAtARidge,
  ::testing::Combine(::testing::Values(4.0, 7.0, 15.0), ::testing::Bool()),
  [](const auto& which)
  {
    return "Density" + std::to_string(static_cast<int>(std::get<0>(which.param))) +
      (std::get<1>(which.param) ? "Matching" : "Hanging");
  });

TEST_P(SpacingsAtARidge, AreSmallerAndGraded)
{
  const auto& [density, matching] = this->GetParam();
  const Distribution result = distribute(roof(matching), density);
  const double atRidge = spacingAtCrease({ spacing, density }, 2.0 * std::atan(slope));
  ASSERT_LT(atRidge, 0.7 * spacing);
  const auto wantedAt = [&](double distance)
  { return std::min(spacing, atRidge + SizingField::GradationSlope * distance); };
  const double perX = std::hypot(1.0, slope);
  for (const Particle& p : result.particles)
  {
    const double distance = std::abs(p.position.xyz.x) * perX;
    EXPECT_GE(p.spacing, 0.99 * wantedAt(distance));
    EXPECT_LE(p.spacing, 1.1 * wantedAt(distance));
  }

  double wanted = 0.0;
  constexpr int pieces = 1000;
  for (int n = 0; n < pieces; ++n)
  {
    const double h = wantedAt((n + 0.5) / pieces * perX);
    wanted += 2.0 * (hexagonalCount(2.0 * perX / pieces, h) + 2.0 * 0.5 * perX / pieces / h);
  }
  wanted += 2.0 * 0.5 * 2.0 / spacing;
  EXPECT_NEAR(static_cast<double>(result.particles.size()) / wanted, 1.0, 0.06);

  // No less even than at the same ridge without angular density, 0.62; where spacings are graded the
  // nearest neighbour is one that wants less.
  const Evenness evenness = measureEvenness(result.particles);
  EXPECT_GE(evenness.minSpacing, 0.55);
  EXPECT_LE(evenness.variation, 0.10);
  EXPECT_LE(evenness.circumradius, 1.0);
  EXPECT_GE(evenness.worstMinAngle, 20.0);
}

TEST(CreaseSpacings, ChangeNothingWithoutAngularDensity)
{
  for (const Particle& p : distribute(roof(true), 0.0).particles)
  {
    EXPECT_EQ(p.spacing, spacing);
  }
}

TEST(CreaseSpacings, ClipPlanesAreAtTheRidgeThoughItsFacesDoNotMatch)
{
  int atRidge = 0;
  int clipped = 0;
  for (const Particle& p : distribute(roof(false), 0.0).particles)
  {
    const glm::dvec3 x = p.position.xyz;
    if (std::abs(x.x) <= spacing && std::abs(x.y) <= 1.0 - 2.0 * spacing)
    {
      ++atRidge;
      clipped += p.clips[0].exists();
      EXPECT_TRUE(!p.clips[0].exists() || std::abs(p.clips[0].normal.xyz.x) > 1.0 - 1e-9);
      EXPECT_TRUE(!p.clips[0].exists() || std::abs(p.clips[0].distance - std::abs(x.x)) < 1e-9);
    }
  }
  // One may lie too far from all behind.
  EXPECT_GE(clipped, atRidge - 2);
  EXPECT_GT(atRidge, 30);
}

TEST(CreaseSpacings, AllowAGivenNumberOfParticles)
{
  const ElementMesh mesh = roof(true);
  DistributionParameters parameters;
  parameters.sizing = { spacing, 7.0 };
  parameters.particleCount = 3000;
  const Distribution result = distributeFast({ &mesh, 0.0, tolerance }, parameters, {}, {});
  EXPECT_EQ(result.particles.size(), 3000u);
  EXPECT_GE(measureEvenness(result.particles).minSpacing, 0.2);
}

TEST(CreaseSpacings, DoNotDependOnThreads)
{
  const ElementMesh mesh = roof(false);
  const Distribution serial = distribute(mesh, 7.0);
  for (const int threads : { 1, 2, 3, 8 })
  {
    const Distribution other = distribute(mesh, 7.0, threadedFor(threads));
    EXPECT_EQ(other.report.evaluations, serial.report.evaluations);
    ASSERT_EQ(other.particles.size(), serial.particles.size());
    for (std::size_t i = 0; i < serial.particles.size(); ++i)
    {
      ASSERT_EQ(other.particles[i].position.xyz, serial.particles[i].position.xyz);
      ASSERT_EQ(other.particles[i].spacing, serial.particles[i].spacing);
    }
  }
}

} // namespace
} // namespace hop::testing
