#include "Fast/FinishParticles.h"

#include "MovingOnSphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

FinishedParticles finish(const MovingOnSphere& on, MovingParticles& moving)
{
  const FaceJumps jumps = findFaceJumps(on.surface, on.proxy, {});
  return finishParticles(moving, jumps, on.sizing, threadedFor(2));
}

TEST(FinishParticles, AllLieOnTheSurfaceWithWhatBelongsToIt)
{
  for (const double angularDensity : { 0.0, 7.0 })
  {
    SCOPED_TRACE(angularDensity);
    const MovingOnSphere on({ 0.1, angularDensity });
    const auto moving = on.relaxed();
    ASSERT_GT(moving->count(), 500u);
    const FinishedParticles finished = finish(on, *moving);
    ASSERT_EQ(finished.particles.size(), moving->count());
    ASSERT_EQ(finished.converged, std::vector<char>(moving->count(), 1));
    for (std::size_t i = 0; i < moving->count(); ++i)
    {
      const Particle& p = finished.particles[i];
      const glm::dvec3 x = p.position.xyz;
      EXPECT_NEAR(glm::length(x), MovingOnSphere::Radius, 2.0 * MovingOnSphere::Tolerance);
      EXPECT_LE(p.residual, MovingOnSphere::Tolerance);
      EXPECT_LE(glm::distance(p.normal.xyz, glm::normalize(x)), 1e-8);
      EXPECT_NEAR(p.curvature.magnitude, std::sqrt(2.0) / MovingOnSphere::Radius, 1e-6);
      EXPECT_NEAR(p.spacing, on.sizing.at(p.curvature.magnitude), 1e-6);
      // The particle that moved stands there now, near where it was.
      EXPECT_EQ(moving->patches()[i].position, x);
      EXPECT_EQ(moving->anchors()[i].offset, 0.0f);
    }
  }
}

TEST(FinishParticles, OneEvaluationIsEnoughForMostAfterRelaxation)
{
  const MovingOnSphere on;
  const auto moving = on.relaxed();
  const FinishedParticles finished = finish(on, *moving);
  EXPECT_GE(finished.evaluations, static_cast<std::int64_t>(moving->count()));
  EXPECT_LE(finished.evaluations, static_cast<std::int64_t>(2 * moving->count()));
}

TEST(FinishParticles, FarStartsAreFollowedOneByOne)
{
  // Half a spacing off, and with an anchor that says so only to first order: some steps of Newton's method.
  const MovingOnSphere on({ 0.4, 0.0 });
  Isosurface shifted = on.surface;
  shifted.isovalue = 0.25; // The sphere of radius 0.49.
  MovingParticles moving(shifted, on.proxy, {}, {});
  const auto outer = on.relaxed();
  moving.add(outer->anchors(), outer->patches());
  const FaceJumps jumps = findFaceJumps(on.surface, on.proxy, {});
  const FinishedParticles finished = finishParticles(moving, jumps, on.sizing, {});
  ASSERT_GT(moving.count(), 10u);
  EXPECT_EQ(finished.converged, std::vector<char>(moving.count(), 1));
  for (const Particle& p : finished.particles)
  {
    EXPECT_NEAR(glm::length(p.position.xyz), std::sqrt(0.24), 2.0 * MovingOnSphere::Tolerance);
  }
}

TEST(FinishParticles, ParticlesWithoutASurfaceAreMarkedAndStayFinite)
{
  const MovingOnSphere on;
  Isosurface without = on.surface;
  without.isovalue = 10.0; // More than the field has anywhere.
  MovingParticles moving(without, on.proxy, {}, {});
  const auto elsewhere = on.relaxed();
  moving.add(elsewhere->anchors(), elsewhere->patches());
  const FaceJumps jumps = findFaceJumps(on.surface, on.proxy, {});
  const FinishedParticles finished = finishParticles(moving, jumps, on.sizing, {});
  EXPECT_EQ(finished.converged, std::vector<char>(moving.count(), 0));
  for (const Patch& patch : moving.patches())
  {
    EXPECT_TRUE(std::isfinite(glm::length(patch.position)));
  }
}

TEST(FinishParticles, DoesNotDependOnThreads)
{
  const MovingOnSphere on;
  const auto moving = on.relaxed();
  MovingParticles alone(on.surface, on.proxy, {}, {});
  alone.add(moving->anchors(), moving->patches());
  const FaceJumps jumps = findFaceJumps(on.surface, on.proxy, {});
  const FinishedParticles first = finishParticles(alone, jumps, on.sizing, {});
  const FinishedParticles second = finishParticles(*moving, jumps, on.sizing, threadedFor(3));
  ASSERT_EQ(first.particles.size(), second.particles.size());
  for (std::size_t i = 0; i < first.particles.size(); ++i)
  {
    EXPECT_EQ(first.particles[i].position.xyz, second.particles[i].position.xyz);
  }
  EXPECT_EQ(first.evaluations, second.evaluations);
}

} // namespace
} // namespace hop::testing
