#include "Surface/ParticlesHome.h"

#include "AnalyticFields.h"
#include "Classic/ClassicDistribution.h"
#include "CountingExchange.h"
#include "ElementCases.h"
#include "Fast/FastDistribution.h"
#include "RanksInMemory.h"
#include "ScatteredMesh.h"
#include "Support/Interruptible.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <mutex>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;

/// A torus in a wavy cube; part of it ends at the cube's faces.
ElementMesh wholeMesh(Domain domain)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { 4, 4, 4 };
  recipe.cells = 3;
  recipe.map = wavyMap(0.1);
  recipe.field = torus(0.8, 0.3).field;
  return makeMesh(recipe);
}

using Method = Distribution (*)(
  const Isosurface&, const DistributionParameters&, const Monitor&, const ParallelFor&);

Distribution distribute(const GatheredMesh& all, Method method)
{
  DistributionParameters parameters;
  parameters.sizing.spacing = 0.1;
  return method({ &all.mesh, 0.0, tolerance }, parameters, {}, {});
}

/// Position and normal of a particle, to be sorted and compared to the last bit.
using Bits = std::array<double, 6>;

Bits bitsOf(const Particle& particle)
{
  const glm::dvec3& x = particle.position.xyz;
  const glm::dvec3& n = particle.normal.xyz;
  return { x.x, x.y, x.z, n.x, n.y, n.z };
}

/// What all ranks have together.
std::vector<Bits> particlesOf(
  const ElementMesh& whole, int ranks, int worker, Method method, bool keeps = true)
{
  const std::vector<ElementMesh> parts = scattered(whole, ranks, ranks);
  std::vector<Bits> found;
  std::mutex access;
  runRanks(ranks,
    [&](Exchange& exchange)
    {
      ElementMesh mine = parts[exchange.rank()];
      const std::vector<MeshSize> sizes = gatherFromAll(exchange, sizeOf(mine, CellsOfRank));
      const GatheredMesh all = gatheredAt(exchange, worker, mine);
      Distribution distribution;
      if (exchange.rank() == worker)
      {
        distribution = distribute(all, method);
      }
      const HomeParticles home =
        bringHome(exchange, worker, distribution, true, all, sizes, {}, keeps);
      EXPECT_TRUE(home.isComplete);
      const std::lock_guard lock(access);
      for (const Particle& particle : home.distribution.particles)
      {
        found.push_back(bitsOf(particle));
        // It stands where this rank's own element says.
        const BernsteinForm form = parts[exchange.rank()].form(particle.location.element);
        const Jet jet = evaluateGradient(form, particle.location.u);
        EXPECT_LT(glm::distance(glm::dvec3(jet.value), particle.position.xyz), 1e-12);
      }
    });
  std::sort(found.begin(), found.end());
  return found;
}

class OneSurface : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(ParticlesHome, OneSurface, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(OneSurface, HasTheSameBitsOnAnyNumberOfRanks)
{
  const ElementMesh whole = wholeMesh(this->GetParam());
  const std::vector<Bits> expected = particlesOf(whole, 1, 0, distributeFast);
  ASSERT_GT(expected.size(), 500u);
  for (const int ranks : { 2, 3, 4, 8, 50 })
  {
    EXPECT_EQ(particlesOf(whole, ranks, ranks / 2, distributeFast), expected) << ranks;
    EXPECT_EQ(particlesOf(whole, ranks, ranks / 2, distributeFast, false), expected) << ranks;
  }
}

constexpr int ofEach = 10000;

/// So many particles in elements of each of two ranks.
Distribution manyParticles(const GatheredMesh& all)
{
  Distribution distribution;
  std::array<int, 2> counts{};
  for (std::size_t e = 0; !all.homes.empty() && counts != std::array<int, 2>{ ofEach, ofEach };
       e = (e + 1) % all.homes.size())
  {
    int& count = counts[all.homes[e].rank];
    if (count < ofEach)
    {
      Particle& particle = distribution.particles.emplace_back(Particle());
      particle.location.element = static_cast<int>(e);
      particle.residual = count++;
    }
  }
  return distribution;
}

TEST(ParticlesHome, SendsManyParticlesInSmallMessages)
{
  constexpr int worker = 1;
  const std::vector<ElementMesh> parts = scattered(wholeMesh(Domain::Hexahedron), 2, 1);
  runRanks(2,
    [&](Exchange& inMemory)
    {
      CountingExchange exchange(inMemory);
      ElementMesh mine = parts[exchange.rank()];
      const std::vector<MeshSize> sizes = gatherFromAll(exchange, sizeOf(mine, CellsOfRank));
      const GatheredMesh all = gatheredAt(exchange, worker, mine);
      Distribution distribution = manyParticles(all);
      exchange.takeLargest();
      const HomeParticles home = bringHome(exchange, worker, distribution, true, all, sizes, {});
      EXPECT_LT(exchange.takeLargest(), ofEach * sizeof(Particle) / 2);
      ASSERT_EQ(home.distribution.particles.size(), static_cast<std::size_t>(ofEach));
      for (int i = 0; i < ofEach; ++i)
      {
        ASSERT_LT(home.distribution.particles[i].location.element,
          static_cast<int>(parts[exchange.rank()].elements.size()));
      }
    });
}

TEST(ParticlesHome, EndsOnAllRanksWhereTheWorkerIsAskedTo)
{
  constexpr int worker = 1;
  const std::vector<ElementMesh> parts = scattered(wholeMesh(Domain::Hexahedron), 2, 1);
  int all = 0; // questions of a run that nobody ends
  for (int most = -1; most < all; ++most)
  {
    int asked = 0;
    const ParallelFor parallelFor = [&](std::ptrdiff_t count, const LoopBody& body)
    {
      if (asked++ == most)
      {
        throw Interrupted();
      }
      body(0, count);
    };
    runRanks(2,
      [&](Exchange& exchange)
      {
        ElementMesh mine = parts[exchange.rank()];
        const std::vector<MeshSize> sizes = gatherFromAll(exchange, sizeOf(mine, CellsOfRank));
        const GatheredMesh gathered = gatheredAt(exchange, worker, mine);
        Distribution distribution = manyParticles(gathered);
        const HomeParticles home =
          bringHome(exchange, worker, distribution, true, gathered, sizes, parallelFor);
        EXPECT_EQ(home.isComplete, most < 0) << most;
        EXPECT_FALSE(home.lacksMemory);
      });
    all = most < 0 ? asked : all;
  }
  EXPECT_GT(all, 3); // one a message, at least
}

TEST(ParticlesHome, AddsPartsBehindEachOther)
{
  const auto partOf = [](std::initializer_list<int> elements, std::size_t room)
  {
    Distribution part;
    part.particles.reserve(room);
    for (const int element : elements)
    {
      part.particles.emplace_back(Particle()).location.element = element;
    }
    return part;
  };
  // There may be room in the memory of the sum, of the part, or of neither.
  for (const auto& [roomOfSum, roomOfPart] :
    { std::array<std::size_t, 2>{ 5, 2 }, { 3, 5 }, { 3, 2 } })
  {
    Distribution sum = partOf({ 1, 2, 3 }, roomOfSum);
    add(partOf({ 4, 5 }, roomOfPart), sum);
    ASSERT_EQ(sum.particles.size(), 5u);
    for (int i = 0; i < 5; ++i)
    {
      EXPECT_EQ(sum.particles[i].location.element, i + 1);
    }
  }
}

TEST(ParticlesHome, HasTheSameBitsByClassicToo)
{
  const ElementMesh whole = wholeMesh(Domain::Hexahedron);
  const std::vector<Bits> expected = particlesOf(whole, 1, 0, distributeClassic);
  ASSERT_GT(expected.size(), 300u);
  EXPECT_EQ(particlesOf(whole, 5, 2, distributeClassic), expected);
}

/// Two ranks, the second one the worker, with a particle in an element of each.
struct TwoRanks
{
  std::vector<ElementMesh> parts = scattered(wholeMesh(Domain::Hexahedron), 2, 1);

  /// \param change(exchange, distribution, isDone)
  template <class Change, class Check>
  void run(const Change& change, const Check& check) const
  {
    constexpr int worker = 1;
    runRanks(2,
      [&](Exchange& exchange)
      {
        ElementMesh mine = this->parts[exchange.rank()];
        const std::vector<MeshSize> sizes = gatherFromAll(exchange, sizeOf(mine, CellsOfRank));
        const GatheredMesh all = gatheredAt(exchange, worker, mine);
        Distribution distribution;
        distribution.particles.resize(all.homes.size());
        for (std::size_t e = 0; e < all.homes.size(); ++e)
        {
          distribution.particles[e] = Particle();
          distribution.particles[e].location.element = static_cast<int>(e);
        }
        bool isDone = true;
        change(exchange, distribution, isDone);
        check(exchange, bringHome(exchange, worker, distribution, isDone, all, sizes, {}));
      });
  }
};

TEST(ParticlesHome, BringsTheReportAndEachRanksOwnCells)
{
  const TwoRanks ranks;
  ranks.run(
    [](Exchange& exchange, Distribution& distribution, bool&)
    {
      if (exchange.rank() == 1)
      {
        distribution.report.evaluations = 12;
        distribution.report.boxesUndecided = 5;
        distribution.report.undecidedCells = { 3, CellsOfRank, CellsOfRank + 9 };
      }
    },
    [&](Exchange& exchange, const HomeParticles& home)
    {
      EXPECT_TRUE(home.isComplete);
      EXPECT_EQ(home.distribution.particles.size(), ranks.parts[exchange.rank()].elements.size());
      EXPECT_EQ(home.distribution.report.evaluations, 12);
      EXPECT_EQ(home.distribution.report.boxesUndecided, 5);
      EXPECT_EQ(home.distribution.report.undecidedCells,
        exchange.rank() == 0 ? std::vector<std::int64_t>{ 3 }
                             : (std::vector<std::int64_t>{ 0, 9 }));
    });
}

TEST(ParticlesHome, AllRanksLearnThatOneHasFailed)
{
  for (const int failed : { 0, 1 })
  {
    TwoRanks().run([&](Exchange& exchange, Distribution&, bool& isDone)
      { isDone = exchange.rank() != failed; },
      [](Exchange&, const HomeParticles& home)
      {
        EXPECT_FALSE(home.isComplete);
        EXPECT_FALSE(home.lacksMemory);
      });
  }
}

TEST(ParticlesHome, AllRanksLearnThatTheWorkerWasInterrupted)
{
  TwoRanks().run(
    [](Exchange&, Distribution& distribution, bool&)
    {
      distribution.particles.clear();
      distribution.report.aborted = true;
    },
    [](Exchange&, const HomeParticles& home) { EXPECT_FALSE(home.isComplete); });
}

} // namespace
} // namespace hop::testing
