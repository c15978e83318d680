#include "Edges/ClipPlanes.h"

#include "Common/SplatProfile.h"
#include "Elements/CornerNumbers.h"
#include "Fast/FastDistribution.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.05;

/// A roof, z = 0.1 - slope |x|, on the right higher by a step: its ridge runs along faces of elements.
Distribution distributeOnRoof(double slope, double step = 0.0, double density = 0.0)
{
  MeshRecipe left, right;
  left.field = [=](const glm::dvec3& x) { return x.z - 0.1 - slope * x.x; };
  right.field = [=](const glm::dvec3& x) { return x.z - 0.1 - step + slope * x.x; };
  ElementMesh mesh;
  appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, right, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  DistributionParameters parameters;
  parameters.sizing = { spacing, density };
  return distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {});
}

/// The particles beside the ridge and far from the faces of the cube.
std::vector<Particle> besideRidge(const Distribution& distribution, double farthest)
{
  std::vector<Particle> found;
  std::copy_if(distribution.particles.begin(), distribution.particles.end(),
    std::back_inserter(found),
    [=](const Particle& p)
    {
      return std::abs(p.position.xyz.x) <= farthest &&
        std::abs(p.position.xyz.y) <= 1.0 - 2.0 * spacing;
    });
  return found;
}

TEST(ClipPlanes, AreAtCreasesWhereAParticleBehindCoversWhatIsCutOff)
{
  const Distribution result = distributeOnRoof(0.5);
  const auto isCovered = [&](const glm::dvec3& x)
  {
    const glm::dvec3 foot(0.0, x.y, x.z);
    return std::any_of(result.particles.begin(), result.particles.end(),
      [&](const Particle& other) {
        return other.position.xyz.x * x.x < 0.0 &&
          glm::distance(other.position.xyz, foot) <= spacing;
      });
  };
  int atRidge = 0;
  for (const Particle& p : besideRidge(result, 0.8 * spacing))
  {
    if (isCovered(p.position.xyz))
    {
      ++atRidge;
      EXPECT_NEAR(std::abs(p.clips[0].normal.xyz.x), 1.0, 1e-9);
      EXPECT_NEAR(p.clips[0].distance, std::abs(p.position.xyz.x), 1e-9);
      EXPECT_NEAR(p.clips[0].edgeCurvature, 0.0, 1e-9);
      EXPECT_NEAR(p.clips[0].dihedralAngle, 2.0 * std::atan(0.5), 1e-6);
      EXPECT_EQ(p.jump, 0.0);
    }
  }
  EXPECT_GT(atRidge, 30);
}

/// A facet between two creases that is too narrow for particles: splats of both sides go on over the creases, but know
/// where they are.
TEST(ClipPlanes, AreOpenAtCreasesBehindWhichNoParticleStands)
{
  constexpr double width = 0.1 * spacing;
  MeshRecipe left, middle, right;
  left.field = [](const glm::dvec3& x) { return x.z - 0.4 * x.x; };
  middle.field = [](const glm::dvec3& x) { return x.z + 0.6 * x.x; };
  right.field = [](const glm::dvec3& x) { return x.z + 0.4 * width + 0.2 * x.x; };
  ElementMesh mesh;
  appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, middle, { 0, -1, -1 }, { width, 1, 1 });
  appendBox(mesh, right, { width, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  DistributionParameters parameters;
  parameters.sizing = { spacing };
  const Distribution result = distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {});
  int open = 0;
  for (const Particle& p : besideRidge(result, 0.8 * spacing))
  {
    if (p.clips[0].isOpen())
    {
      ++open;
      const double crease = p.position.xyz.x < 0.0 ? 0.0 : width;
      EXPECT_NEAR(std::abs(p.clips[0].normal.xyz.x), 1.0, 1e-9);
      EXPECT_NEAR(p.clips[0].distance, std::abs(p.position.xyz.x - crease), 1e-9);
    }
  }
  EXPECT_GT(open, 20);
}

/// Where spacings are finest, a little farther off coarser splats cover what is cut off.
TEST(ClipPlanes, AreAtCreasesThatParticlesStandCloserTo)
{
  const auto particles = besideRidge(distributeOnRoof(0.5, 0.0, 10.0), 0.1 * spacing);
  EXPECT_GT(particles.size(), 5u);
  for (const Particle& p : particles)
  {
    EXPECT_TRUE(p.clips[0].exists());
  }
}

/// Of a roof that turns by so many degrees, or makes a step of so many spacings.
struct AlmostSmooth
{
  double degrees = 0.0;
  double step = 0.0;
  double expected = 0.0; ///< degrees; 0: no plane
};

class ClipPlanesWhere : public ::testing::TestWithParam<AlmostSmooth>
{
};

INSTANTIATE_TEST_SUITE_P(ClipPlanes, ClipPlanesWhere,
  ::testing::Values(AlmostSmooth{ 1.0, 0.0, 0.0 }, AlmostSmooth{ 3.0, 0.0, 3.0 },
    AlmostSmooth{ 9.0, 0.0, 9.0 }, AlmostSmooth{ 0.0, 0.01, 0.0 },
    AlmostSmooth{ 3.0, 0.15, glm::degrees(0.15) }, AlmostSmooth{ 0.0, 0.18, 9.9 }),
  [](const auto& which) { return "Case" + std::to_string(which.index); });

TEST_P(ClipPlanesWhere, TheSurfaceIsAlmostSmoothSayByHowMuchItTurns)
{
  const AlmostSmooth& wanted = this->GetParam();
  const double slope = std::tan(glm::radians(0.5 * wanted.degrees));
  const auto particles = besideRidge(distributeOnRoof(slope, wanted.step * spacing), spacing);
  EXPECT_GT(particles.size(), 60u);
  for (const Particle& p : particles)
  {
    ASSERT_EQ(p.clips[0].exists(), wanted.expected > 0.0);
    EXPECT_NEAR(glm::degrees(p.clips[0].dihedralAngle), wanted.expected, 0.01);
    if (p.clips[0].exists())
    {
      EXPECT_NEAR(p.clips[0].distance, std::abs(p.position.xyz.x), 1e-6);
    }
  }
}

TEST(ClipPlanes, OfBoundariesComeFirstThoughOthersAreNearer)
{
  int both = 0;
  for (const Particle& p : distributeOnRoof(std::tan(glm::radians(1.5))).particles)
  {
    const glm::dvec3 x = p.position.xyz;
    const double toBoundary = 1.0 - std::abs(x.y);
    if (std::abs(x.x) < toBoundary && toBoundary < spacing)
    {
      ++both;
      EXPECT_TRUE(p.clips[0].isBoundary());
      EXPECT_GT(std::abs(p.clips[0].normal.xyz.y), 0.99);
      EXPECT_LT(p.clips[1].dihedralAngle, CreaseAngle);
      EXPECT_GT(std::abs(p.clips[1].normal.xyz.x), 0.99);
      EXPECT_LT(p.clips[1].distance, p.clips[0].distance);
    }
  }
  EXPECT_GT(both, 0);
}

/// The other side of a jump is no part of the sheet that ends at a boundary curve.
TEST(ClipPlanes, OfBoundariesCutOnlyTheirOwnSide)
{
  int beside = 0;
  for (const Particle& p : besideRidge(distributeOnRoof(0.2, 0.9 * spacing), 1.3 * spacing))
  {
    const double x = p.position.xyz.x;
    if (std::abs(x) > 0.3 * spacing)
    {
      ++beside;
      ASSERT_TRUE(p.clips[0].exists());
      EXPECT_LT(p.clips[0].normal.xyz.x * x, 0.0);
      EXPECT_GT(p.clips[0].distance, 0.2 * spacing);
      EXPECT_FALSE(p.clips[1].exists());
    }
  }
  EXPECT_GT(beside, 60);
}

/// Where two sheets end at one face, each at its own height, and their slopes differ a lot, the boundary curve of one
/// would cut off whole splats on the boundary curve of the other.
TEST(ClipPlanes, OfBoundariesAreNotForSheetsAtALargeAngle)
{
  int onBoundary = 0;
  for (const Particle& p : besideRidge(distributeOnRoof(0.8, 0.5 * spacing), 1e-9))
  {
    ++onBoundary;
    EXPECT_TRUE(p.clips[0].isBoundary());
    EXPECT_GT(std::abs(p.clips[0].normal.xyz.x), 0.7);
    EXPECT_FALSE(p.clips[1].exists()) << p.clips[1].distance;
  }
  EXPECT_GT(onBoundary, 60);
}

/// The surface passes an edge of the mesh at a small distance, and of the elements there only that behind the
/// edge goes on with it.
TEST(ClipPlanes, AreNotWhereTheSurfaceGoesOnBehindAnEdge)
{
  constexpr double gap = 0.02 * spacing;
  const auto box = [](ElementMesh& mesh, double constant, const glm::dvec3& corner)
  {
    MeshRecipe recipe;
    recipe.field = [=](const glm::dvec3& x) { return x.x - x.y + constant; };
    appendBox(
      mesh, recipe, glm::min(corner, glm::dvec3(0.0)), glm::max(corner, glm::dvec3(0, 0, 1)));
  };
  ElementMesh mesh;
  box(mesh, gap, { -1, -1, 0 });
  box(mesh, -gap, { 1, -1, 0 });
  box(mesh, -0.9, { -1, 1, 0 });
  box(mesh, -gap, { 1, 1, 0 });
  findFaceNeighbors(mesh, 1e-9);
  DistributionParameters parameters;
  parameters.sizing = { spacing, 0.0 };
  int near = 0;
  int onBoundary = 0;
  for (const Particle& p : distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {}).particles)
  {
    const glm::dvec3& x = p.position.xyz;
    if (std::hypot(x.x, x.y) < 1.2 * spacing && std::abs(x.z - 0.5) < 0.5 - 2.0 * spacing)
    {
      ++near;
      onBoundary += std::hypot(x.x, x.y) < 2.0 * gap;
      EXPECT_FALSE(p.clips[0].isBoundary()) << x.x << " " << x.y << " " << x.z;
    }
  }
  EXPECT_GT(near, 30);
  EXPECT_GT(onBoundary, 10); // as one element says
}

/// Elements between two cylinders of radius r and r + 1; the last is not joined to the first.
void appendRing(ElementMesh& mesh, double r, const Field& field)
{
  constexpr int sectors = 8;
  for (int s = 0; s < sectors; ++s)
  {
    MeshRecipe recipe;
    recipe.degrees = { 6, 6, 1 };
    recipe.map = [](const glm::dvec3& x)
    {
      const double angle = x.y * 2.0 * Pi / sectors;
      return glm::dvec3(x.x * std::cos(angle), x.x * std::sin(angle), x.z);
    };
    recipe.field = field;
    appendBox(mesh, recipe, { r, s, -3 }, { r + 1, s + 1, 3 });
  }
}

/// A ring cut by a plane: the boundary curves are circles, or, where the plane is inclined, ellipses.
Distribution distributeInRing(double slope)
{
  ElementMesh mesh;
  appendRing(mesh, 1.0, [=](const glm::dvec3& x) { return x.z - slope * x.x; });
  joinElements(mesh);
  DistributionParameters parameters;
  parameters.sizing = { spacing, 0.0 };
  return distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {});
}

TEST(ClipPlanes, OfBentBoundariesTouchThemWhereTheyAreNearest)
{
  int inner = 0;
  int outer = 0;
  for (const Particle& p : distributeInRing(0.0).particles)
  {
    const double r = glm::length(glm::dvec2(p.position.xyz));
    const glm::dvec3 outward = (r < 1.5 ? -1.0 : 1.0) / r * p.position.xyz;
    const double toBoundary = std::min(r - 1.0, 2.0 - r);
    if (toBoundary < spacing)
    {
      inner += r < 1.5;
      outer += r > 1.5;
      const ClipPlane& plane = p.clips[0];
      ASSERT_TRUE(plane.isBoundary());
      EXPECT_NEAR(plane.edgeCurvature, r < 1.5 ? 1.0 : -0.5, 1e-3);
      EXPECT_LT(glm::distance(plane.normal.xyz, outward), 0.03 * spacing);
      EXPECT_NEAR(plane.distance, toBoundary, 0.002 * spacing);
    }
  }
  EXPECT_GT(inner, 200);
  EXPECT_GT(outer, 400);
}

/// Between two particles on a boundary curve it is where both say.
TEST(ClipPlanes, OfBentBoundariesFollowThemOnInclinedSurfaces)
{
  constexpr double slope = 1.0;
  int onBoundary = 0;
  for (const Particle& p : distributeInRing(slope).particles)
  {
    const double r = glm::length(glm::dvec2(p.position.xyz));
    if (std::abs(r - 1.0) < 1e-3 * spacing)
    {
      ++onBoundary;
      const ClipPlane& plane = p.clips[0];
      const glm::dvec3 along = glm::cross(p.normal.xyz, plane.normal.xyz);
      for (const double s : { -0.5 * spacing, 0.5 * spacing })
      {
        const glm::dvec3 x =
          p.position.xyz + s * along + 0.5 * plane.edgeCurvature * s * s * plane.normal.xyz;
        EXPECT_NEAR(glm::length(glm::dvec2(x)), 1.0, 0.005 * spacing);
        EXPECT_NEAR(x.z, slope * x.x, 1e-6);
      }
    }
  }
  EXPECT_GT(onBoundary, 130);
}

/// The first plane of a particle beside a place at which a sheet ends: at the origin, where the sheet is z = 0 and ends
/// along x, in a curve that bends (1/spacing).
/// \param place in units of the spacing
ClipPlane planeBesideEnd(double bend, const glm::dvec3& place, const glm::dvec3& normal)
{
  const ElementMesh mesh = makeMesh(MeshRecipe{});
  const Isosurface surface{ &mesh, 0.0, 1e-9 };
  Buffer<BoundaryParticle> onBoundary(1);
  onBoundary[0] = {};
  onBoundary[0].particle.location.element = 0;
  onBoundary[0].particle.normal = { { 0, 0, 1 } };
  onBoundary[0].particle.spacing = spacing;
  onBoundary[0].patch.spacing = static_cast<float>(spacing);
  onBoundary[0].side = { 0, { { 1, 0, 0 } }, bend / spacing };
  Buffer<Particle> particles(1);
  particles[0] = {};
  particles[0].location.element = 0;
  particles[0].position = { spacing * place };
  particles[0].normal = { normal };
  particles[0].spacing = spacing;
  const ParticleGrid all(particles, onBoundary, {});
  Buffer<BoundaryParticle> thinned;
  markClipPlanes(surface, all, thinned, {});
  return particles[0].clips[0];
}

/// Beyond a spacing a boundary curve that bends within less than one may run anywhere: no plane is turned far to follow
/// it.
TEST(ClipPlanes, OfBoundariesThatBendStronglyAreNotTurnedFar)
{
  for (const double bend : { -0.9, 0.9 })
  {
    const ClipPlane plane = planeBesideEnd(bend, { -0.9, 1.1, 0.0 }, { 0, 0, 1 });
    ASSERT_TRUE(plane.exists()) << bend;
    EXPECT_GT(plane.normal.xyz.x, std::cos(0.5)) << bend;
  }
}

/// A sheet that passes over the end of another one goes on there, however it is inclined.
TEST(ClipPlanes, OfBoundariesDoNotCutSheetsThatPassOverThem)
{
  for (const double degrees : { -40.0, -20.0, 0.0, 20.0, 40.0 })
  {
    const double angle = glm::radians(degrees);
    const glm::dvec3 normal(std::sin(angle), 0.0, std::cos(angle));
    for (const double height : { -0.8, -0.4, 0.4, 0.8 })
    {
      const glm::dvec3 over = height * glm::normalize(normal + glm::dvec3(0, 0, 1));
      EXPECT_FALSE(planeBesideEnd(0.0, over - glm::dvec3(0.1, 0, 0), normal).exists())
        << degrees << " " << height;
    }
  }
}

/// The same sheet, though it is a circle with a radius of 1.25 spacings: a particle of it may stand as high.
TEST(ClipPlanes, OfBoundariesCutSheetsThatBendTowardsThem)
{
  constexpr double radius = 1.25; // spacings
  for (const double angle : { -1.0, -0.7, -0.3, 0.3, 0.7, 1.0 })
  {
    const double turn = std::abs(angle);
    const glm::dvec3 place(
      -radius * std::sin(turn), 0.0, std::copysign(radius * (1.0 - std::cos(turn)), angle));
    const glm::dvec3 normal(std::sin(angle), 0.0, std::cos(angle));
    EXPECT_TRUE(planeBesideEnd(0.0, place, normal).exists()) << angle;
  }
}

/// Two rings with a plane in the inner one, a bowl around it in the outer one: the crease is a circle.
TEST(ClipPlanes, OfBentCreasesTouchThemWhereTheyAreNearest)
{
  ElementMesh mesh;
  appendRing(mesh, 1.0, [](const glm::dvec3& x) { return x.z; });
  appendRing(
    mesh, 2.0, [](const glm::dvec3& x) { return x.z - 0.3 * (x.x * x.x + x.y * x.y - 4.0); });
  joinElements(mesh); // where the last sectors meet the first ones, too
  DistributionParameters parameters;
  parameters.sizing = { spacing, 0.0 };
  int beside = 0;
  for (const Particle& p : distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {}).particles)
  {
    const double r = glm::length(glm::dvec2(p.position.xyz));
    const ClipPlane& plane = p.clips[0];
    const glm::dvec3 outward(p.position.xyz.x / r, p.position.xyz.y / r, 0.0);
    const double radial = glm::dot(plane.normal.xyz, outward);
    if (std::abs(r - 2.0) < 0.5 * spacing && std::abs(radial) > 0.5)
    {
      ++beside;
      EXPECT_NEAR(radial, r < 2.0 ? 1.0 : -1.0, 1e-6);
      EXPECT_NEAR(plane.distance, std::abs(r - 2.0), 1e-4 * spacing);
      EXPECT_NEAR(plane.edgeCurvature, r < 2.0 ? -0.5 : 0.5, 0.01);
    }
  }
  EXPECT_GT(beside, 200);
}

/// A pyramid, z = height - slope r in the middles of its sides: as many wedges around an axis.
Distribution distributeOnPyramid(int sides, double slope, std::uint64_t seed = 1)
{
  ElementMesh mesh;
  const auto angleAt = [=](int side) { return (side % sides) * 2.0 * Pi / sides; };
  const auto onCircle = [&](int side, double z)
  { return glm::dvec3(std::cos(angleAt(side)), std::sin(angleAt(side)), z); };
  for (int s = 0; s < sides; ++s)
  {
    const glm::dvec3 middle = glm::normalize(onCircle(s, 0.0) + onCircle(s + 1, 0.0));
    MeshRecipe recipe;
    recipe.domain = Domain::Wedge;
    recipe.field = [=](const glm::dvec3& x) { return x.z - 0.1 + slope * glm::dot(x, middle); };
    const std::int64_t first = s + 1;
    const std::int64_t second = (s + 1) % sides + 1;
    const std::int64_t top = sides + 1;
    appendElement(mesh, recipe,
      { { 0, 0, -1 }, onCircle(s, -1.0), onCircle(s + 1, -1.0), { 0, 0, 1 }, onCircle(s, 1.0),
        onCircle(s + 1, 1.0) },
      { 0, first, second, top, top + first, top + second });
  }
  findFaceNeighbors(mesh, 1e-9);
  DistributionParameters parameters;
  parameters.sizing = { spacing, 0.0 };
  parameters.seed = seed;
  return distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {});
}

/// Whether a particle's splat covers a place, cut off as it is; splats reach a little beyond creases.
bool covers(const Particle& particle, const glm::dvec3& place)
{
  constexpr double beyondCreases = 0.1;
  const glm::dvec3 offset = place - particle.position.xyz;
  return glm::length(offset) < splatReach() * spacing &&
    std::none_of(particle.clips.begin(), particle.clips.end(),
      [&](const ClipPlane& plane)
      {
        return plane.dihedralAngle > CreaseAngle &&
          glm::dot(offset, plane.normal.xyz) > plane.distance + beyondCreases * spacing;
      });
}

/// Sectors between two creases are too narrow for particles of their own where they begin.
class ClipPlanesWhereCreasesMeet : public ::testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(
  ClipPlanes, ClipPlanesWhereCreasesMeet, ::testing::Values(5, 6, 7, 8, 9, 10, 12));

TEST_P(ClipPlanesWhereCreasesMeet, LeaveHardlyAnyHoles)
{
  constexpr double slope = 1.2;
  const int sides = this->GetParam();
  const double sector = 2.0 * Pi / sides;
  constexpr int seeds = 24;
  int open = 0;
  int places = 0;
  int seedsWithHoles = 0;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    const int before = open;
    const Distribution result = distributeOnPyramid(sides, slope, seed);
    for (double r = 0.02 * spacing; r < 2.0 * spacing; r += 0.06 * spacing)
    {
      for (double angle = 0.0; angle < 2.0 * Pi; angle += 0.06 * spacing / r)
      {
        const double toMiddle = std::remainder(angle - 0.5 * sector, sector);
        const glm::dvec3 place(
          r * std::cos(angle), r * std::sin(angle), 0.1 - slope * r * std::cos(toMiddle));
        ++places;
        open += std::none_of(result.particles.begin(), result.particles.end(),
          [&](const Particle& particle) { return covers(particle, place); });
      }
    }
    seedsWithHoles += open > before;
  }
  EXPECT_GT(places, 3000 * seeds);
  // Most seeds leave no hole; which do depends on rounding. Of 60 seeds and all numbers of sides 4% leave one: a few
  // places, narrower than a tenth of a spacing, where planes may be moved no farther; and, for one seed in a hundred, up
  // to 56 places where no particle stands within a spacing.
  EXPECT_LE(seedsWithHoles, seeds / 4);
  EXPECT_LE(open, places / 1000);
}

/// Planes stay where they are at creases of two sides only.
TEST(ClipPlanes, StayAtStraightCreases)
{
  for (const Particle& p : besideRidge(distributeOnRoof(0.5), 1.5 * spacing))
  {
    for (const ClipPlane& plane : p.clips)
    {
      EXPECT_TRUE(!plane.exists() || std::abs(plane.distance - std::abs(p.position.xyz.x)) < 1e-9);
    }
  }
}

/// Where a plane cuts off a triangle, hardly larger than a splat, from a corner of a cube.
TEST(ClipPlanes, OfBothFacesCutParticlesInCorners)
{
  for (const double sides : { 0.8, 1.0, 1.3 })
  {
    for (const int cells : { 1, 3 })
    {
      MeshRecipe recipe;
      recipe.cells = cells;
      const double sum = sides * spacing / std::sqrt(2.0) - 3.0;
      recipe.field = [=](const glm::dvec3& x) { return x.x + x.y + x.z - sum; };
      const ElementMesh mesh = makeMesh(recipe);
      DistributionParameters parameters;
      parameters.sizing = { spacing, 0.0 };
      const Distribution result = distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {});
      ASSERT_GE(result.particles.size(), 3u) << sides;
      int atCorners = 0;
      for (const Particle& particle : result.particles)
      {
        const glm::dvec3 fromCorner = particle.position.xyz + 1.0;
        const auto isAtSide = [&](int axis) { return fromCorner[axis] < 1e-6; };
        if (isAtSide(0) + isAtSide(1) + isAtSide(2) < 2)
        {
          continue;
        }
        ++atCorners;
        for (int axis = 0; axis < 3; ++axis)
        {
          const bool isCut = std::any_of(particle.clips.begin(), particle.clips.end(),
            [&](const ClipPlane& plane)
            { return plane.normal.xyz[axis] < -0.8 && plane.distance < 1e-6; });
          EXPECT_EQ(isCut, isAtSide(axis)) << sides << " " << axis;
        }
      }
      EXPECT_EQ(atCorners, 3) << sides;
    }
  }
}

/// A strip of the plane z = 0.1 between two walls. Lengths are in spacings; the second width is that at the other end.
/// \param isAtJumps whether there are elements beside it, in which the field is another and has no surface
Distribution distributeOnStrip(double width, double otherWidth, bool isAtJumps)
{
  MeshRecipe recipe;
  recipe.map = [=](const glm::dvec3& x)
  { return glm::dvec3(x.x, spacing * x.y * glm::mix(width, otherWidth, 0.5 + 0.5 * x.x), x.z); };
  recipe.field = [](const glm::dvec3& x) { return x.z - 0.1; };
  ElementMesh mesh;
  appendBox(mesh, recipe, { -1, 0, -1 }, { 1, 1, 1 });
  if (isAtJumps)
  {
    recipe.field = [](const glm::dvec3& x) { return x.z - 3.0; };
    appendBox(mesh, recipe, { -1, -1, -1 }, { 1, 0, 1 });
    appendBox(mesh, recipe, { -1, 1, -1 }, { 1, 2, 1 });
  }
  findFaceNeighbors(mesh, 1e-9);
  DistributionParameters parameters;
  parameters.sizing = { spacing, 0.0 };
  return distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {});
}

/// Whether a particle's planes of boundary curves cut a place off.
bool cutsOff(const Particle& particle, const glm::dvec3& place)
{
  const glm::dvec3 offset = place - particle.position.xyz;
  return std::any_of(particle.clips.begin(), particle.clips.end(),
    [&](const ClipPlane& plane)
    {
      return plane.isBoundary() &&
        glm::dot(offset, plane.normal.xyz) > plane.distance + 1e-6 * spacing;
    });
}

/// Whether a strip is cut off from the splats that reach beside it, all around, and covered itself.
void expectStrip(const Distribution& result, const glm::dvec2& width)
{
  const auto isCovered = [&](double x, double y)
  {
    const glm::dvec3 place(x, spacing * y, 0.1);
    return std::any_of(result.particles.begin(), result.particles.end(),
      [&](const Particle& p) {
        return glm::distance(p.position.xyz, place) < splatReach() * spacing && !cutsOff(p, place);
      });
  };
  for (double x = -1.005; x <= 1.01; x += 0.2 * spacing)
  {
    const double end = glm::mix(width.x, width.y, 0.5 + 0.5 * x);
    const bool isInside = std::abs(x) < 1.0;
    for (const double share : { 0.01, 0.3, 0.7, 0.99 })
    {
      EXPECT_EQ(isCovered(x, share * end), isInside) << width.x << " at " << x << " " << share;
    }
    EXPECT_FALSE(isCovered(x, -0.02)) << width.x << " at " << x;
    EXPECT_FALSE(isCovered(x, end + 0.02)) << width.x << " at " << x;
  }
}

/// At the end of the domain, and in an element between two in which the field jumps.
TEST(ClipPlanes, OfBothSidesCutParticlesOnStrips)
{
  const std::vector<glm::dvec2> widths{ { 0.05, 0.05 }, { 0.3, 0.3 }, { 0.55, 0.55 }, { 0.8, 0.8 },
    { 1.5, 1.5 }, { 3.0, 3.0 }, { 0.1, 1.2 } };
  for (const bool isAtJumps : { false, true })
  {
    for (const glm::dvec2& width : widths)
    {
      SCOPED_TRACE(isAtJumps ? "at jumps" : "at the end of the domain");
      expectStrip(distributeOnStrip(width.x, width.y, isAtJumps), width);
    }
  }
}

/// The two ends of a cut as wide as rounding are no strip: nothing is cut off there.
TEST(ClipPlanes, AreNotAtCracksThatSplatsCover)
{
  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3& x) { return x.z - 0.1; };
  ElementMesh mesh;
  appendBox(mesh, recipe, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, recipe, { -1e-4 * spacing, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  DistributionParameters parameters;
  parameters.sizing = { spacing, 0.0 };
  int near = 0;
  for (const Particle& p : distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {}).particles)
  {
    if (std::abs(p.position.xyz.x) < 0.9 * spacing &&
      std::abs(p.position.xyz.y) < 1.0 - 2.0 * spacing)
    {
      ++near;
      EXPECT_FALSE(p.clips[0].exists()) << p.position.xyz.x;
    }
  }
  EXPECT_GT(near, 30);
}

} // namespace
} // namespace hop::testing
