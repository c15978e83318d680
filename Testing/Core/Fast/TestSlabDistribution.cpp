// Several workers on one surface: how even their particles stand where they meet, and on what the result may depend.

#include "Fast/SlabDistribution.h"

#include "CountingExchange.h"
#include "DistributionMeasures.h"
#include "Elements/CanonicalOrder.h"
#include "Fast/FastDistribution.h"
#include "Fast/SlabMeshes.h"
#include "Fast/SlabPlan.h"
#include "Fast/SlabWorkers.h"
#include "Isolation/SurfaceBoxes.h"
#include "RanksInMemory.h"
#include "ScarceMemory.h"
#include "ScatteredMesh.h"
#include "Surface/ParticlesHome.h"
#include "SurfaceSeeds.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <ostream>
#include <stdexcept>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;
/// Workers wait for each other longer than messages take.
constexpr std::chrono::seconds longestWait{ 120 };

/// A surface in a long bar, to be cut across.
struct SlabCase
{
  const char* name = "";
  Domain domain = Domain::Hexahedron;
  /// In the coordinates of the bar, which reaches from -1 to 1 along z.
  Field field;
  SizingFunction sizing;
  /// By how much the values of every other element are raised.
  double jump = 0.0;
  /// Share of the particles on boundary curves that may be more or fewer: at small jumps chance decides which of two
  /// curves beside each other stays.
  double curvesOff = 0.005;
};

std::ostream& operator<<(std::ostream& out, const SlabCase& which)
{
  return out << which.name;
}

/// Turns the z axis into the direction along which slabs follow each other.
glm::dmat3 turned()
{
  const glm::dvec3 along = sweepDirection();
  const glm::dvec3 aside = glm::normalize(glm::cross(along, glm::dvec3(1, 0, 0)));
  return { aside, glm::cross(along, aside), along };
}

constexpr double barWidth = 0.2;

ElementMesh meshOf(const SlabCase& which)
{
  const glm::dmat3 turn = turned();
  MeshRecipe recipe;
  recipe.domain = which.domain;
  recipe.degrees = { 3, 3, 3 };
  recipe.cells = 6;
  const Map bend = wavyMap(0.1);
  recipe.map = [=](const glm::dvec3& x)
  { return turn * (glm::dvec3(barWidth, barWidth, 1.0) * bend(x)); };
  recipe.field = [=](const glm::dvec3& x) { return which.field(glm::transpose(turn) * x); };
  ElementMesh mesh = makeMesh(recipe);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    mesh.elements[e].cell = static_cast<std::int64_t>(e);
    const BernsteinForm form = mesh.form(static_cast<int>(e));
    for (int i = 0; i < coefficientCount(form.domain, form.degrees); ++i)
    {
      mesh.coefficients[mesh.elements[e].firstCoefficient + i].w += e % 2 == 0 ? which.jump : 0.0;
    }
  }
  return mesh;
}

SlabCase ellipsoidCase()
{
  return { "Ellipsoid", Domain::Hexahedron,
    [](const glm::dvec3& x) { return x.x * x.x + x.y * x.y + x.z * x.z / 36.0 - 0.15 * 0.15; },
    { 0.009, 0.0 } };
}

SlabCase wavyTubeCase()
{
  return { "WavyTube", Domain::Tetrahedron,
    [](const glm::dvec3& x)
    {
      const double radius = 0.1 + 0.03 * std::sin(5.0 * x.z);
      return std::hypot(x.x, x.y) - radius + 0.3 * std::pow(x.z, 8);
    },
    { 0.009, 7.0 } };
}

SlabCase sheetCase()
{
  return { "SheetWithEnds", Domain::Wedge,
    [](const glm::dvec3& x) { return x.x + 0.3 * x.y - 0.04 * std::sin(4.0 * x.z); },
    { 0.0095, 0.0 } };
}

SlabCase steppedCase(const char* name, double jump)
{
  SlabCase stepped = sheetCase();
  stepped.name = name;
  stepped.domain = Domain::Hexahedron;
  stepped.jump = jump;
  stepped.curvesOff = 0.05;
  return stepped;
}

DistributionParameters parametersOf(const SlabCase& which)
{
  DistributionParameters parameters;
  parameters.sizing = which.sizing;
  return parameters;
}

/// As many slabs of equal work as are wanted.
std::vector<Slab> slabsOf(
  Exchange& exchange, const ElementMesh& mine, const SlabCase& which, std::size_t count)
{
  std::vector<Slab> slabs;
  for (double particles = 4e4; slabs.size() < count; particles *= 0.95)
  {
    slabs = planSlabs(exchange, mine, { 0.0 }, which.sizing, particles, {}).slabs;
    if (particles < 1.0)
    {
      throw std::runtime_error("the surface is too small for so many slabs");
    }
  }
  return slabs;
}

/// What workers have made together.
struct Together
{
  std::vector<Slab> slabs;
  Buffer<Particle> particles;
  std::vector<std::size_t> counts;
  std::int64_t undecided = 0;

  bool isBesideCut(const glm::dvec3& position, double distance) const
  {
    return std::any_of(this->slabs.begin(), this->slabs.end(),
      [&](const Slab& slab) { return std::abs(slab.placeOf(position) - slab.end) < distance; });
  }
};

/// Lets workers on some ranks, which have the elements by chance, distribute particles.
Together distributeTogether(const SlabCase& which, const ElementMesh& mesh, std::size_t workers,
  int ranks = 1, const ParallelFor& parallelFor = {})
{
  const std::vector<ElementMesh> parts = scattered(mesh, ranks, ranks);
  Together together;
  std::vector<Distribution> ofSlabs(workers);
  std::mutex access;
  runRanks(
    ranks,
    [&](Exchange& exchange)
    {
      const ElementMesh& mine = parts[exchange.rank()];
      const std::vector<Slab> slabs = slabsOf(exchange, mine, which, workers);
      const SlabMeshes meshes =
        gatherSlabs(exchange, mine, CellsOfRank, slabs, which.sizing.spacing, true, parallelFor);
      SlabResult result = distributeInSlabs(exchange, slabs, meshes.meshes,
        { nullptr, 0.0, tolerance }, parametersOf(which), meshes.isComplete, {}, parallelFor);
      EXPECT_TRUE(result.isComplete);
      const std::lock_guard lock(access);
      together.slabs = slabs;
      for (std::size_t slab = 0; slab < slabs.size(); ++slab)
      {
        if (rankOfSlab(slab, slabs.size(), ranks) == exchange.rank())
        {
          ofSlabs[slab] = std::move(result.distributions[slab]);
        }
      }
    },
    longestWait);
  for (const Distribution& some : ofSlabs)
  {
    together.particles.insert(
      together.particles.end(), some.particles.begin(), some.particles.end());
    together.counts.push_back(some.particles.size());
    together.undecided += some.report.boxesUndecided;
  }
  return together;
}

Distribution distributeAlone(const SlabCase& which, const ElementMesh& mesh)
{
  // The order of the elements decides at jumps.
  const GatheredMesh all = gatheredAlone(mesh);
  return distributeFast({ &all.mesh, 0.0, tolerance }, parametersOf(which), {}, {});
}

std::vector<glm::dvec3> probesOf(const ElementMesh& mesh, double spacing)
{
  std::vector<glm::dvec3> probes;
  for (const Location& seed : surfaceSeeds(mesh, 0.0, findSurfaceBoxes(mesh, 0.0, spacing, {})))
  {
    probes.push_back(positionAt(mesh, seed));
  }
  return probes;
}

std::ptrdiff_t boundaryCount(const Buffer<Particle>& particles)
{
  return std::count_if(particles.begin(), particles.end(),
    [](const Particle& particle)
    {
      return std::any_of(particle.clips.begin(), particle.clips.end(),
        [](const ClipPlane& plane) { return plane.isBoundary() && plane.distance == 0.0; });
    });
}

class Slabs : public ::testing::TestWithParam<SlabCase>
{
};

INSTANTIATE_TEST_SUITE_P(SlabDistribution, Slabs,
  ::testing::Values(ellipsoidCase(), wavyTubeCase(), sheetCase(), steppedCase("SmallSteps", 0.0017),
    steppedCase("LargeSteps", 0.03)),
  [](const auto& which) { return which.param.name; });

/// Within two spacings of cuts particles stand as one worker has them anywhere.
TEST_P(Slabs, FitTogether)
{
  const SlabCase& which = this->GetParam();
  const ElementMesh mesh = meshOf(which);
  const double near = 2.0 * which.sizing.spacing;
  const Distribution alone = distributeAlone(which, mesh);
  const Evenness promised = measureEvenness(alone.particles);
  const std::vector<glm::dvec3> probes = probesOf(mesh, 0.4 * which.sizing.spacing);
  const double covered = coverageRadius(alone.particles, probes);
  for (const std::size_t workers : { 2, 3, 4, 7 })
  {
    const Together together = distributeTogether(which, mesh, workers);
    const auto isNear = [&](const Particle& particle)
    { return together.isBesideCut(particle.position.xyz, near); };
    const Evenness evenness = measureEvenness(together.particles, isNear);
    std::vector<glm::dvec3> probesNear;
    std::copy_if(probes.begin(), probes.end(), std::back_inserter(probesNear),
      [&](const glm::dvec3& probe) { return together.isBesideCut(probe, near); });
    EXPECT_GE(evenness.minSpacing, std::min(0.8, promised.minSpacing));
    EXPECT_LE(evenness.variation, std::max(0.035, 1.3 * promised.variation));
    EXPECT_LE(coverageRadius(together.particles, probesNear), std::max(0.80, covered));
    const auto count = static_cast<double>(alone.particles.size());
    EXPECT_NEAR(static_cast<double>(together.particles.size()), count, 0.005 * count) << workers;
    // No boundary curve is there twice, and none has a gap.
    const auto onCurves = static_cast<double>(boundaryCount(alone.particles));
    EXPECT_NEAR(static_cast<double>(boundaryCount(together.particles)), onCurves,
      static_cast<double>(workers) + which.curvesOff * onCurves);
  }
}

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

SlabCase coarse(SlabCase which)
{
  which.sizing.spacing = 0.02;
  return which;
}

TEST_P(Slabs, HaveTheSameBitsOnAnyRanksAndThreads)
{
  const SlabCase which = coarse(this->GetParam());
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
  const SlabCase which = coarse(ellipsoidCase());
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
    longestWait);
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
        return distributeInSlabs(exchange, slabs, meshes.meshes, { nullptr, 0.0, tolerance },
          parameters, true, monitor, {});
      });
  }
}

TEST(SlabDistribution, EndsOnAllRanksAtAnyMoment)
{
  const SlabCase which = coarse(ellipsoidCase());
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
          { nullptr, 0.0, tolerance }, parametersOf(which), true, monitor, {});
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
      longestWait);
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
    longestWait);
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
  SlabCase which = coarse(ellipsoidCase());
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
      { nullptr, 0.0, tolerance }, parametersOf(this->which), true, {}, {});
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
    longestWait);
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
      distributeInSlabs(exchange, slabs, meshes.meshes, { nullptr, 0.0, tolerance },
        parametersOf(which), true, {}, {});
      EXPECT_LE(exchange.takeLargest(), ofParticles / ranks);
    },
    longestWait);
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
          { nullptr, 0.0, tolerance }, parameters, refuses || !isTheOne, {}, {});
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
  SlabCase which = coarse(ellipsoidCase());
  which.field = [](const glm::dvec3& x) { return (x.x - 0.011) * (x.y + 0.013); };
  const ElementMesh mesh = meshOf(which);
  const Distribution alone = distributeAlone(which, mesh);
  ASSERT_GT(alone.report.boxesUndecided, 0);
  const Together together = distributeTogether(which, mesh, 3);
  EXPECT_EQ(together.undecided, alone.report.boxesUndecided);
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
