// What workers on several ranks cost: a table in Markdown.
//
//   rank_scaling [particles=N] [cells=C] [density=D] [most=R]
//
// Ranks are threads of this process, one worker each, and messages go through memory. A wavy sheet and a sphere in C^3
// cubic hexahedra (default 24, each on a rank by chance) take about N particles (default 1,000,000) at the angular density
// D (default 0), on up to R ranks (default 4): strong scaling has all N for any number of ranks, weak scaling N/R for each. Columns: the
// processor time of the busiest rank, from elements to particles at home, seconds (waiting does not count, so that the
// machine may be busy otherwise); the time of one rank over it; particles, and those of the busiest rank; megabytes
// that all ranks sent.

#include "CountingExchange.h"
#include "Elements/SlabElements.h"
#include "Fast/FastDistribution.h"
#include "Fast/SlabDistribution.h"
#include "Fast/SlabMeshes.h"
#include "Fast/SlabPlan.h"
#include "Fast/SlabWorkers.h"
#include "RanksInMemory.h"
#include "ScatteredMesh.h"
#include "Surface/ParticlesHome.h"
#include "TestMeshes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <string>

namespace
{

using namespace hop;
using hop::testing::CountingExchange;

constexpr double tolerance = 1e-10;

double threadSeconds()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The elements that can hold surface.
ElementMesh surfaceMesh(int cells)
{
  hop::testing::MeshRecipe recipe;
  recipe.degrees = { 3, 3, 3 };
  recipe.cells = cells;
  recipe.map = hop::testing::wavyMap(0.05);
  recipe.field = [](const glm::dvec3& x)
  {
    const double sheet = x.z + 0.35 + 0.1 * std::sin(4.0 * x.x) * std::cos(5.0 * x.y);
    const double ball = glm::distance(x, glm::dvec3(0.0, 0.0, 0.4)) - 0.45;
    return sheet * ball;
  };
  const ElementMesh all = hop::testing::makeMesh(recipe);
  std::vector<int> chosen;
  for (int e = 0; e < static_cast<int>(all.elements.size()); ++e)
  {
    const BernsteinForm form = all.form(e);
    bool hasLow = false, hasHigh = false;
    for (int i = 0; i < static_cast<int>(coefficientCount(form.domain, form.degrees)); ++i)
    {
      hasLow = hasLow || form.coefficients[i].w <= 0.0;
      hasHigh = hasHigh || form.coefficients[i].w >= 0.0;
    }
    if (hasLow && hasHigh)
    {
      chosen.push_back(e);
    }
  }
  return pickElements(all, chosen);
}

struct Measured
{
  double seconds = 0.0;
  std::size_t particles = 0;
  std::size_t most = 0;
  std::size_t sent = 0;
};

/// The slabs for so many workers.
std::vector<Slab> slabsFor(Exchange& exchange, const ElementMesh& mine,
  const DistributionParameters& parameters, std::size_t workers)
{
  std::vector<Slab> slabs;
  for (double worth = 1e8; slabs.size() < workers; worth *= 0.95)
  {
    slabs = planSlabs(exchange, mine, { 0.0 }, parameters.sizing, worth, {}).slabs;
  }
  return slabs;
}

/// From a rank's elements to its particles at home.
std::size_t distributeOn(CountingExchange& exchange, ElementMesh& mine,
  const std::vector<Slab>& slabs, const DistributionParameters& parameters)
{
  const auto cells = static_cast<std::int64_t>(mine.elements.size());
  const std::vector<MeshSize> sizes = gatherFromAll(exchange, sizeOf(mine, cells));
  std::vector<Distribution> ofSlabs(slabs.size());
  SlabMeshes meshes;
  if (slabs.size() > 1)
  {
    meshes = gatherSlabs(exchange, mine, cells, slabs, parameters.sizing.spacing, true, {});
    ofSlabs = distributeInSlabs(
      exchange, slabs, meshes.meshes, { nullptr, 0.0, tolerance }, parameters, true, {}, {})
                .distributions;
  }
  else
  {
    meshes.meshes.push_back(hop::testing::gatheredAt(exchange, 0, mine));
    ofSlabs[0] = distributeFast({ &meshes.meshes[0].mesh, 0.0, tolerance }, parameters, {}, {});
  }
  std::size_t distributed = 0;
  Distribution home;
  for (std::size_t slab = 0; slab < slabs.size(); ++slab)
  {
    distributed += ofSlabs[slab].particles.size();
    HomeParticles part = bringHome(exchange, rankOfSlab(slab, slabs.size(), exchange.size()),
      ofSlabs[slab], true, meshes.meshes[slab], sizes, {}, false);
    add(std::move(part.distribution), home);
    ofSlabs[slab] = {};
  }
  return distributed;
}

Measured measure(const ElementMesh& mesh, const DistributionParameters& parameters, int ranks)
{
  const std::vector<ElementMesh> parts = hop::testing::scattered(mesh, ranks, 1);
  Measured result;
  std::mutex access;
  hop::testing::runRanks(
    ranks,
    [&](Exchange& inMemory)
    {
      ElementMesh mine = parts[inMemory.rank()];
      const std::vector<Slab> slabs =
        slabsFor(inMemory, mine, parameters, static_cast<std::size_t>(ranks));
      CountingExchange exchange(inMemory);
      const double begin = threadSeconds();
      planSlabs(exchange, mine, { 0.0 }, parameters.sizing, 1e8, {});
      const std::size_t count = distributeOn(exchange, mine, slabs, parameters);
      const double seconds = threadSeconds() - begin;
      const std::lock_guard lock(access);
      result.seconds = std::max(result.seconds, seconds);
      result.particles += count;
      result.most = std::max(result.most, count);
      result.sent += exchange.sent();
    },
    std::chrono::hours(1));
  return result;
}

double numberAfter(const char* argument, const char* name, double otherwise)
{
  const std::string text(argument);
  const std::string key = std::string(name) + "=";
  return text.compare(0, key.size(), key) == 0 ? std::atof(text.c_str() + key.size()) : otherwise;
}

} // namespace

int main(int argc, char** argv)
{
  double particles = 1e6, cells = 24, density = 0.0, most = 4;
  for (int n = 1; n < argc; ++n)
  {
    particles = numberAfter(argv[n], "particles", particles);
    cells = numberAfter(argv[n], "cells", cells);
    density = numberAfter(argv[n], "density", density);
    most = numberAfter(argv[n], "most", most);
  }
  const ElementMesh mesh = surfaceMesh(static_cast<int>(cells));
  // The sheet and the sphere have an area of about 7.
  constexpr double area = 7.0;
  const auto parametersFor = [&](double count)
  {
    DistributionParameters parameters;
    parameters.sizing = { std::sqrt(2.0 * area / (std::sqrt(3.0) * count)), density };
    return parameters;
  };
  std::printf("%zu elements at the surface\n\n", mesh.elements.size());
  std::printf(
    "| scaling | ranks | seconds of the busiest | ratio | particles | of the busiest | MB "
    "sent |\n|---|---|---|---|---|---|---|\n");
  for (const bool isStrong : { true, false })
  {
    double alone = 0.0;
    for (int ranks = 1; ranks <= most; ranks *= 2)
    {
      const Measured some =
        measure(mesh, parametersFor(isStrong ? particles : particles * ranks / most), ranks);
      alone = ranks == 1 ? some.seconds : alone;
      std::printf("| %s | %d | %.2f | %.2f | %zu | %zu | %.1f |\n", isStrong ? "strong" : "weak",
        ranks, some.seconds, alone / some.seconds, some.particles, some.most,
        static_cast<double>(some.sent) / 1e6);
      std::fflush(stdout);
    }
  }
  return 0;
}
