#include "Classic/ClassicRelaxation.h"

#include "ClassicLattice.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double spacing = ClassicLattice::Spacing;

double sweep(ClassicLattice& lattice)
{
  lattice.particles.renewNeighbors();
  return sweepOnce(lattice.particles, {});
}

double distance(const ClassicParticle& a, const ClassicParticle& b)
{
  return length(a.position() - b.position());
}

/// Two particles at a distance, in units of the spacing.
ClassicLattice pairAt(double distance)
{
  ClassicLattice lattice(0.0);
  lattice.add(lattice.particles.movers[0], { distance * spacing, 0.0 });
  return lattice;
}

TEST(ClassicRelaxation, HexagonalPackingHasTheIdealEnergyAndStays)
{
  ClassicLattice lattice(0.5);
  const glm::dvec3 centre = lattice.particles.movers[0].position().xyz;
  sweep(lattice);
  const ClassicParticle& inside = lattice.particles.movers[0];
  EXPECT_NEAR(inside.energy, idealEnergy(), 1e-6);
  EXPECT_LE(glm::distance(inside.position().xyz, centre), 1e-6 * spacing);
}

TEST(ClassicRelaxation, EnergyOfAPairIsThatOfItsDistance)
{
  for (const double apart : { 0.5, 1.0, 1.5 })
  {
    ClassicLattice pair = pairAt(apart);
    // Fixed, as it were: steps this short lower nothing worth mentioning.
    for (ClassicParticle& m : pair.particles.movers)
    {
      m.lambda = ClassicParticle::SmallestLambda;
    }
    const double expected = pairEnergy(HexagonalDistance * apart);
    EXPECT_NEAR(sweep(pair), 2.0 * expected, 0.01 * expected) << apart;
  }
}

TEST(ClassicRelaxation, PairsNearerThanTheRangeMoveApartAlongTheirLine)
{
  ClassicLattice pair = pairAt(0.6);
  double last = distance(pair.particles.movers[0], pair.particles.movers[1]);
  for (int n = 0; n < 10; ++n)
  {
    sweep(pair);
    const double now = distance(pair.particles.movers[0], pair.particles.movers[1]);
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_GT(last, 1.4 * spacing);
  EXPECT_LE(last, 1.001 * spacing / HexagonalDistance);
  const glm::dvec3 line =
    pair.particles.movers[1].position().xyz - pair.particles.movers[0].position().xyz;
  EXPECT_NEAR(line.y, 0.0, 1e-9);
}

TEST(ClassicRelaxation, PairsBeyondTheRangeStay)
{
  ClassicLattice pair = pairAt(1.001 / HexagonalDistance);
  const glm::dvec3 before = pair.particles.movers[1].position().xyz;
  EXPECT_EQ(sweep(pair), 0.0);
  EXPECT_EQ(pair.particles.movers[1].position().xyz, before);
}

TEST(ClassicRelaxation, TwoInOnePlacePart)
{
  ClassicLattice pair = pairAt(0.0);
  pair.particles.movers[1] = pair.particles.movers[0];
  for (int n = 0; n < 10; ++n)
  {
    sweep(pair);
  }
  EXPECT_GT(distance(pair.particles.movers[0], pair.particles.movers[1]), 0.5 * spacing);
}

TEST(ClassicRelaxation, NoneGoesFartherThanASpacing)
{
  ClassicLattice lattice(0.4);
  // Crowds: forces far larger than in any packing.
  const std::vector<ClassicParticle> some(
    lattice.particles.movers.begin(), lattice.particles.movers.begin() + 10);
  for (const ClassicParticle& m : some)
  {
    lattice.add(m, { 1e-4 * spacing, 2e-4 * spacing });
  }
  const std::vector<ClassicParticle> before = lattice.particles.movers;
  sweep(lattice);
  double farthest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    farthest = std::max(farthest, distance(before[i], lattice.particles.movers[i]));
  }
  EXPECT_LE(farthest, spacing * (1.0 + 1e-9));
  EXPECT_GT(farthest, 0.2 * spacing);
}

TEST(ClassicRelaxation, StepThatRaisesTheEnergyIsNotTaken)
{
  // Between two rows that are so near that the longest step leads into one of them.
  constexpr double large = 2e3;
  ClassicLattice lattice(0.0);
  const ClassicParticle centre = lattice.particles.movers[0];
  lattice.particles.movers.clear();
  lattice.add(centre, { 0.0, 0.01 * spacing });
  for (const double side : { -0.4, 0.4 })
  {
    for (int n = -12; n <= 12; ++n)
    {
      lattice.add(centre, { 0.1 * spacing * n, side * spacing });
    }
  }
  for (ClassicParticle& m : lattice.particles.movers)
  {
    m.lambda = large;
  }
  sweep(lattice);
  const ClassicParticle& moved = lattice.particles.movers[0];
  EXPECT_LT(moved.lambda, large);
  EXPECT_LE(distance(moved, centre), 0.01 * spacing);
}

TEST(ClassicRelaxation, EnergyFallsFromSweepToSweep)
{
  ClassicLattice lattice(0.6);
  Random random(1);
  const std::vector<ClassicParticle> even = lattice.particles.movers;
  lattice.particles.movers.clear();
  for (const ClassicParticle& m : even)
  {
    lattice.add(m, 0.5 * spacing * glm::dvec2(random.uniform() - 0.5, random.uniform() - 0.5));
  }
  double last = sweep(lattice);
  for (int n = 0; n < 8; ++n)
  {
    const double now = sweep(lattice);
    EXPECT_LT(now, last);
    last = now;
  }
}

TEST(ClassicRelaxation, StepLengthsGrowAndShrinkByTen)
{
  ClassicLattice pair = pairAt(0.6);
  pair.particles.movers[0].lambda = 0.001;
  pair.particles.movers[1].lambda = 0.1;
  sweep(pair);
  EXPECT_DOUBLE_EQ(pair.particles.movers[0].lambda, 0.01);
  EXPECT_DOUBLE_EQ(pair.particles.movers[1].lambda, 1.0);
}

/// At r = 0.995 the force is 5.6e-5/h: the step is 0.17 h, and taken.
TEST(ClassicRelaxation, StepLengthsHaveNoBound)
{
  ClassicLattice pair = pairAt(0.995 / HexagonalDistance);
  pair.particles.movers[0].lambda = 3e3;
  sweep(pair);
  EXPECT_DOUBLE_EQ(pair.particles.movers[0].lambda, 3e4);
}

/// The step is 2.48 lambda h: with 200, 20 and 2 it is longer than h, with 0.2 it is taken.
TEST(ClassicRelaxation, StepsLongerThanASpacingAreRejectedAndNotShortened)
{
  ClassicLattice pair = pairAt(0.6);
  pair.particles.movers[0].lambda = 200.0;
  const ClassicParticle before = pair.particles.movers[0];
  sweep(pair);
  const ClassicParticle& after = pair.particles.movers[0];
  EXPECT_DOUBLE_EQ(after.lambda, 0.2) << "it grows after a first try only";
  EXPECT_LT(distance(before, after), 0.51 * spacing);
  EXPECT_GT(distance(before, after), 0.48 * spacing);
}

TEST(ClassicRelaxation, SheetsTurnedAwayDoNotSeeEachOther)
{
  // The two sides of a plate a tenth of a spacing thick, one particle on each.
  MeshRecipe recipe;
  recipe.field = [](const glm::dvec3& x) { return 0.005 * 0.005 - x.z * x.z; };
  const ElementMesh mesh = makeMesh(recipe);
  ClassicParticles particles({ &mesh, 0.0, 1e-9 }, { spacing, 0.0 }, {});
  const auto seeds = particles.seedsOf(findSurfaceBoxes(mesh, 0.0, 0.05, {}));
  const ClassicParticle& first = seeds.front();
  const auto other = std::find_if(seeds.begin(), seeds.end(),
    [&](const ClassicParticle& m)
    { return dot(m.normal, first.normal) < 0.0 && distance(m, first) < spacing; });
  ASSERT_NE(other, seeds.end());
  particles.movers = { first, *other };
  particles.renewNeighbors();
  ASSERT_EQ(particles.neighbors.neighbor.size(), 2u);
  EXPECT_EQ(sweepOnce(particles, {}), 0.0);
}

} // namespace
} // namespace hop::testing
