#include "Surface/Particles.h"

#include "AnalyticFields.h"
#include "ElementCases.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

TEST(Particle, AtAPlaceOfASphereKnowsTheSphere)
{
  constexpr double radius = 0.6;
  const KnownSurface ball = sphere({ 0, 0, 0 }, radius);
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.field = ball.field;
    const ElementMesh mesh = makeMesh(recipe);
    SurfaceWalker walker({ &mesh, 0.0, 1e-12 });
    Evaluated at;
    ASSERT_TRUE(walker.project({ 0, { { 0.3, 0.3, 0.3 } } }, 2.0, at)) << domain;
    at = walker.evaluateCurved(at.location);
    const Curvature bend = curvature(at.point.gradient, at.hessian);
    const Particle particle = particleAt(at.location, at.point, bend, 0.05);
    EXPECT_EQ(particle.location.element, at.location.element);
    EXPECT_EQ(particle.location.u.xyz, at.location.u.xyz);
    EXPECT_NEAR(glm::length(particle.position.xyz), radius, 1e-12);
    EXPECT_LE(glm::distance(particle.normal.xyz, ball.normal(particle.position.xyz)), 1e-12);
    EXPECT_NEAR(particle.curvature.mean, 1.0 / radius, 1e-9);
    EXPECT_NEAR(particle.curvature.gauss, 1.0 / (radius * radius), 1e-9);
    EXPECT_LE(particle.residual, 1e-12);
    EXPECT_EQ(particle.spacing, 0.05);
    // What the rooms above add is not there yet.
    EXPECT_FALSE(particle.clips[0].exists() || particle.clips[1].exists());
    EXPECT_EQ(particle.jump, 0.0);
    EXPECT_EQ(particle.radiusPerSpacing, 1.0);
  }
}

TEST(Particle, ResidualIsTheDistanceToTheSurfaceToFirstOrder)
{
  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3& x) { return 4.0 * (x.x - 0.25); };
  const ElementMesh mesh = makeMesh(recipe);
  SurfaceWalker walker({ &mesh, 0.0, 0.0 });
  for (const double u : { 0.1, 0.9 })
  {
    const Location place{ 0, { { u, 0.5, 0.5 } } };
    const Evaluated at = walker.evaluate(place);
    const double distance = std::abs(at.point.map.position.xyz.x - 0.25);
    EXPECT_NEAR(particleAt(place, at.point, {}, 1.0).residual, distance, 1e-12);
  }
}

TEST(Particle, IsUndersampledWhereFewerThanSixStandAround)
{
  for (const double radius : { 1e-3, 1.0, 1e3 })
  {
    Curvature tube, sphere, saddle;
    tube.mean = -0.5 / radius;
    sphere.mean = 1.0 / radius;
    sphere.gauss = 1.0 / (radius * radius);
    saddle.gauss = -1.0 / (radius * radius);
    for (const Curvature& curvature : { tube, sphere, saddle })
    {
      Particle particle;
      particle.curvature = curvature;
      particle.spacing = 2.0 * Pi * radius / 6.01;
      EXPECT_FALSE(particle.isUndersampled());
      particle.spacing = 2.0 * Pi * radius / 5.99;
      EXPECT_TRUE(particle.isUndersampled());
    }
  }
}

TEST(ClipPlane, BelongsToABoundaryCurveWhereItHasNoFace)
{
  ClipPlane plane;
  EXPECT_FALSE(plane.exists());
  EXPECT_FALSE(plane.isBoundary());
  plane.normal = { { 0, 0, 1 } };
  EXPECT_TRUE(plane.exists());
  EXPECT_TRUE(plane.isBoundary());
  plane.face = 2;
  EXPECT_TRUE(plane.exists());
  EXPECT_FALSE(plane.isBoundary());
}

} // namespace
} // namespace hop::testing
