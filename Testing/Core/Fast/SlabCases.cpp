#include "SlabCases.h"

#include "Elements/CanonicalOrder.h"
#include "Fast/FastDistribution.h"
#include "Fast/SlabMeshes.h"
#include "Fast/SlabWorkers.h"
#include "Isolation/SurfaceBoxes.h"
#include "RanksInMemory.h"
#include "ScatteredMesh.h"
#include "SurfaceSeeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <ostream>
#include <stdexcept>

namespace hop::testing
{
namespace
{

/// Adds what a worker has made of one isovalue.
void add(const Distribution& distribution, std::size_t worker, Together& together)
{
  together.particles.insert(
    together.particles.end(), distribution.particles.begin(), distribution.particles.end());
  together.counts[worker] += distribution.particles.size();
  together.undecided += distribution.report.boxesUndecided;
}

} // namespace

glm::dmat3 barTurn()
{
  const glm::dvec3 along = sweepDirection();
  const glm::dvec3 aside = glm::normalize(glm::cross(along, glm::dvec3(1, 0, 0)));
  return { aside, glm::cross(along, aside), along };
}

SlabCase SlabCase::coarse() const
{
  SlabCase result = *this;
  result.sizing.spacing = 0.02;
  return result;
}

std::ostream& operator<<(std::ostream& out, const SlabCase& which)
{
  return out << which.name;
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
  return stepped;
}

ElementMesh meshOf(const SlabCase& which)
{
  const glm::dmat3 turn = barTurn();
  MeshRecipe recipe;
  recipe.domain = which.domain;
  recipe.degrees = { 3, 3, 3 };
  recipe.cells = 6;
  const Map bend = wavyMap(which.bend);
  recipe.map = [=](const glm::dvec3& x)
  { return turn * (glm::dvec3(BarWidth, BarWidth, 1.0) * bend(x)); };
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

DistributionParameters parametersOf(const SlabCase& which, unsigned seed)
{
  DistributionParameters parameters;
  parameters.sizing = which.sizing;
  parameters.seed = seed;
  return parameters;
}

std::vector<Slab> slabsOf(
  Exchange& exchange, const ElementMesh& mine, const SlabCase& which, std::size_t count)
{
  std::vector<Slab> slabs;
  for (double particles = 4e4; slabs.size() < count; particles *= 0.95)
  {
    slabs = planSlabs(exchange, mine, which.isovalues, which.sizing, particles, {}).slabs;
    if (particles < 1.0)
    {
      throw std::runtime_error("the surface is too small for so many slabs");
    }
  }
  return slabs;
}

bool isBesideCut(const std::vector<Slab>& slabs, const glm::dvec3& position, double distance)
{
  return std::any_of(slabs.begin(), slabs.end(),
    [&](const Slab& slab) { return std::abs(slab.placeOf(position) - slab.end) < distance; });
}

Together distributeTogether(const SlabCase& which, const ElementMesh& mesh, std::size_t workers,
  int ranks, const ParallelFor& parallelFor)
{
  const std::vector<ElementMesh> parts = scattered(mesh, ranks, ranks);
  Together together;
  together.counts.resize(workers, 0);
  std::vector<std::vector<Distribution>> ofIsovalues(
    which.isovalues.size(), std::vector<Distribution>(workers));
  std::mutex access;
  const auto work = [&](Exchange& exchange)
  {
    const ElementMesh& mine = parts[exchange.rank()];
    const std::vector<Slab> slabs = slabsOf(exchange, mine, which, workers);
    const SlabMeshes meshes =
      gatherSlabs(exchange, mine, CellsOfRank, slabs, which.sizing.spacing, true, parallelFor);
    for (std::size_t n = 0; n < which.isovalues.size(); ++n)
    {
      SlabResult result = distributeInSlabs(exchange, slabs, meshes.meshes,
        { nullptr, which.isovalues[n], SlabTolerance }, parametersOf(which), meshes.isComplete, {},
        parallelFor);
      EXPECT_TRUE(result.isComplete);
      const std::lock_guard lock(access);
      together.slabs = slabs;
      for (std::size_t slab = 0; slab < slabs.size(); ++slab)
      {
        if (rankOfSlab(slab, slabs.size(), ranks) == exchange.rank())
        {
          ofIsovalues[n][slab] = std::move(result.distributions[slab]);
        }
      }
    }
  };
  runRanks(ranks, work, LongestWait);
  for (const std::vector<Distribution>& ofSlabs : ofIsovalues)
  {
    for (std::size_t slab = 0; slab < ofSlabs.size(); ++slab)
    {
      add(ofSlabs[slab], slab, together);
    }
  }
  return together;
}

Together distributeAlone(const SlabCase& which, const ElementMesh& mesh, unsigned seed)
{
  // The order of the elements decides at jumps.
  const GatheredMesh all = gatheredAlone(mesh);
  Together alone;
  alone.counts.resize(1, 0);
  for (const double isovalue : which.isovalues)
  {
    add(distributeFast({ &all.mesh, isovalue, SlabTolerance }, parametersOf(which, seed), {}, {}),
      0, alone);
  }
  return alone;
}

std::vector<glm::dvec3> probesOf(const SlabCase& which, const ElementMesh& mesh)
{
  std::vector<glm::dvec3> probes;
  for (const double isovalue : which.isovalues)
  {
    const auto boxes = findSurfaceBoxes(mesh, isovalue, 0.4 * which.sizing.spacing, {});
    for (const Location& seed : surfaceSeeds(mesh, isovalue, boxes))
    {
      probes.push_back(positionAt(mesh, seed));
    }
  }
  return probes;
}

} // namespace hop::testing
