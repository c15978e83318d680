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

/// Sweeps with the same lists of neighbours, from the paper, after which the energy is compared with that before them;
/// the paper compares one sweep with the next. More: particles leave the lists' range in the meantime.
constexpr int sweepsPerList = 5;

/// Largest numbers of repetitions, where the paper names none. Chosen by experiment. A run that uses up the rounds or
/// the evaluations of its last level is reported as not converged.
struct Largest
{
  /// Sweeps until the energy is steady.
  static constexpr int Sweeps = 60;
  /// Rounds of split and delete at the last level, and at coarser ones, which need not be perfect.
  static constexpr int Rounds = 40;
  static constexpr int CoarseRounds = 8;
  /// Evaluations a particle at one level: six times as many as the paper's largest figure for a whole run. Where the
  /// surface is singular all over, as in flattened cells, most steps end where Newton's method fails, and changes never
  /// end. Larger: runs there take longer; smaller: other runs may end before they have settled.
  static constexpr double Evaluations = 5000.0;
  /// Exchanges of overlapping particles for others where a number is given.
  static constexpr int Exchanges = 4;
};

/// Where the hierarchy of spacings and the seeds start. Chosen by experiment.
struct Start
{
  /// The coarsest spacing is at most this, in units of the extent of the seeds, unless the spacing asked for is larger.
  /// Larger: some level is too coarse for the surface's shape; smaller: fewer levels, and more sweeps at the first.
  static constexpr double SpacingPerExtent = 0.1;
  /// Largest diagonal of the boxes of seeds, in units of the spacing. Larger: fewer seeds, and holes to fill by splits.
  static constexpr double BoxPerSpacing = 3.0;
  /// Random seeds; the paper has several hundred.
  static constexpr int RandomSeeds = 300;
  /// But no box need be smaller than this, in units of the mesh's diagonal: finer levels get their particles by splits.
  static constexpr double BoxPerExtent = 1.0 / 400.0;
};

/// Largest tolerance, in units of the smallest spacing, whatever is asked for. Larger: where a field touches the isovalue
/// in a point, all places of a ball around the point are on the surface to the tolerance, and particles fill it; smaller:
/// nothing gets better.
constexpr double largestTolerance = 1e-3;

/// Largest relative change of the spacing at once, where it follows the energy. Chosen by experiment. Larger: the
/// spacing overshoots while particles have not spread yet; smaller: more sweeps.
constexpr double largestSpacingChange = 0.1;

class ClassicSystem
{
public:
  ClassicSystem(const Isosurface& surface, const DistributionParameters& parameters,
    const Monitor& monitor, const ParallelFor& parallelFor)
    : Work(monitor, parallelFor)
    , Parallel(std::ref(this->Work))
    , Locator(*surface.mesh, surface.isovalue, this->Parallel)
    , Surface(located(surface, parameters.sizing, this->Locator))
    , Parameters(parameters)
    , Particles(this->Surface, parameters.sizing, this->Parallel)
    , RandomNumbers(parameters.seed)
  {
  }

  Distribution run();

private:
  static Isosurface located(
    Isosurface surface, const SizingFunction& sizing, const FaceLocator& locator);
  std::vector<ClassicParticle> makeSeeds();
  bool countIsGiven() const { return this->Parameters.particleCount > 0; }
  double givenCount() const { return static_cast<double>(this->Parameters.particleCount); }
  int chooseLevels(double extent);
  int matchGivenNumber();
  bool tooMany(int levels);
  bool makeLevels(const std::vector<ClassicParticle>& seeds);
  void exchange();
  /// Whether a level that began with so many evaluations has had its share of them.
  bool isSpent(std::int64_t evaluationsBefore) const
  {
    return static_cast<double>(this->Particles.evaluations() - evaluationsBefore) >
      Largest::Evaluations * static_cast<double>(this->Particles.movers.size());
  }
  bool sweepUntilSteady(bool fixedNumber, std::int64_t evaluationsBefore);
  void relaxLevel(int maximumRounds, bool fixedNumber);
  Distribution finish();
  bool toTolerance(const ClassicParticle& mover, SurfaceWalker& walker, Particle& particle) const;

  Interruptible Work;
  ParallelFor Parallel;
  FaceLocator Locator;
  Isosurface Surface;
  DistributionParameters Parameters;
  ClassicParticles Particles;
  Random RandomNumbers;
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

Isosurface ClassicSystem::located(
  Isosurface surface, const SizingFunction& sizing, const FaceLocator& locator)
{
  SizingFunction unbounded = sizing;
  unbounded.smallestSpacing = 0.0;
  const double smallest = std::max(sizing.smallest(), unbounded.smallest());
  surface.tolerance = std::min(surface.tolerance, largestTolerance * smallest);
  surface.locator = &locator;
  return surface;
}

std::vector<ClassicParticle> ClassicSystem::makeSeeds()
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const double boxSize = std::max(
    Start::BoxPerSpacing * this->Particles.sizing.spacing, Start::BoxPerExtent * meshExtent(mesh));
  const std::vector<SurfaceBox> boxes =
    findSurfaceBoxes(mesh, this->Surface.isovalue, boxSize, this->Parallel);
  reportUndecided(this->Surface, boxes, this->Report);
  return this->Particles.seedsOf(boxes);
}

/// Sweeps until the energy is steady. With a fixed number of particles the spacing changes meanwhile, so that their
/// mean energy becomes the ideal one.
/// \param evaluationsBefore the level
/// \return whether the energy is steady
bool ClassicSystem::sweepUntilSteady(bool fixedNumber, std::int64_t evaluationsBefore)
{
  double last = 0.0;
  bool steady = false;
  for (int n = 0; n < Largest::Sweeps && !steady && !this->isSpent(evaluationsBefore); ++n)
  {
    if (n % sweepsPerList == 0)
    {
      if (fixedNumber && n > 0)
      {
        this->Particles.sizing.spacing *= 1.0 -
          std::clamp(
            excessEnergy(this->Particles.movers), -largestSpacingChange, largestSpacingChange);
      }
      this->Particles.renewNeighbors();
    }
    this->Work.ask();
    const double energy = sweepOnce(this->Particles, this->Parallel);
    ++this->Report.iterations;
    if ((n + 1) % sweepsPerList == 0)
    {
      steady = std::abs(energy - last) <= this->Parameters.classic.steadyChange * energy;
      last = energy;
    }
  }
  return steady;
}

/// Relaxes until the system has settled. Unless the number of particles is fixed, particles are split and deleted.
void ClassicSystem::relaxLevel(int maximumRounds, bool fixedNumber)
{
  this->Report.converged = true;
  bool balanced = false;
  const std::int64_t before = this->Particles.evaluations();
  for (int round = 0; round < maximumRounds && !this->isSpent(before); ++round)
  {
    const bool steady = this->sweepUntilSteady(fixedNumber, before);
    if (fixedNumber
        ? steady
        : !splitAndDelete(this->Particles, this->RandomNumbers, this->Parameters.classic))
    {
      if (fixedNumber || balanced)
      {
        return;
      }
      reachIdealEnergy(this->Particles, this->RandomNumbers);
      balanced = true;
    }
  }
  this->Report.converged = false;
}

/// Sets the coarsest spacing.
/// \pre the spacing is positive: doubles end after some 2,000 doublings
/// \return number of times that it is to be halved
int ClassicSystem::chooseLevels(double extent)
{
  int levels = 0;
  while (this->Particles.sizing.spacing * 2.0 <= Start::SpacingPerExtent * extent)
  {
    this->Particles.sizing.spacing *= 2.0;
    ++levels;
  }
  return levels;
}

/// Sets the coarsest spacing so that, halved some times, it goes with the given number of particles: it follows from
/// the number of particles there are, as on a flat surface that is proportional to 1/s^2.
/// \return number of times that the spacing is to be halved
int ClassicSystem::matchGivenNumber()
{
  const double ratio = this->givenCount() / static_cast<double>(this->Particles.movers.size());
  const int levels = std::max(0, static_cast<int>(std::floor(0.5 * std::log2(ratio))));
  this->Particles.sizing.spacing /= std::sqrt(ratio) * std::pow(0.5, levels);
  return levels;
}

bool ClassicSystem::tooMany(int levels)
{
  const double expected = this->countIsGiven()
    ? this->givenCount()
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
      splitByFour(this->Particles, oldSpacing, this->RandomNumbers);
    }
    this->Particles.addUncovered(seeds);
    this->relaxLevel(level < levels ? Largest::CoarseRounds : Largest::Rounds, false);
    // The biased coin may have taken the last particles of a component smaller than the spacing.
    this->Particles.addUncovered(seeds);
    if (level == 0)
    {
      levels = this->countIsGiven() ? this->matchGivenNumber() : levels;
      if (this->tooMany(levels))
      {
        return false;
      }
    }
    this->Work.raiseFraction(std::pow(0.25, levels - level));
  }
  return true;
}

/// Makes particles as many as the given number, and exchanges overlapping ones for others.
void ClassicSystem::exchange()
{
  for (int n = 0; n < Largest::Exchanges && (n == 0 || dropOverlapping(this->Particles)); ++n)
  {
    setCount(this->Particles, static_cast<std::size_t>(this->Parameters.particleCount),
      this->RandomNumbers);
    this->relaxLevel(Largest::Rounds, true);
  }
}

Distribution ClassicSystem::run()
{
  if (this->Surface.mesh->elements.empty())
  {
    return {};
  }
  const std::vector<ClassicParticle> seeds = this->makeSeeds();
  this->Particles.movers = this->Particles.randomSeeds(
    seeds.empty() ? 0 : Start::RandomSeeds, meshExtent(*this->Surface.mesh), this->RandomNumbers);
  if (!seeds.empty() && this->makeLevels(seeds) && this->countIsGiven())
  {
    this->exchange();
  }
  return this->finish();
}

/// Takes a particle at rest to the tolerance asked for, and evaluates the surface there.
/// \return whether it converged
bool ClassicSystem::toTolerance(
  const ClassicParticle& mover, SurfaceWalker& walker, Particle& particle) const
{
  Evaluated at;
  if (!walker.project(mover.at.location, this->Particles.sizing.at(mover.curvature), at, true))
  {
    return false;
  }
  at = walker.evaluateCurved(at.location);
  const Curvature curved = curvature(at.point.gradient, at.hessian);
  particle = particleAt(at.location, at.point, curved, this->Particles.sizing.at(curved.magnitude));
  return true;
}

Distribution ClassicSystem::finish()
{
  Distribution result;
  const std::vector<ClassicParticle>& movers = this->Particles.movers;
  const std::size_t count = this->Report.error.empty() ? movers.size() : 0;
  result.particles.resize(count);
  std::vector<char> converged(count, 0);
  std::vector<std::int64_t> cost(count, 0);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(count),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        SurfaceWalker walker(this->Surface);
        converged[i] = this->toTolerance(movers[i], walker, result.particles[i]);
        cost[i] = walker.evaluations();
      }
    });
  keepMarked(result.particles, converged);
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
