#include "Classic/SplitAndDelete.h"

#include "ClassicLattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double spacing = ClassicLattice::Spacing;

/// A lattice whose particles have an energy, in units of the ideal one.
ClassicLattice withEnergies(double share)
{
  ClassicLattice lattice;
  lattice.particles.renewNeighbors();
  lattice.setEnergies(share);
  return lattice;
}

TEST(SplitAndDelete, PerfectPackingHasSettled)
{
  ClassicLattice lattice = withEnergies(1.0);
  const std::size_t count = lattice.count();
  Random random(1);
  EXPECT_FALSE(splitAndDelete(lattice.particles, random));
  EXPECT_EQ(lattice.count(), count);
}

TEST(SplitAndDelete, CoinSplitsBelowAndDeletesAboveThePapersThresholds)
{
  // U (E - 1) < -0.35 and > 0.75, in units of the ideal energy: expected shares of splits less deletions.
  struct Case
  {
    double energy;
    double change;
  };
  for (const Case& c : { Case{ 0.0, 0.65 }, Case{ 0.5, 0.3 }, Case{ 0.66, 0.0 }, Case{ 1.74, 0.0 },
         Case{ 2.5, -0.5 }, Case{ 4.0, -0.75 } })
  {
    ClassicLattice lattice = withEnergies(c.energy);
    const auto count = static_cast<double>(lattice.count());
    ASSERT_GT(count, 200.0);
    Random random(1);
    EXPECT_EQ(splitAndDelete(lattice.particles, random), c.change != 0.0) << c.energy;
    const double change = (static_cast<double>(lattice.count()) - count) / count;
    EXPECT_NEAR(change, c.change, c.change == 0.0 ? 0.0 : 0.1) << c.energy;
  }
}

TEST(SplitAndDelete, ThresholdsOfTheCoinCanBeChosen)
{
  ClassicParameters parameters;
  parameters.splitBelow = -0.1;
  Random random(1);
  ClassicLattice loose = withEnergies(0.66);
  EXPECT_TRUE(splitAndDelete(loose.particles, random, parameters));
  parameters.settledShare = 1.1;
  loose = withEnergies(0.66);
  EXPECT_FALSE(splitAndDelete(loose.particles, random, parameters));

  parameters = {};
  parameters.deleteAbove = 0.3;
  ClassicLattice dense = withEnergies(1.74);
  EXPECT_TRUE(splitAndDelete(dense.particles, random, parameters));
}

TEST(SplitAndDelete, ChildrenStandHalfASpacingFromTheirParents)
{
  ClassicLattice lattice = withEnergies(0.0);
  const std::vector<ClassicParticle> before = lattice.particles.movers;
  Random random(1);
  splitAndDelete(lattice.particles, random);
  std::size_t children = 0;
  for (const ClassicParticle& m : lattice.particles.movers)
  {
    double nearest = 1.0;
    for (const ClassicParticle& parent : before)
    {
      nearest = std::min(nearest, length(m.position() - parent.position()));
    }
    EXPECT_LE(nearest, 0.5 * spacing * (1.0 + 1e-9));
    children += nearest > 0.0;
  }
  EXPECT_EQ(children, lattice.count() - before.size());
}

TEST(SplitAndDelete, FewerThanAHundredthChangeNothing)
{
  ClassicLattice lattice = withEnergies(1.0);
  const std::size_t count = lattice.count();
  ASSERT_GT(count, 200u);
  ASSERT_LT(count, 300u);
  for (const std::size_t changing : { 2u, 20u })
  {
    for (std::size_t i = 0; i < changing; ++i)
    {
      lattice.particles.movers[i].energy = 1e6;
    }
    Random random(1);
    const bool continuesIn = splitAndDelete(lattice.particles, random);
    EXPECT_EQ(continuesIn, changing > 2);
    EXPECT_EQ(lattice.count(), continuesIn ? count - changing : count);
  }
}

TEST(SplitAndDelete, OverlappingParticlesAreDeletedWhateverTheirEnergy)
{
  ClassicLattice lattice = withEnergies(1.0);
  const std::size_t count = lattice.count();
  lattice.add(lattice.particles.movers[5], { 0.05 * spacing, 0.0 });
  lattice.setEnergies(1.0);
  lattice.particles.renewNeighbors();
  Random random(1);
  EXPECT_TRUE(splitAndDelete(lattice.particles, random));
  EXPECT_EQ(lattice.count(), count);
  lattice.particles.renewNeighbors();
  EXPECT_FALSE(splitAndDelete(lattice.particles, random));
}

TEST(SplitAndDelete, DropsOverlappingParticlesButTheFirst)
{
  ClassicLattice lattice;
  const std::vector<ClassicParticle> before = lattice.particles.movers;
  lattice.particles.renewNeighbors();
  EXPECT_FALSE(dropOverlapping(lattice.particles));
  lattice.add(before[3], { 0.1 * spacing, 0.0 });
  lattice.add(before[3], { 0.0, 0.1 * spacing });
  // Not this one: r = 0.3 beta.
  lattice.add(before[7], { 0.3 * spacing, 0.0 });
  lattice.particles.renewNeighbors();
  EXPECT_TRUE(dropOverlapping(lattice.particles));
  ASSERT_EQ(lattice.count(), before.size() + 1);
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_EQ(lattice.particles.movers[i].position().xyz, before[i].position().xyz);
  }
}

TEST(SplitAndDelete, ExcessEnergyIsAChangeOfSpacing)
{
  // Neighbours at 1 + eps times the spacing: the spacing would have to rise by eps.
  ClassicLattice lattice;
  for (const double eps : { -0.02, -0.005, 0.0, 0.005, 0.02 })
  {
    const double share =
      pairEnergy(HexagonalDistance * (1.0 + eps)) / pairEnergy(HexagonalDistance);
    lattice.setEnergies(share);
    EXPECT_NEAR(excessEnergy(lattice.particles.movers), -eps, 2.5 * eps * eps + 1e-12) << eps;
  }
}

TEST(SplitAndDelete, OnePairThatCannotPartCountsLittle)
{
  ClassicLattice lattice;
  lattice.setEnergies(1.0);
  lattice.particles.movers[0].energy = 1e6;
  EXPECT_LE(excessEnergy(lattice.particles.movers), 0.01);
  EXPECT_EQ(excessEnergy({}), 0.0);
}

TEST(SplitAndDelete, IdealEnergyIsReachedByTwiceTheChangeOfSpacing)
{
  for (const double share : { 0.5, 0.9, 0.98, 1.0, 1.02, 1.1, 2.4 })
  {
    ClassicLattice lattice;
    lattice.setEnergies(share);
    const auto count = static_cast<double>(lattice.count());
    const double change = std::clamp(-2.0 * excessEnergy(lattice.particles.movers), -0.2, 0.2);
    Random random(1);
    reachIdealEnergy(lattice.particles, random);
    EXPECT_EQ(lattice.count(), static_cast<std::size_t>(std::llround((1.0 + change) * count)));
    EXPECT_EQ(lattice.count() < count, share > 1.01) << share;
    EXPECT_EQ(lattice.count() > count, share < 0.99) << share;
  }
}

TEST(SplitAndDelete, CountIsSetByDeletingTheMostEnergeticFirst)
{
  ClassicLattice lattice;
  const std::vector<ClassicParticle> before = lattice.particles.movers;
  lattice.setEnergies(1.0);
  for (const std::size_t i : { 4u, 40u, 17u })
  {
    lattice.particles.movers[i].energy = 5.0;
  }
  Random random(1);
  setCount(lattice.particles, before.size() - 3, random);
  ASSERT_EQ(lattice.count(), before.size() - 3);
  for (const ClassicParticle& m : lattice.particles.movers)
  {
    EXPECT_LT(m.energy, 5.0);
  }
  setCount(lattice.particles, before.size() - 3, random);
  EXPECT_EQ(lattice.count(), before.size() - 3);
}

TEST(SplitAndDelete, CountIsSetBySplittingTheLeastEnergeticFirst)
{
  ClassicLattice lattice;
  lattice.setEnergies(1.0);
  const std::size_t count = lattice.count();
  for (const std::size_t i : { 4u, 40u, 17u })
  {
    lattice.particles.movers[i].energy = 0.1;
  }
  Random random(1);
  setCount(lattice.particles, count + 3, random);
  ASSERT_EQ(lattice.count(), count + 3);
  // Of equal ones the first.
  const std::size_t parents[] = { 4, 17, 40 };
  for (std::size_t n = 0; n < 3; ++n)
  {
    const std::vector<ClassicParticle>& movers = lattice.particles.movers;
    EXPECT_NEAR(
      length(movers[count + n].position() - movers[parents[n]].position()), 0.5 * spacing, 1e-9);
  }
  // More than one each.
  setCount(lattice.particles, 3 * count, random);
  EXPECT_EQ(lattice.count(), 3 * count);
}

TEST(SplitAndDelete, HalfTheSpacingMakesFourOfOne)
{
  ClassicLattice lattice(0.5);
  const std::size_t count = lattice.count();
  lattice.particles.sizing.spacing = 0.5 * spacing;
  Random random(1);
  splitByFour(lattice.particles, spacing, random);
  ASSERT_EQ(lattice.count(), 4 * count);
  for (std::size_t i = count; i < lattice.count(); ++i)
  {
    const ClassicParticle& parent = lattice.particles.movers[(i - count) / 3];
    EXPECT_NEAR(
      length(lattice.particles.movers[i].position() - parent.position()), 0.45 * spacing, 1e-9);
  }
}

TEST(SplitAndDelete, SpacingThatStaysMakesOneOfOne)
{
  ClassicLattice lattice(0.5);
  const std::size_t count = lattice.count();
  Random random(1);
  splitByFour(lattice.particles, spacing, random);
  EXPECT_EQ(lattice.count(), count);
}

TEST(SplitAndDelete, SameSeedSameParticles)
{
  ClassicLattice first = withEnergies(0.3);
  ClassicLattice second = withEnergies(0.3);
  Random one(5);
  Random other(5);
  splitAndDelete(first.particles, one);
  splitAndDelete(second.particles, other);
  ASSERT_EQ(first.count(), second.count());
  for (std::size_t i = 0; i < first.count(); ++i)
  {
    EXPECT_EQ(first.particles.movers[i].position().xyz, second.particles.movers[i].position().xyz);
  }
}

} // namespace
} // namespace hop::testing
