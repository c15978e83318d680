#include "Fast/SlabDistribution.h"

#include "AnalyticFields.h"
#include "DistributionMeasures.h"
#include "ElementCases.h"
#include "Fast/FastDistribution.h"
#include "Fast/SlabMeshes.h"
#include "Fast/SlabPlan.h"
#include "Fast/SlabWorkers.h"
#include "Isolation/SurfaceBoxes.h"
#include "RanksInMemory.h"
#include "ScatteredMesh.h"
#include "SurfaceSeeds.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <mutex>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;

/// A surface, and how it is to be covered.
struct SlabCase
{
  const char* name;
  ElementMesh mesh;
  SizingFunction sizing;
};

ElementMesh meshOf(const Field& field, Domain domain, int cells, const Map& map)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { 4, 4, 4 };
  recipe.cells = cells;
  recipe.map = map;
  recipe.field = field;
  return makeMesh(recipe);
}

DistributionParameters parametersOf(const SlabCase& which)
{
  DistributionParameters parameters;
  parameters.sizing = which.sizing;
  return parameters;
}

/// As many slabs of equal work as are wanted.
std::vector<Slab> slabsOf(Exchange& exchange, const ElementMesh& mine, const SlabCase& which,
  std::size_t count)
{
  std::vector<Slab> slabs;
  for (double particles = 1e6; slabs.size() < count; particles *= 0.98)
  {
    slabs = planSlabs(exchange, mine, { 0.0 }, which.sizing, particles, {});
    if (particles < 1.0)
    {
      throw std::runtime_error("the surface is too small for so many slabs");
    }
  }
  return slabs;
}

/// Particles of some workers on some ranks, which have the mesh in pieces.
struct Together
{
  std::vector<Slab> slabs;
  Buffer<Particle> particles;
};

Together distributeTogether(const SlabCase& which, std::size_t workers, int ranks = 1)
{
  const std::vector<ElementMesh> parts = scattered(which.mesh, ranks, 1);
  Together together;
  std::vector<Buffer<Particle>> ofSlabs(workers);
  std::mutex access;
  runRanks(ranks,
    [&](Exchange& exchange)
    {
      const ElementMesh& mine = parts[exchange.rank()];
      const std::vector<Slab> slabs = slabsOf(exchange, mine, which, workers);
      const SlabMeshes meshes =
        gatherSlabs(exchange, mine, CellsOfRank, slabs, which.sizing.spacing, true, {});
      const SlabResult result = distributeInSlabs(exchange, slabs, meshes.meshes,
        { nullptr, 0.0, tolerance }, parametersOf(which), meshes.isComplete, {}, {});
      EXPECT_TRUE(result.isComplete);
      const std::lock_guard lock(access);
      together.slabs = slabs;
      for (std::size_t slab = 0; slab < slabs.size(); ++slab)
      {
        const auto& some = result.distributions[slab].particles;
        ofSlabs[slab].insert(ofSlabs[slab].end(), some.begin(), some.end());
      }
    });
  for (const Buffer<Particle>& some : ofSlabs)
  {
    together.particles.insert(together.particles.end(), some.begin(), some.end());
  }
  return together;
}

void report(const char* what, const Buffer<Particle>& particles, const Evenness& all)
{
  std::cout << what << ": " << particles.size() << " least " << all.minSpacing << " variation "
            << all.variation << " circumradius " << all.circumradius << " open " << all.openStars
            << " six " << all.sixValentShare << '\n';
}

void compare(const SlabCase& which)
{
  const Distribution alone = distributeFast(
    { &which.mesh, 0.0, tolerance }, parametersOf(which), {}, {});
  report((std::string(which.name) + " alone").c_str(), alone.particles, measureEvenness(alone.particles));
  std::vector<glm::dvec3> probes;
  for (const Location& seed : surfaceSeeds(
         which.mesh, 0.0, findSurfaceBoxes(which.mesh, 0.0, 0.5 * which.sizing.spacing, {})))
  {
    probes.push_back(positionAt(which.mesh, seed));
  }
  std::cout << "coverage " << coverageRadius(alone.particles, probes) << '\n';
  for (const std::size_t workers : { 2, 3, 4, 7 })
  {
    const Together together = distributeTogether(which, workers);
    for (const double near : { 2.0, 5.0 })
    {
      const auto isBesideCut = [&](const glm::dvec3& position)
      {
        return std::any_of(together.slabs.begin(), together.slabs.end(),
          [&](const Slab& slab)
          {
            return std::abs(slab.placeOf(position) - slab.end) < near * which.sizing.spacing;
          });
      };
      report("  beside", together.particles,
        measureEvenness(together.particles,
          [&](const Particle& particle) { return isBesideCut(particle.position.xyz); }));
    }
    report("  all", together.particles, measureEvenness(together.particles));
    std::cout << workers << " ratio "
              << static_cast<double>(together.particles.size()) /
        static_cast<double>(alone.particles.size())
              << " coverage " << coverageRadius(together.particles, probes) << '\n';
  }
}

TEST(SlabDistribution, Explores)
{
  compare({ "sphere",
    meshOf(sphere({ 0, 0, 0 }, 0.6).field, Domain::Hexahedron, 6, wavyMap(0.1)), { 0.007, 0.0 } });
  compare({ "torus7",
    meshOf(torus(0.5, 0.22).field, Domain::Tetrahedron, 5, wavyMap(0.1)), { 0.008, 7.0 } });
}

TEST(SlabDistribution, ExploresBoundary)
{
  compare({ "torus with ends",
    meshOf(torus(0.8, 0.3).field, Domain::Wedge, 6, wavyMap(0.1)), { 0.011, 0.0 } });
}

} // namespace
} // namespace hop::testing
