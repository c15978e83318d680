#include "Surface/ParticleMesh.h"

#include "AnalyticFields.h"
#include "RanksInMemory.h"
#include "ScatteredMesh.h"
#include "Support/Interruptible.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

namespace hop::testing
{
namespace
{

constexpr int worker = 1;
constexpr int particleCount = 20000;
constexpr int nodesPerCell = 3;

/// Particles in all elements by turns, and a cell for each particle, with the next two.
void makeRing(const GatheredMesh& all, Distribution& whole, ParticleMesh& mesh)
{
  mesh.nodesPerCell = nodesPerCell;
  whole.particles.resize(particleCount);
  for (int p = 0; p < particleCount; ++p)
  {
    whole.particles[p] = Particle();
    whole.particles[p].location.element = p % static_cast<int>(all.homes.size());
    mesh.nodes.insert(mesh.nodes.end(), { p, (p + 1) % particleCount, (p + 2) % particleCount });
  }
  mesh.vertices.resize(particleCount);
  std::iota(mesh.vertices.begin(), mesh.vertices.end(), 0);
}

/// A ring of cells that a worker brings home to two ranks.
class RingOnTwoRanks
{
public:
  /// \param parallelFor the worker's
  /// \param check check(isComplete, mesh, home)
  template <class Check>
  void bringHome(const ParallelFor& parallelFor, const Check& check) const
  {
    runRanks(2,
      [&](Exchange& exchange)
      {
        ElementMesh mine = this->Parts[exchange.rank()];
        const GatheredMesh all = gatheredAt(exchange, worker, mine);
        Distribution whole;
        ParticleMesh mesh;
        if (exchange.rank() == worker)
        {
          makeRing(all, whole, mesh);
        }
        Distribution home;
        const bool isComplete = bringMeshHome(
          exchange, worker, whole, true, all, [](std::int64_t) { return 0; }, mesh, home,
          exchange.rank() == worker ? parallelFor : ParallelFor());
        check(isComplete, mesh, home);
      });
  }

private:
  static ElementMesh wholeMesh()
  {
    MeshRecipe recipe;
    recipe.cells = 3;
    recipe.field = torus(0.8, 0.3).field;
    return makeMesh(recipe);
  }

  std::vector<ElementMesh> Parts = scattered(wholeMesh(), 2, 1);
};

TEST(ParticleMesh, BringsEachCellToOneRank)
{
  std::atomic<std::size_t> cells{ 0 };
  RingOnTwoRanks().bringHome({},
    [&](bool isComplete, const ParticleMesh& mesh, const Distribution& home)
    {
      ASSERT_TRUE(isComplete);
      EXPECT_GT(mesh.nodes.size(), 1000u);
      cells += mesh.nodes.size() / nodesPerCell;
      EXPECT_EQ(home.particles.size(), mesh.foreign.size()); // copies only: this test has no others
    });
  EXPECT_EQ(cells, static_cast<std::size_t>(particleCount));
}

TEST(ParticleMesh, EndsOnAllRanksWhereTheWorkerIsAskedTo)
{
  const RingOnTwoRanks ring;
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
    ring.bringHome(parallelFor,
      [&](bool isComplete, const ParticleMesh&, const Distribution&)
      { EXPECT_EQ(isComplete, most < 0) << most; });
    all = most < 0 ? asked : all;
  }
  EXPECT_GT(all, 6); // also between the cells of a rank
}

} // namespace
} // namespace hop::testing
