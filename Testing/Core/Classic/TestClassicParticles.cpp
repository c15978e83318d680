#include "Classic/ClassicParticles.h"

#include "AnalyticFields.h"
#include "ClassicLattice.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hop::testing
{
namespace
{

constexpr double radius = 0.6;
constexpr double spacing = 0.1;
/// Particles that move lie on the surface to a ten-thousandth of their spacing.
constexpr double movingTolerance = 1e-4 * spacing;

ElementMesh meshOf(const Field& field)
{
  MeshRecipe recipe;
  recipe.field = field;
  return makeMesh(recipe);
}

TEST(ClassicParticles, SeedsOfBoxesLieOnTheSurface)
{
  const ElementMesh mesh = meshOf(sphere({ 0, 0, 0 }, radius).field);
  ClassicParticles particles({ &mesh, 0.0, 1e-9 }, { spacing, 0.0 }, threadedFor(2));
  const auto boxes = findSurfaceBoxes(mesh, 0.0, 0.2, {});
  const std::vector<ClassicParticle> seeds = particles.seedsOf(boxes);
  EXPECT_EQ(seeds.size(), boxes.size());
  EXPECT_GE(particles.evaluations(), static_cast<std::int64_t>(seeds.size()));
  EXPECT_TRUE(particles.movers.empty());
  for (const ClassicParticle& seed : seeds)
  {
    const glm::dvec3 x = seed.position().xyz;
    EXPECT_NEAR(glm::length(x), radius, movingTolerance);
    EXPECT_LE(glm::distance(seed.normal.xyz, glm::normalize(x)), 1e-9);
    EXPECT_DOUBLE_EQ(seed.ideal, idealEnergy());
    EXPECT_EQ(seed.curvature, 0.0) << "not needed where spacings do not depend on it";
  }
}

TEST(ClassicParticles, RandomSeedsAreSpreadOverTheSurface)
{
  for (const Domain domain : { Domain::Hexahedron, Domain::Wedge, Domain::Tetrahedron })
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.field = sphere({ 0.1, 0.0, -0.1 }, 0.5).field;
    const ElementMesh mesh = makeMesh(recipe);
    const Isosurface surface{ &mesh, 0.0, 1e-10 };
    ClassicParticles particles(surface, { 0.1, 0.0 }, {});
    Random random(1);
    const std::vector<ClassicParticle> seeds = particles.randomSeeds(400, 4.0, random);
    EXPECT_GE(seeds.size(), 350u);
    EXPECT_GE(particles.evaluations(), 400);
    std::array<int, 8> inOctant{};
    for (const ClassicParticle& seed : seeds)
    {
      const glm::dvec3 d = seed.position().xyz - glm::dvec3(0.1, 0.0, -0.1);
      EXPECT_NEAR(glm::length(d), 0.5, 1e-9);
      ++inOctant[(d.x > 0.0) + 2 * (d.y > 0.0) + 4 * (d.z > 0.0)];
    }
    EXPECT_GE(*std::min_element(inOctant.begin(), inOctant.end()), 25);
    Random again(1), other(2);
    EXPECT_EQ(
      particles.randomSeeds(1, 4.0, again).front().position().xyz, seeds.front().position().xyz);
    EXPECT_NE(
      particles.randomSeeds(1, 4.0, other).front().position().xyz, seeds.front().position().xyz);
  }
}

TEST(ClassicParticles, CurvatureIsKnownWhereTheSpacingFollowsIt)
{
  const ElementMesh mesh = meshOf(sphere({ 0, 0, 0 }, radius).field);
  const double expected = std::sqrt(2.0) / radius;
  for (const double density : { 0.0, 7.0 })
  {
    ClassicParticles particles({ &mesh, 0.0, 1e-9 }, { spacing, density }, {});
    const ClassicParticle seed = particles.seedsOf(findSurfaceBoxes(mesh, 0.0, 0.2, {})).front();
    EXPECT_NEAR(seed.curvature, density > 0.0 ? expected : 0.0, 1e-4);
  }
}

TEST(ClassicParticles, IdealEnergyCountsTheNeighborsThatCanExist)
{
  // From the middle of the plane to a wall, and on to an edge of the cube.
  ClassicLattice lattice(0.0);
  ASSERT_EQ(lattice.count(), 1u);
  const ClassicParticle inside = lattice.particles.movers[0];
  EXPECT_DOUBLE_EQ(inside.ideal, 6.0 * pairEnergy(HexagonalDistance));
  ClassicParticle atWall;
  ASSERT_TRUE(lattice.particles.displace(inside, { glm::dvec3(1.2, 0.0, 0.0) }, 3.0, atWall));
  EXPECT_NEAR(atWall.position().xyz.x, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(atWall.ideal, 4.0 * pairEnergy(HexagonalDistance));
  ClassicParticle atEdge;
  ASSERT_TRUE(lattice.particles.displace(atWall, { glm::dvec3(0.0, 1.2, 0.0) }, 3.0, atEdge));
  EXPECT_NEAR(atEdge.position().xyz.y, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(atEdge.ideal, 2.0 * pairEnergy(HexagonalDistance));
}

TEST(ClassicParticles, ScaledDistanceOfNeighborsIsHexagonal)
{
  const ClassicLattice lattice(0.15);
  // The centre and its six neighbours.
  ASSERT_EQ(lattice.count(), 7u);
  const std::vector<ClassicParticle>& movers = lattice.particles.movers;
  for (std::size_t i = 1; i < movers.size(); ++i)
  {
    EXPECT_NEAR(lattice.particles.scaledDistance(movers[0], movers[i]), HexagonalDistance, 1e-9);
  }
}

TEST(ClassicParticles, NewOnesStandBesideTheirParent)
{
  const ElementMesh mesh = meshOf(sphere({ 0, 0, 0 }, radius).field);
  ClassicParticles particles({ &mesh, 0.0, 1e-9 }, { spacing, 0.0 }, {});
  ClassicParticle parent = particles.seedsOf(findSurfaceBoxes(mesh, 0.0, 0.2, {})).front();
  parent.lambda = ClassicParticle::SmallestLambda;
  std::vector<glm::dvec3> directions;
  for (const double angle : { 0.0, 0.5 * Pi, Pi, 1.5 * Pi })
  {
    ASSERT_TRUE(particles.addBeside(parent, 0.05, angle));
    const ClassicParticle& child = particles.movers.back();
    EXPECT_NEAR(glm::length(child.position().xyz), radius, movingTolerance);
    // A step of 0.05 in the tangent plane of a sphere of 0.6.
    EXPECT_NEAR(length(child.position() - parent.position()), 0.05, 5e-4);
    EXPECT_EQ(child.lambda, ClassicParticle::InitialLambda);
    directions.push_back(glm::normalize(child.position().xyz - parent.position().xyz));
  }
  EXPECT_NEAR(glm::dot(directions[0], directions[1]), 0.0, 0.02);
  EXPECT_NEAR(glm::dot(directions[0], directions[2]), -1.0, 0.02);
  EXPECT_NEAR(glm::dot(directions[1], directions[3]), -1.0, 0.02);
  EXPECT_EQ(particles.rejected(), 0);
}

TEST(ClassicParticles, StepsThatGoTooFarOrTurnOverAreRefused)
{
  const ElementMesh mesh = meshOf(sphere({ 0, 0, 0 }, radius).field);
  ClassicParticles particles({ &mesh, 0.0, 1e-9 }, { spacing, 0.0 }, {});
  const ClassicParticle from = particles.seedsOf(findSurfaceBoxes(mesh, 0.0, 0.2, {})).front();
  const glm::dvec3 tangent = orthogonalTo(from.normal.xyz);
  ClassicParticle to;
  EXPECT_TRUE(particles.displace(from, { 0.09 * tangent }, 0.1, to));
  EXPECT_FALSE(particles.displace(from, { 0.2 * tangent }, 0.1, to));
  // Through the sphere, to where normals point the other way.
  EXPECT_FALSE(particles.displace(from, { -1.9 * radius * from.normal.xyz }, 10.0, to));
}

TEST(ClassicParticles, SeedsAreAddedWhereNoParticleCovers)
{
  // A plate a quarter of a spacing thick: its two sides do not cover each other.
  const ElementMesh mesh = meshOf([](const glm::dvec3& x) { return 0.0125 * 0.0125 - x.z * x.z; });
  ClassicParticles particles({ &mesh, 0.0, 1e-9 }, { spacing, 0.0 }, {});
  const auto seeds = particles.seedsOf(findSurfaceBoxes(mesh, 0.0, 0.05, {}));
  particles.addUncovered(seeds);
  const std::size_t count = particles.movers.size();
  const auto sameSide = [](const ClassicParticle& a, const ClassicParticle& b)
  { return dot(a.normal, b.normal) > 0.0; };
  for (const ClassicParticle& seed : seeds)
  {
    // All are covered, by none nearer than a spacing to another.
    EXPECT_TRUE(std::any_of(particles.movers.begin(), particles.movers.end(),
      [&](const ClassicParticle& m)
      { return sameSide(m, seed) && length(m.position() - seed.position()) <= spacing; }));
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const ClassicParticle& a = particles.movers[i];
      const ClassicParticle& b = particles.movers[j];
      EXPECT_TRUE(!sameSide(a, b) || length(a.position() - b.position()) >= spacing);
    }
  }
  const auto above = std::count_if(particles.movers.begin(), particles.movers.end(),
    [](const ClassicParticle& m) { return m.position().xyz.z > 0.0; });
  EXPECT_GT(above, 100);
  EXPECT_GT(static_cast<std::ptrdiff_t>(count) - above, 100);
  particles.addUncovered(seeds);
  EXPECT_EQ(particles.movers.size(), count);
}

TEST(ClassicParticles, ListsHoldAllWithinTheRange)
{
  ClassicLattice lattice(0.5);
  ClassicParticles& particles = lattice.particles;
  particles.renewNeighbors();
  for (std::size_t i = 0; i < lattice.count(); ++i)
  {
    const std::set<std::size_t> listed(
      particles.neighbors.neighbor.begin() + particles.neighbors.start[i],
      particles.neighbors.neighbor.begin() + particles.neighbors.start[i + 1]);
    EXPECT_EQ(listed.count(i), 0u);
    for (std::size_t j = 0; j < lattice.count(); ++j)
    {
      if (j != i && particles.scaledDistance(particles.movers[i], particles.movers[j]) <= 1.2)
      {
        EXPECT_EQ(listed.count(j), 1u);
      }
    }
  }
}

TEST(ClassicParticles, OrthogonalVectorIsAUnitVector)
{
  for (const glm::dvec3& direction : { glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
         glm::dvec3(0, 0, -1), glm::dvec3(1, 1, 1), glm::dvec3(-0.6, 0.79, 0.1) })
  {
    const glm::dvec3 n = glm::normalize(direction);
    EXPECT_NEAR(glm::length(orthogonalTo(n)), 1.0, 1e-14);
    EXPECT_NEAR(glm::dot(orthogonalTo(n), n), 0.0, 1e-14);
  }
}

} // namespace
} // namespace hop::testing
