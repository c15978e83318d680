#include "Classic/ClassicDistribution.h"

#include "Classic/ClassicRelaxation.h"
#include "Classic/SplitAndDelete.h"
#include "Isolation/SurfaceBoxes.h"
#include "Isolation/UndecidedBoxes.h"
#include "Support/Interruptible.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace hop
{
namespace
{

// The paper's constants.
constexpr double steadyChange = 0.0015;
constexpr int sweepsPerNeighborList = 5;

// Ends that the paper leaves open.
constexpr int maximumSweeps = 60;
constexpr int maximumSplitAndDeleteRounds = 40;
constexpr int maximumCoarseRounds = 8;
constexpr int mostExchanges = 4;
constexpr double coarsestSpacingPerExtent = 0.1;
constexpr double boxSizePerSpacing = 3.0;
constexpr double smallestBoxPerExtent = 1.0 / 400.0;

class ClassicSystem
{
public:
  ClassicSystem(const Isosurface& surface, const DistributionParameters& parameters,
    const Monitor& monitor, const ParallelFor& parallelFor)
    : Work(monitor, parallelFor)
    , Parallel(std::ref(this->Work))
    , Locator(*surface.mesh, surface.isovalue, this->Parallel)
    , Surface(located(surface, this->Locator))
    , Parameters(parameters)
    , Particles(this->Surface, parameters.sizing, this->Parallel)
    , Dice(parameters.seed)
  {
  }

  Distribution run();

private:
  static Isosurface located(Isosurface surface, const FaceLocator& locator);
  std::vector<ClassicParticle> makeSeeds();
  bool countIsGiven() const { return this->Parameters.particleCount > 0; }
  double wantedCount() const { return static_cast<double>(this->Parameters.particleCount); }
  int chooseLevels(double extent);
  int followGivenNumber();
  bool tooMany(int levels);
  bool makeLevels(const std::vector<ClassicParticle>& seeds);
  void exchange();
  bool settleOnce(bool fixedNumber);
  void relaxLevel(int maximumRounds, bool fixedNumber);
  Distribution finish();
  bool settle(const ClassicParticle& mover, SurfaceWalker& walker, Particle& particle) const;

  Interruptible Work;
  ParallelFor Parallel;
  FaceLocator Locator;
  Isosurface Surface;
  DistributionParameters Parameters;
  ClassicParticles Particles;
  Random Dice;
  DistributionReport Report;
};

double extentOf(const std::vector<ClassicParticle>& movers)
{
  glm::dvec3 lower(movers.front().position().xyz);
  glm::dvec3 upper = lower;
  for (const ClassicParticle& m : movers)
  {
    lower = glm::min(lower, m.position().xyz);
    upper = glm::max(upper, m.position().xyz);
  }
  return glm::distance(lower, upper);
}

Isosurface ClassicSystem::located(Isosurface surface, const FaceLocator& locator)
{
  surface.locator = &locator;
  return surface;
}

std::vector<ClassicParticle> ClassicSystem::makeSeeds()
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const double boxSize = std::max(
    boxSizePerSpacing * this->Particles.sizing.spacing, smallestBoxPerExtent * meshExtent(mesh));
  const std::vector<SurfaceBox> boxes =
    findSurfaceBoxes(mesh, this->Surface.isovalue, boxSize, this->Parallel);
  reportUndecided(this->Surface, boxes, this->Report);
  return this->Particles.seedsOf(boxes);
}

/// Sweeps until the energy is steady. With a fixed number of particles the spacing changes meanwhile until their
/// mean energy is the ideal one.
/// \return whether it is
bool ClassicSystem::settleOnce(bool fixedNumber)
{
  double last = 0.0;
  bool steady = false;
  for (int n = 0; n < maximumSweeps && !steady; ++n)
  {
    if (n % sweepsPerNeighborList == 0)
    {
      if (fixedNumber && n > 0)
      {
        this->Particles.sizing.spacing *=
          1.0 - std::clamp(excessEnergy(this->Particles.movers), -0.1, 0.1);
      }
      this->Particles.renewNeighbors();
    }
    this->Work.ask();
    const double energy = sweepOnce(this->Particles, this->Parallel);
    ++this->Report.iterations;
    if ((n + 1) % sweepsPerNeighborList == 0)
    {
      steady = std::abs(energy - last) <= steadyChange * energy;
      last = energy;
    }
  }
  return steady;
}

/// Relaxes, and changes the population unless the number of particles is fixed, until settled.
void ClassicSystem::relaxLevel(int maximumRounds, bool fixedNumber)
{
  this->Report.converged = true;
  bool balanced = false;
  for (int round = 0; round < maximumRounds; ++round)
  {
    const bool steady = this->settleOnce(fixedNumber);
    if (fixedNumber ? steady : !splitAndDelete(this->Particles, this->Dice))
    {
      if (fixedNumber || balanced)
      {
        return;
      }
      insertAndDelete(this->Particles, this->Dice);
      balanced = true;
    }
  }
  this->Report.converged = false;
}

/// Sets the coarsest spacing; how many times it is to be halved.
int ClassicSystem::chooseLevels(double extent)
{
  int levels = 0;
  while (this->Particles.sizing.spacing * 2.0 <= coarsestSpacingPerExtent * extent)
  {
    this->Particles.sizing.spacing *= 2.0;
    ++levels;
  }
  return levels;
}

/// Where a number of particles is given, the spacing that goes with it, judged by those of the coarsest: on a flat
/// surface the number goes with 1/s^2.
/// \return how many times the coarsest is to be halved
int ClassicSystem::followGivenNumber()
{
  const double ratio = this->wantedCount() / static_cast<double>(this->Particles.movers.size());
  const int levels = std::max(0, static_cast<int>(std::floor(0.5 * std::log2(ratio))));
  this->Particles.sizing.spacing /= std::sqrt(ratio) * std::pow(0.5, levels);
  return levels;
}

bool ClassicSystem::tooMany(int levels)
{
  const double expected = this->countIsGiven()
    ? this->wantedCount()
    : static_cast<double>(this->Particles.movers.size()) * std::pow(4.0, levels);
  this->Report.error = this->Parameters.refusal(expected);
  return !this->Report.error.empty();
}

/// Relaxes at the coarsest spacing, then at half of it, and so on.
/// \return false if there would be too many particles
bool ClassicSystem::makeLevels(const std::vector<ClassicParticle>& seeds)
{
  int levels = this->chooseLevels(extentOf(seeds));
  for (int level = 0; level <= levels; ++level)
  {
    if (level > 0)
    {
      const double oldSpacing = this->Particles.sizing.spacing;
      this->Particles.sizing.spacing *= 0.5;
      splitByFour(this->Particles, oldSpacing, this->Dice);
    }
    this->Particles.addUncovered(seeds);
    this->relaxLevel(level < levels ? maximumCoarseRounds : maximumSplitAndDeleteRounds, false);
    // The biased coin may have taken the last particles of a component smaller than the spacing.
    this->Particles.addUncovered(seeds);
    if (level == 0)
    {
      levels = this->countIsGiven() ? this->followGivenNumber() : levels;
      if (this->tooMany(levels))
      {
        return false;
      }
    }
    this->Work.raiseFraction(std::pow(0.25, levels - level));
  }
  return true;
}

/// Makes particles as many as are given, and puts others in the place of those that overlap.
void ClassicSystem::exchange()
{
  for (int n = 0; n < mostExchanges && (n == 0 || dropOverlapping(this->Particles)); ++n)
  {
    forceCount(
      this->Particles, static_cast<std::size_t>(this->Parameters.particleCount), this->Dice);
    this->relaxLevel(maximumSplitAndDeleteRounds, true);
  }
}

Distribution ClassicSystem::run()
{
  if (this->Surface.mesh->elements.empty())
  {
    return {};
  }
  const std::vector<ClassicParticle> seeds = this->makeSeeds();
  if (!seeds.empty() && this->makeLevels(seeds) && this->countIsGiven())
  {
    this->exchange();
  }
  return this->finish();
}

/// Takes a particle at rest to the tolerance asked for, and looks at the surface there.
bool ClassicSystem::settle(
  const ClassicParticle& mover, SurfaceWalker& walker, Particle& particle) const
{
  Evaluated at;
  if (!walker.project(mover.at.location, this->Particles.sizing.at(mover.curvature), at, true))
  {
    return false;
  }
  at = walker.evaluateCurved(at.location);
  const Curvature bend = curvature(at.point.gradient, at.hessian);
  particle = particleAt(at.location, at.point, bend, this->Particles.sizing.at(bend.magnitude));
  return true;
}

Distribution ClassicSystem::finish()
{
  Distribution result;
  const std::vector<ClassicParticle>& movers = this->Particles.movers;
  const std::size_t count = this->Report.error.empty() ? movers.size() : 0;
  result.particles.resize(count);
  std::vector<char> settled(count, 0);
  std::vector<std::int64_t> cost(count, 0);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(count),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        SurfaceWalker walker(this->Surface);
        settled[i] = this->settle(movers[i], walker, result.particles[i]);
        cost[i] = walker.evaluations();
      }
    });
  keepMarked(result.particles, settled);
  this->Report.particlesRejected =
    this->Particles.rejected() + static_cast<std::int64_t>(count - result.particles.size());
  this->Report.evaluations += std::accumulate(
    cost.begin(), cost.end(), this->Particles.evaluations() + this->Locator.evaluations());
  this->Report.particlesUndersampled = std::count_if(result.particles.begin(),
    result.particles.end(), [](const Particle& p) { return p.isUndersampled(); });
  result.report = this->Report;
  return result;
}

} // namespace

Distribution distributeClassic(const Isosurface& surface, const DistributionParameters& parameters,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  return unlessInterrupted(
    [&]() { return ClassicSystem(surface, parameters, monitor, parallelFor).run(); });
}

} // namespace hop
