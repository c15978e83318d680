// Several workers on one surface: how even their particles stand where they meet, and on what the result may depend.

#include "Fast/SlabDistribution.h"

#include "DistributionMeasures.h"
#include "Elements/CanonicalOrder.h"
#include "Fast/FastDistribution.h"
#include "Fast/SlabMeshes.h"
#include "Fast/SlabPlan.h"
#include "Fast/SlabWorkers.h"
#include "Isolation/SurfaceBoxes.h"
#include "RanksInMemory.h"
#include "ScatteredMesh.h"
#include "SurfaceSeeds.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <iostream>
#include <ostream>
#include <stdexcept>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;

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

constexpr double barWidth = 0.3;

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
    [](const glm::dvec3& x) {
      return x.x * x.x + x.y * x.y + x.z * x.z / 16.0 - 0.22 * 0.22;
    },
    { 0.015, 0.0 } };
}

SlabCase wavyTubeCase()
{
  return { "WavyTube", Domain::Tetrahedron,
    [](const glm::dvec3& x)
    {
      const double radius = 0.15 + 0.04 * std::sin(5.0 * x.z);
      return std::hypot(x.x, x.y) - radius + 0.3 * std::pow(x.z, 8);
    },
    { 0.016, 7.0 } };
}

SlabCase sheetCase()
{
  return { "SheetWithEnds", Domain::Wedge,
    [](const glm::dvec3& x) { return x.x + 0.3 * x.y - 0.04 * std::sin(4.0 * x.z); },
    { 0.015, 0.0 } };
}

SlabCase steppedCase(const char* name, double jump)
{
  SlabCase stepped = sheetCase();
  stepped.name = name;
  stepped.domain = Domain::Hexahedron;
  stepped.jump = jump;
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
  for (double particles = 2e4; slabs.size() < count; particles *= 0.95)
  {
    slabs = planSlabs(exchange, mine, { 0.0 }, which.sizing, particles, {});
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
  runRanks(ranks,
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
    });
  for (const Distribution& some : ofSlabs)
  {
    together.particles.insert(
      together.particles.end(), some.particles.begin(), some.particles.end());
    together.counts.push_back(some.particles.size());
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
  ::testing::Values(ellipsoidCase(), wavyTubeCase(), sheetCase(), steppedCase("SmallSteps", 0.003),
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
    std::cout << which.name << ' ' << workers << " least " << evenness.minSpacing << " of " << promised.minSpacing << " var " << evenness.variation << " of " << promised.variation << " cover " << coverageRadius(together.particles, probesNear) << " of " << covered << " ratio " << static_cast<double>(together.particles.size()) / static_cast<double>(alone.particles.size()) << " boundary " << boundaryCount(together.particles) << " of " << boundaryCount(alone.particles) << " open " << measureEvenness(together.particles).openStars << " of " << promised.openStars << "\n";
    EXPECT_GE(evenness.minSpacing, std::min(0.80, promised.minSpacing));
    EXPECT_LE(evenness.variation, std::max(0.035, 1.1 * promised.variation));
    EXPECT_LE(coverageRadius(together.particles, probesNear), std::max(0.80, covered));
    EXPECT_NEAR(static_cast<double>(together.particles.size()) /
        static_cast<double>(alone.particles.size()),
      1.0, 0.005);
  }
}

} // namespace
} // namespace hop::testing
