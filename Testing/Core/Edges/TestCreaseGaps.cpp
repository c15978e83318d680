#include "Edges/CreaseGaps.h"

#include "Edges/FaceJumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double h = 0.1;

/// A plane of a particle in the plane z = 0: the direction of its normal, and its distance in units of the spacing.
ClipPlane planeTo(double degrees, double distance, double dihedralAngle)
{
  const double angle = glm::radians(degrees);
  return { { { std::cos(angle), std::sin(angle), 0.0 } }, distance * h, 0.0,
    static_cast<float>(dihedralAngle), dihedralAngle < Pi ? 0 : -1 };
}

/// A particle in the plane z = 0; its place in units of the spacing.
Particle particleAt(const glm::dvec2& place, const ClipPlane& first, const ClipPlane& second = {})
{
  Particle particle;
  particle.position = { { h * place.x, h * place.y, 0.0 } };
  particle.normal = { { 0, 0, 1 } };
  particle.spacing = h;
  particle.clips = { first, second };
  return particle;
}

/// The particles after the gaps are closed.
std::vector<Particle> closed(const std::vector<Particle>& particles)
{
  Buffer<Particle> free;
  for (const Particle& particle : particles)
  {
    free.push_back(particle);
  }
  Buffer<BoundaryParticle> none;
  const ParticleGrid all(free, none, {});
  closeCreaseGaps(all, {});
  return { free.begin(), free.end() };
}

double distanceAt(const Particle& particle, int plane)
{
  return particle.clips[plane].distance / h;
}

/// Two creases meet before a particle, and nobody is behind them: both planes give way until the splat stands off by a
/// quarter of a spacing, 0.25/sin(0.5) = 0.52 behind the crease: after five steps of 0.1, at half a step more.
TEST(CreaseGaps, PlanesGiveWayWhereNothingElseCovers)
{
  const auto result =
    closed({ particleAt({ 0, 0 }, planeTo(60, 0.2, 0.5), planeTo(-60, 0.2, 0.5)) });
  EXPECT_NEAR(distanceAt(result[0], 0), 0.2 + 0.55, 1e-6);
  EXPECT_NEAR(distanceAt(result[0], 1), 0.2 + 0.55, 1e-6);
}

/// Blunt creases: a splat stands off little, and covers as far as it reaches.
TEST(CreaseGaps, PlanesGiveWayAsFarAsSplatsReach)
{
  const auto result =
    closed({ particleAt({ 0, 0 }, planeTo(60, 0.2, 0.2), planeTo(-60, 0.2, 0.2)) });
  EXPECT_GT(distanceAt(result[0], 0), 0.8);
  EXPECT_LT(distanceAt(result[0], 0), 1.0);
}

TEST(CreaseGaps, PlanesStayWhereOthersCover)
{
  std::vector<Particle> particles{ particleAt(
    { 0, 0 }, planeTo(90, 0.2, 0.5), planeTo(0, 0.2, 0.5)) };
  // Behind the first plane, each with the same crease.
  for (const double x : { -0.9, -0.45, 0.0, 0.45, 0.9 })
  {
    particles.push_back(particleAt({ x, 0.5 }, planeTo(-90, 0.3, 0.5)));
  }
  const auto result = closed(particles);
  EXPECT_NEAR(distanceAt(result[0], 0), 0.2, 1e-12);
  EXPECT_NEAR(distanceAt(result[0], 1), 0.2 + 0.55, 1e-6);
}

/// As where the field jumps at a crease: behind it the surface lies half a spacing lower.
TEST(CreaseGaps, PlanesStayBeforeSteps)
{
  std::vector<Particle> particles{ particleAt(
    { 0, 0 }, planeTo(90, 0.2, 0.3), planeTo(0, 0.2, 0.3)) };
  for (const double x : { -0.8, -0.4, 0.0, 0.4, 0.8 })
  {
    particles.push_back(particleAt({ x, 0.6 }, {}));
    particles.back().position.xyz.z = -0.5 * h;
  }
  const auto result = closed(particles);
  EXPECT_DOUBLE_EQ(distanceAt(result[0], 0), 0.2);
  EXPECT_GT(distanceAt(result[0], 1), 0.6);
}

/// Of two particles that could cover a corner, the one whose plane is nearest to it does.
TEST(CreaseGaps, ThePlaneThatIsNearestGivesWay)
{
  // The planes of the second particle are nearer to both by 0.03.
  const double distance = 0.3 + 0.01 * std::sqrt(0.5) - 0.03;
  const auto result = closed({ particleAt({ 0, 0 }, planeTo(45, 0.3, 0.5), planeTo(-45, 0.3, 0.5)),
    particleAt({ -0.01, 0 }, planeTo(45, distance, 0.5), planeTo(-45, distance, 0.5)) });
  EXPECT_GT(distanceAt(result[0], 0), 0.5);
  EXPECT_GT(distanceAt(result[0], 1), 0.5);
  EXPECT_DOUBLE_EQ(distanceAt(result[1], 0), distance);
  EXPECT_DOUBLE_EQ(distanceAt(result[1], 1), distance);
}

/// A sliver between two creases that are parallel, without a particle of its own for 1.7 spacings: the splats on its sides
/// cover it. Where one stands in it, planes stay.
TEST(CreaseGaps, PlanesGiveWayInSliversBetweenParallelCreases)
{
  const auto sliver = [](bool hasItsOwn)
  {
    std::vector<Particle> particles;
    for (const double x : { -0.9, 0.0, 0.9 })
    {
      particles.push_back(particleAt({ x, -0.5 }, planeTo(90, 0.4, 0.3)));
      particles.push_back(particleAt({ x, 0.5 }, planeTo(-90, 0.4, 0.3)));
      if (hasItsOwn || x != 0.0)
      {
        const double along = hasItsOwn ? x : 1.4 * x;
        particles.push_back(
          particleAt({ along, 0 }, planeTo(90, 0.1, 0.3), planeTo(-90, 0.1, 0.3)));
      }
    }
    return closed(particles);
  };
  double most = 0.0;
  for (const Particle& particle : sliver(false))
  {
    most = std::max(most, distanceAt(particle, 0));
  }
  EXPECT_GT(most, 0.5);
  for (const Particle& particle : sliver(true))
  {
    if (std::abs(particle.position.xyz.x) < 0.5 * h)
    {
      EXPECT_LE(distanceAt(particle, 0), 0.41);
    }
  }
}

/// The same between a crease and a face at which the surface is almost smooth: splats fill 0.35 spacings behind the face,
/// the rest is left open. The plane of the face gives way, as a splat that goes on over it is hardly seen.
TEST(CreaseGaps, PlanesOfSmallAnglesGiveWayInWiderSlivers)
{
  const auto sliver = [](double width)
  {
    const double half = 0.5 * width;
    std::vector<Particle> particles;
    for (const double x : { -0.9, 0.0, 0.9 })
    {
      particles.push_back(particleAt({ x, -half - 0.1 }, planeTo(90, 0.1, 0.5)));
      particles.push_back(particleAt({ x, half + 0.1 }, planeTo(-90, 0.1, 0.9 * CreaseAngle)));
    }
    return closed(particles);
  };
  for (const bool isWide : { false, true })
  {
    const auto result = sliver(isWide ? 0.6 : 0.25); // the middle two have neighbours on both sides
    EXPECT_DOUBLE_EQ(distanceAt(result[2], 0), 0.1) << isWide;
    EXPECT_EQ(distanceAt(result[3], 0) > 0.25, isWide) << distanceAt(result[3], 0);
  }
}

TEST(CreaseGaps, BoundaryCurvesStay)
{
  const auto result =
    closed({ particleAt({ 0, 0 }, planeTo(60, 0.2, 0.5), planeTo(-60, 0.2, Pi)) });
  EXPECT_GT(distanceAt(result[0], 0), 0.21); // a boundary curve makes a corner
  EXPECT_DOUBLE_EQ(distanceAt(result[0], 1), 0.2);
}

/// Along a single face nothing gives way.
TEST(CreaseGaps, ASinglePlaneStays)
{
  for (const double angle : { 0.5, 0.9 * CreaseAngle })
  {
    EXPECT_DOUBLE_EQ(
      distanceAt(closed({ particleAt({ 0, 0 }, planeTo(60, 0.2, angle)) })[0], 0), 0.2);
  }
}

/// Where three faces of a cube meet: splats would stand off from what they cover at once.
TEST(CreaseGaps, PlanesOfACubeStay)
{
  std::vector<Particle> particles;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int left = (axis + 1) % 3;
    const int right = (axis + 2) % 3;
    glm::dvec3 place(0.0), normal(0.0), toLeft(0.0), toRight(0.0);
    place[left] = place[right] = -0.3 * h;
    normal[axis] = toLeft[left] = toRight[right] = 1.0;
    Particle particle;
    particle.position = { place };
    particle.normal = { normal };
    particle.spacing = h;
    particle.clips = { ClipPlane{ { toLeft }, 0.3 * h, 0.0, static_cast<float>(0.5 * Pi), 0 },
      ClipPlane{ { toRight }, 0.3 * h, 0.0, static_cast<float>(0.5 * Pi), 1 } };
    particles.push_back(particle);
  }
  for (const Particle& particle : closed(particles))
  {
    EXPECT_EQ(particle.clips[0].distance, 0.3 * h);
    EXPECT_EQ(particle.clips[1].distance, 0.3 * h);
  }
}

} // namespace
} // namespace hop::testing
