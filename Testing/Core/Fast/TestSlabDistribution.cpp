// Several workers on one surface: on what the result may depend, and how they end together. How even their particles stand:
// TestSlabSeams.cpp.

#include "Fast/SlabDistribution.h"

#include "CountingExchange.h"
#include "Fast/SlabMeshes.h"
#include "Fast/SlabPlan.h"
#include "Fast/SlabWorkers.h"
#include "RanksInMemory.h"
#include "ScarceMemory.h"
#include "ScatteredMesh.h"
#include "SlabCases.h"
#include "Surface/ParticlesHome.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>

namespace hop::testing
{
namespace
{

class Slabs : public ::testing::TestWithParam<SlabCase>
{
};

INSTANTIATE_TEST_SUITE_P(SlabDistribution, Slabs,
  ::testing::Values(ellipsoidCase(), wavyTubeCase(), sheetCase(), steppedCase("SmallSteps", 0.0017),
    steppedCase("LargeSteps", 0.03)),
  [](const auto& which) { return which.param.name; });

/// Positions, to be sorted and compared to the last bit.
std::vector<std::array<double, 3>> bitsOf(const Buffer<Particle>& particles)
{
  std::vector<std::array<double, 3>> bits;
  for (const Particle& particle : particles)
  {
    const glm::dvec3& x = particle.position.xyz;
    bits.push_back({ x.x, x.y, x.z });
  }
  std::sort(bits.begin(), bits.end());
  return bits;
}

TEST_P(Slabs, HaveTheSameBitsOnAnyRanksAndThreads)
{
  const SlabCase which = this->GetParam().coarse();
  const ElementMesh mesh = meshOf(which);
  constexpr std::size_t workers = 3;
  const auto expected = bitsOf(distributeTogether(which, mesh, workers).particles);
  ASSERT_GT(expected.size(), 1000u);
  for (const int ranks : { 2, 3, 5 })
  {
    EXPECT_EQ(bitsOf(distributeTogether(which, mesh, workers, ranks).particles), expected) << ranks;
  }
  const ParallelFor threads = threadedFor(3);
  EXPECT_EQ(bitsOf(distributeTogether(which, mesh, workers, 1, threads).particles), expected);
}

/// The bar of 6 x 6 x 6 straight elements, with a closed component in each: needles, three spacings long.
struct Needles
{
  static constexpr int Cells = 6;
  static constexpr double Level = 0.97;

  static SlabCase sizing() { return { "Needles", Domain::Hexahedron, {}, { 0.02, 0.0 } }; }

  /// In units of elements, from 0 to Cells, from coordinates of the cube [-1,1]^3.
  static glm::dvec3 inElements(const glm::dvec3& x) { return 0.5 * Cells * (x + 1.0); }

  static ElementMesh mesh()
  {
    const glm::dmat3 turn = barTurn();
    const glm::dvec3 size(BarWidth, BarWidth, 1.0);
    MeshRecipe recipe;
    recipe.cells = Cells;
    recipe.map = [=](const glm::dvec3& x) { return turn * (size * x); };
    recipe.field = [=](const glm::dvec3& x)
    {
      const glm::dvec3 t = glm::fract(inElements(glm::transpose(turn) * x / size));
      const glm::dvec3 bump = 4.0 * t * (1.0 - t);
      return bump.x * bump.y * bump.z - Level;
    };
    return makeMesh(recipe);
  }

  /// Number of particles in each element.
  static std::vector<int> counts(const Buffer<Particle>& particles)
  {
    std::vector<int> counts(Cells * Cells * Cells);
    for (const Particle& particle : particles)
    {
      const glm::dvec3 x = glm::transpose(barTurn()) * particle.position.xyz;
      const glm::ivec3 cell(inElements(x / glm::dvec3(BarWidth, BarWidth, 1.0)));
      ++counts[(cell.z * Cells + cell.y) * Cells + cell.x];
    }
    return counts;
  }
};

/// Some of them lie across planes between slabs: one worker alone puts particles there.
TEST(SlabDistribution, PutsSixParticlesOnSmallComponents)
{
  const ElementMesh mesh = Needles::mesh();
  const SlabCase which = Needles::sizing();
  for (const std::size_t workers : { 2, 3, 4 })
  {
    const Together together = distributeTogether(which, mesh, workers);
    const std::vector<int> counts = Needles::counts(together.particles);
    EXPECT_GE(*std::min_element(counts.begin(), counts.end()), 6) << workers;
    EXPECT_LE(*std::max_element(counts.begin(), counts.end()), 24) << workers;
    EXPECT_EQ(bitsOf(distributeTogether(which, mesh, workers, 2, threadedFor(3)).particles),
      bitsOf(together.particles));
  }
}

TEST(SlabDistribution, SharesTheWork)
{
  const SlabCase which = ellipsoidCase();
  // The first has the strip at its end, the last has none.
  const Together together = distributeTogether(which, meshOf(which), 4);
  const double share = static_cast<double>(together.particles.size()) / 4.0;
  for (const std::size_t count : together.counts)
  {
    EXPECT_NEAR(static_cast<double>(count), share, 0.2 * share);
  }
}

/// Three workers on two ranks. One rank changes what it does.
void runTwoRanks(const std::function<SlabResult(
    Exchange&, const std::vector<Slab>&, const SlabMeshes&, const DistributionParameters&)>& work)
{
  const SlabCase which = ellipsoidCase().coarse();
  const std::vector<ElementMesh> parts = scattered(meshOf(which), 2, 1);
  runRanks(
    2,
    [&](Exchange& exchange)
    {
      const ElementMesh& mine = parts[exchange.rank()];
      const std::vector<Slab> slabs = slabsOf(exchange, mine, which, 3);
      const SlabMeshes meshes =
        gatherSlabs(exchange, mine, CellsOfRank, slabs, which.sizing.spacing, true, {});
      ASSERT_TRUE(meshes.isComplete);
      const SlabResult result = work(exchange, slabs, meshes, parametersOf(which));
      EXPECT_FALSE(result.isComplete);
      for (const Distribution& some : result.distributions)
      {
        EXPECT_TRUE(some.particles.empty());
      }
    },
    LongestWait);
}

TEST(SlabDistribution, EndsOnAllRanksWhereOneIsInterrupted)
{
  // Questions after which the answer is to stop: at the beginning, and later. Quick runs ask few.
  for (const int most : { 0, 1, 2 })
  {
    runTwoRanks(
      [&](Exchange& exchange, const std::vector<Slab>& slabs, const SlabMeshes& meshes,
        const DistributionParameters& parameters)
      {
        int asked = 0;
        const Monitor monitor{ [&](double) { return exchange.rank() == 0 || asked++ < most; } };
        return distributeInSlabs(exchange, slabs, meshes.meshes, { nullptr, 0.0, SlabTolerance },
          parameters, true, monitor, {});
      });
  }
}

TEST(SlabDistribution, EndsOnAllRanksAtAnyMoment)
{
  const SlabCase which = ellipsoidCase().coarse();
  const std::vector<ElementMesh> parts = scattered(meshOf(which), 2, 1);
  using Clock = std::chrono::steady_clock;
  std::atomic<double> whole{ 0.0 }; // seconds of the first run
  for (int n = 0; n <= 20; ++n)
  {
    std::atomic<bool> isStopped{ false };
    const double share = std::fmod(0.618 * n, 1.0);
    runRanks(
      2,
      [&](Exchange& exchange)
      {
        const ElementMesh& mine = parts[exchange.rank()];
        const std::vector<Slab> slabs = slabsOf(exchange, mine, which, 3);
        const SlabMeshes meshes =
          gatherSlabs(exchange, mine, CellsOfRank, slabs, which.sizing.spacing, true, {});
        const auto begin = Clock::now();
        const auto seconds = [&]()
        { return std::chrono::duration<double>(Clock::now() - begin).count(); };
        const Monitor monitor{ [&](double)
          {
            const bool stops = n > 0 && exchange.rank() == n % 2 && seconds() > share * whole;
            isStopped = isStopped || stops;
            return !stops;
          } };
        const SlabResult result = distributeInSlabs(exchange, slabs, meshes.meshes,
          { nullptr, 0.0, SlabTolerance }, parametersOf(which), true, monitor, {});
        if (n == 0 && exchange.rank() == 0)
        {
          whole = seconds();
        }
        EXPECT_EQ(result.isComplete, !isStopped);
        std::size_t particles = 0;
        for (const Distribution& some : result.distributions)
        {
          particles += some.particles.size();
        }
        EXPECT_EQ(particles > 0, result.isComplete);
      },
      LongestWait);
    EXPECT_TRUE(n > 0 || !isStopped);
  }
}

/// What a rank says of a step that two ranks have taken together.
struct Outcome
{
  bool isComplete = false;
  /// Whether this rank has failed.
  bool hasFailed = false;
};

using Step = std::function<Outcome(Exchange&)>;

/// Lets two ranks take a step. One of them lacks memory for one of its allocations.
/// \param leastSize more bytes than what ranks tell each other of their sizes
/// \return whether that rank has come so far
bool takeWithoutMemory(const Step& step, std::size_t leastSize, int rank, long failing)
{
  std::atomic<bool> hasFailed{ false };
  runRanks(
    2,
    [&](Exchange& inMemory)
    {
      ExchangeWithMemory exchange(inMemory);
      Outcome outcome;
      {
        const ScarceMemory memory(exchange.rank() == rank ? failing : NeverFails, leastSize);
        outcome = step(exchange);
        hasFailed = hasFailed || memory.hasFailed();
      }
      const bool isWithout = exchange.rank() == rank && hasFailed;
      EXPECT_EQ(outcome.hasFailed, isWithout);
      EXPECT_EQ(outcome.isComplete, allAgree(exchange, !isWithout));
    },
    LongestWait);
  return hasFailed;
}

/// Lets each rank lack memory for its first allocations one by one, and for ever fewer of those behind them.
/// \return how many allocations there are, at least
long sweepWithoutMemory(const Step& step, std::size_t leastSize, long oneByOne)
{
  long least = NeverFails;
  for (const int rank : { 0, 1 })
  {
    long failing = 0;
    while (takeWithoutMemory(step, leastSize, rank, failing) && !::testing::Test::HasFailure())
    {
      failing += 1 + failing / oneByOne;
    }
    least = std::min(least, failing);
  }
  return least;
}

/// Three workers on two ranks, and what they have before they begin.
struct ThreeWorkers
{
  SlabCase which = ellipsoidCase().coarse();
  std::vector<ElementMesh> parts = scattered(meshOf(which), 2, 1);
  std::vector<Slab> slabs;
  std::array<SlabMeshes, 2> meshes;

  ThreeWorkers()
  {
    runRanks(2,
      [&](Exchange& exchange)
      {
        const std::vector<Slab> planned = slabsOf(exchange, this->mine(exchange), this->which, 3);
        if (exchange.rank() == 0)
        {
          this->slabs = planned;
        }
        this->meshes[exchange.rank()] = this->gather(exchange, planned);
      });
  }

  const ElementMesh& mine(const Exchange& exchange) const { return this->parts[exchange.rank()]; }

  SlabMeshes gather(Exchange& exchange, const std::vector<Slab>& planned) const
  {
    return gatherSlabs(
      exchange, this->mine(exchange), CellsOfRank, planned, this->which.sizing.spacing, true, {});
  }

  SlabResult distribute(Exchange& exchange) const
  {
    return distributeInSlabs(exchange, this->slabs, this->meshes[exchange.rank()].meshes,
      { nullptr, 0.0, SlabTolerance }, parametersOf(this->which), true, {}, {});
  }
};

TEST(SlabDistribution, RanksDoNotWaitForOneWithoutMemoryForElements)
{
  const ThreeWorkers workers;
  const auto gather = [&](Exchange& exchange)
  {
    const SlabMeshes meshes = workers.gather(exchange, workers.slabs);
    return Outcome{ meshes.isComplete, static_cast<bool>(meshes.failure) };
  };
  EXPECT_GT(sweepWithoutMemory(gather, 256, 1000), 20);
}

TEST(SlabDistribution, RanksDoNotWaitForOneWithoutMemoryForThePlan)
{
  const ThreeWorkers workers;
  const auto plan = [&](Exchange& exchange)
  {
    const SlabPlan planned =
      planSlabs(exchange, workers.mine(exchange), { 0.0 }, workers.which.sizing, 500.0, {});
    return Outcome{ planned.slabs.size() > 1, static_cast<bool>(planned.failure) };
  };
  EXPECT_GT(sweepWithoutMemory(plan, 64, 1000), 20);
}

TEST(SlabDistribution, RanksDoNotWaitForOneWithoutMemoryForParticles)
{
  const ThreeWorkers workers;
  const auto distribute = [&](Exchange& exchange)
  {
    const SlabResult result = workers.distribute(exchange);
    return Outcome{ result.isComplete, static_cast<bool>(result.failure) };
  };
  EXPECT_GT(sweepWithoutMemory(distribute, 16, 10), 20);
}

TEST(SlabDistribution, RanksDoNotWaitForOneWithoutMemoryToBringThemHome)
{
  const ThreeWorkers workers;
  std::array<std::vector<Distribution>, 2> distributions;
  std::vector<MeshSize> sizes;
  for (const ElementMesh& part : workers.parts)
  {
    sizes.push_back(sizeOf(part, CellsOfRank));
  }
  runRanks(
    2,
    [&](Exchange& exchange)
    { distributions[exchange.rank()] = workers.distribute(exchange).distributions; },
    LongestWait);
  const auto bringAllHome = [&](Exchange& exchange)
  {
    Outcome outcome{ true, false };
    for (std::size_t slab = 0; slab < workers.slabs.size(); ++slab)
    {
      const HomeParticles home = bringHome(exchange, rankOfSlab(slab, workers.slabs.size(), 2),
        distributions[exchange.rank()][slab], true, workers.meshes[exchange.rank()].meshes[slab],
        sizes, {}, true);
      outcome.isComplete = outcome.isComplete && home.isComplete;
      outcome.hasFailed = outcome.hasFailed || home.lacksMemory;
    }
    return outcome;
  };
  EXPECT_GT(sweepWithoutMemory(bringAllHome, 256, 1000), 3);
}

TEST(SlabDistribution, SendsNothingAsLargeAsTheMesh)
{
  const SlabCase which = ellipsoidCase();
  const ElementMesh mesh = meshOf(which);
  const std::size_t ofMesh = mesh.coefficients.size() * sizeof(mesh.coefficients[0]);
  const std::size_t ofParticles = distributeAlone(which, mesh).particles.size() * sizeof(Particle);
  constexpr int ranks = 4;
  const std::vector<ElementMesh> parts = scattered(mesh, ranks, 1);
  runRanks(
    ranks,
    [&](Exchange& inMemory)
    {
      CountingExchange exchange(inMemory);
      const ElementMesh& mine = parts[exchange.rank()];
      const std::vector<Slab> slabs = slabsOf(exchange, mine, which, ranks);
      EXPECT_LE(exchange.takeLargest(), 10000u); // what all ranks hear
      const SlabMeshes meshes =
        gatherSlabs(exchange, mine, CellsOfRank, slabs, which.sizing.spacing, true, {});
      EXPECT_LE(exchange.takeLargest(), ofMesh / ranks);
      distributeInSlabs(exchange, slabs, meshes.meshes, { nullptr, 0.0, SlabTolerance },
        parametersOf(which), true, {}, {});
      EXPECT_LE(exchange.takeLargest(), ofParticles / ranks);
    },
    LongestWait);
}

TEST(SlabDistribution, EndsOnAllRanksWhereOneRefusesOrHasFailed)
{
  for (const bool refuses : { true, false })
  {
    runTwoRanks(
      [&](Exchange& exchange, const std::vector<Slab>& slabs, const SlabMeshes& meshes,
        DistributionParameters parameters)
      {
        const bool isTheOne = exchange.rank() == 1;
        parameters.particleLimit = isTheOne && refuses ? 10 : parameters.particleLimit;
        const SlabResult result = distributeInSlabs(exchange, slabs, meshes.meshes,
          { nullptr, 0.0, SlabTolerance }, parameters, refuses || !isTheOne, {}, {});
        const bool saysWhy = std::any_of(result.distributions.begin(), result.distributions.end(),
          [](const Distribution& some) { return !some.report.error.empty(); });
        EXPECT_EQ(saysWhy, isTheOne && refuses);
        return result;
      });
  }
}

TEST(SlabDistribution, ReportsEachUndecidedCellOnce)
{
  // Sheets cross on the axis of the bar.
  SlabCase which = ellipsoidCase().coarse();
  which.field = [](const glm::dvec3& x) { return (x.x - 0.011) * (x.y + 0.013); };
  const ElementMesh mesh = meshOf(which);
  const Together alone = distributeAlone(which, mesh);
  ASSERT_GT(alone.undecided, 0);
  const Together together = distributeTogether(which, mesh, 3);
  EXPECT_EQ(together.undecided, alone.undecided);
}

TEST(SlabPlan, FollowsFromTheWorkAlone)
{
  const SlabCase which = ellipsoidCase();
  const ElementMesh mesh = meshOf(which);
  NoExchange alone;
  const auto expected = planSlabs(alone, mesh, { 0.0 }, which.sizing, 5000.0, {}).slabs;
  ASSERT_GT(expected.size(), 2u);
  for (const int ranks : { 2, 5 })
  {
    const std::vector<ElementMesh> parts = scattered(mesh, ranks, ranks);
    runRanks(ranks,
      [&](Exchange& exchange)
      {
        const auto slabs =
          planSlabs(exchange, parts[exchange.rank()], { 0.0 }, which.sizing, 5000.0, {}).slabs;
        ASSERT_EQ(slabs.size(), expected.size());
        for (std::size_t n = 0; n < slabs.size(); ++n)
        {
          EXPECT_EQ(slabs[n].begin, expected[n].begin);
          EXPECT_EQ(slabs[n].end, expected[n].end);
        }
      });
  }
}

TEST(SlabPlan, MakesNoThinSlabs)
{
  const SlabCase which = ellipsoidCase();
  NoExchange alone;
  const auto slabs = planSlabs(alone, meshOf(which), { 0.0 }, which.sizing, 1.0, {}).slabs;
  EXPECT_GT(slabs.size(), 4u);
  for (std::size_t n = 1; n + 1 < slabs.size(); ++n)
  {
    EXPECT_GE(slabs[n].end - slabs[n].begin, SlabOverlap::Thickness * which.sizing.spacing);
  }
}

TEST(SlabPlan, LeavesSmallSurfacesInOne)
{
  const SlabCase which = ellipsoidCase();
  NoExchange alone;
  const auto slabs = planSlabs(alone, meshOf(which), { 0.0 }, which.sizing, 1e6, {}).slabs;
  ASSERT_EQ(slabs.size(), 1u);
  EXPECT_TRUE(slabs[0].isEverything());
  const auto none = planSlabs(alone, {}, { 0.0 }, which.sizing, 1.0, {}).slabs;
  ASSERT_EQ(none.size(), 1u);
}

} // namespace
} // namespace hop::testing
