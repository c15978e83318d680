#include "ClassicDistribution.h"

#include "Interruptible.h"
#include "KeepMarked.h"
#include "ParticleBins.h"
#include "Random.h"
#include "SurfaceBoxes.h"
#include "UnresolvedBoxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace hop
{
namespace
{

// The paper's constants.
constexpr double steadyChange = 0.0015;
constexpr double splitBelow = -0.35;
constexpr double deleteAbove = 0.75;
constexpr double settledShare = 0.01;
constexpr int sweepsPerNeighborList = 5;

// Step lengths in units of h^2; the paper divides and multiplies lambda by ten. In hexagonal packing
// the second derivative of the energy along the surface is about 4.5/h^2: a Newton step is 0.22.
constexpr double initialLambda = 0.2;
constexpr double largestLambda = 0.2;
constexpr double smallestLambda = 1e-4;

// Ends that the paper leaves open.
constexpr int maximumSweeps = 60;
constexpr int maximumPopulationRounds = 40;
constexpr int maximumCoarseRounds = 8;
constexpr int mostExchanges = 4;
constexpr double coarsestSpacingPerExtent = 0.1;
constexpr double boxSizePerSpacing = 3.0;
constexpr double smallestBoxPerExtent = 1.0 / 400.0;
constexpr double listSlack = 1.25;
/// While particles move they lie on the surface to this fraction of their spacing, or to the
/// tolerance asked for if that is larger.
constexpr double movingTolerance = 1e-4;
/// Where curvature times spacing exceeds this, neighbours cannot pack hexagonally: particles there
/// come and go for ever, so they do not keep the system from counting as settled.
constexpr double bentTooFar = 1.0;
/// Scaled distance of particles that nothing will part any more, as in a corner of the domain.
constexpr double overlapDistance = 0.1;
/// Energy, in units of that of hexagonal packing, beyond which it says nothing about the number of particles.
constexpr double largestExcess = 2.5;

/// A particle on its way.
struct Mover
{
  Evaluated at;
  WorldVector normal;
  double curvature = 0.0;
  double lambda = initialLambda;
  /// Energy of hexagonal packing around it; less on a rim.
  double ideal = 0.0;
  double energy = 0.0;

  const WorldPoint& position() const { return this->at.point.map.position; }
};

struct EnergyAndForce
{
  double energy = 0.0;
  WorldVector force;
};

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
    , Moving(whileMoving(this->Surface, parameters.law))
    , Walker(this->Moving)
    , Dice(parameters.seed)
    , Law(parameters.law)
  {
  }

  Distribution run();

private:
  std::vector<Mover> makeSeeds(const std::vector<SurfaceBox>& boxes);
  bool place(
    const Location& start, double maximumTravel, SurfaceWalker& walker, Mover& mover) const;
  bool displace(const Mover& from, const WorldVector& step, double farthest, Mover& to);
  bool seed(const SurfaceBox& box, SurfaceWalker& walker, Mover& mover, std::int64_t& cost) const;
  void addUncovered(const std::vector<Mover>& seeds);
  void relaxLevel(int maximumRounds, bool fixedNumber);
  bool bendsTooFar(const Mover& mover);
  void renewNeighbors();
  double sweep();
  void relaxParticle(std::size_t i);
  EnergyAndForce interact(std::size_t i, const Mover& trial) const;
  double scaledDistance(const Mover& a, const Mover& b) const;
  bool changePopulation();
  bool overlapsEarlier(std::size_t i) const;
  bool dropOverlapping();
  bool addBeside(const Mover& parent, double distance, double angle);
  void splitByFour(double oldSpacing);
  double excessEnergy() const;
  void followEnergy();
  void balancePopulation();
  void forceCount(std::size_t count);
  int chooseLevels(double extent);
  bool tooMany(int levels);
  Distribution finish();
  static Isosurface located(Isosurface surface, const FaceLocator& locator);
  static Isosurface whileMoving(const Isosurface& surface, const SpacingLaw& law);
  bool settle(const Mover& mover, SurfaceWalker& walker, Particle& particle) const;

  Interruptible Work;
  ParallelFor Parallel;
  FaceLocator Locator;
  Isosurface Surface;
  DistributionParameters Parameters;
  Isosurface Moving;
  SurfaceWalker Walker;
  Random Dice;
  SpacingLaw Law;
  std::vector<Mover> Movers;
  NeighborLists Neighbors;
  DistributionReport Report;
};

glm::dvec3 orthogonal(const glm::dvec3& n)
{
  const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(n, other));
}

double extentOf(const std::vector<Mover>& movers)
{
  glm::dvec3 lower(movers.front().position().xyz);
  glm::dvec3 upper = lower;
  for (const Mover& m : movers)
  {
    lower = glm::min(lower, m.position().xyz);
    upper = glm::max(upper, m.position().xyz);
  }
  return glm::distance(lower, upper);
}

/// Neighbours that hexagonal packing can have around a particle on that many boundary faces.
double idealEnergyOnBoundary(int boundaryFaces)
{
  constexpr double neighbors[] = { 6.0, 4.0, 2.0, 1.0 };
  return neighbors[std::min(boundaryFaces, 3)] * pairEnergy(HexagonalDistance);
}

/// Puts a place on the surface and notes what the distribution needs to know there.
bool ClassicSystem::place(
  const Location& start, double maximumTravel, SurfaceWalker& walker, Mover& mover) const
{
  if (!walker.project(start, maximumTravel, mover.at))
  {
    return false;
  }
  mover.normal = surfaceNormal(mover.at.point.gradient);
  mover.ideal = idealEnergyOnBoundary(walker.endCount(mover.at.location));
  mover.curvature = 0.0;
  if (this->Law.angularDensity > 0.0)
  {
    const Evaluated curved = walker.evaluateCurved(mover.at.location);
    mover.curvature = curvature(curved.point.gradient, curved.hessian).magnitude;
  }
  return true;
}

/// The same particle after a step in world space; false if it could not be put on the surface within
/// `farthest` of where it was, or turned over to another sheet.
bool ClassicSystem::displace(const Mover& from, const WorldVector& step, double farthest, Mover& to)
{
  const Location reached = this->Walker.move(from.at, step);
  return this->place(reached, farthest, this->Walker, to) &&
    length(to.position() - from.position()) <= farthest && dot(to.normal, from.normal) > 0.0;
}

/// By Newton's method from the middle of the box, or, should that lead away from it, on the line
/// between two of its corners.
bool ClassicSystem::seed(
  const SurfaceBox& box, SurfaceWalker& walker, Mover& mover, std::int64_t& cost) const
{
  const bool found = this->place(box.middle, 2.0 * box.size, walker, mover);
  if ((found && isAtBox(box, mover.at.location)) || !box.straddles)
  {
    return found;
  }
  return this->place(findBetweenEnds(*this->Surface.mesh, this->Surface.isovalue, box, cost),
    box.size, walker, mover);
}

std::vector<Mover> ClassicSystem::makeSeeds(const std::vector<SurfaceBox>& boxes)
{
  std::vector<Mover> seeds(boxes.size());
  std::vector<char> found(boxes.size(), 0);
  std::vector<std::int64_t> cost(boxes.size(), 0);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(boxes.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        SurfaceWalker walker(this->Moving);
        found[b] = this->seed(boxes[b], walker, seeds[b], cost[b]);
        cost[b] += walker.evaluations();
      }
    });
  std::size_t kept = 0;
  for (std::size_t b = 0; b < boxes.size(); ++b)
  {
    this->Report.evaluations += cost[b];
    if (found[b])
    {
      seeds[kept++] = seeds[b];
    }
  }
  reportUnresolved(this->Surface, boxes, this->Report);
  seeds.resize(kept);
  return seeds;
}

/// Adds the seeds around which, within their own spacing, no particle lies on the same sheet.
void ClassicSystem::addUncovered(const std::vector<Mover>& seeds)
{
  GrowingBins bins(this->Law.spacing);
  for (std::size_t i = 0; i < this->Movers.size(); ++i)
  {
    bins.insert(static_cast<int>(i), this->Movers[i].position().xyz);
  }
  for (const Mover& seed : seeds)
  {
    const double h = this->Law.at(seed.curvature);
    bool covered = false;
    bins.visit(seed.position().xyz,
      [&](int j)
      {
        const Mover& other = this->Movers[j];
        covered = covered ||
          (length(seed.position() - other.position()) < h && dot(seed.normal, other.normal) > 0.0);
      });
    if (!covered)
    {
      bins.insert(static_cast<int>(this->Movers.size()), seed.position().xyz);
      this->Movers.push_back(seed);
    }
  }
}

double ClassicSystem::scaledDistance(const Mover& a, const Mover& b) const
{
  return length(a.position() - b.position()) / this->Law.range(0.5 * (a.curvature + b.curvature));
}

void ClassicSystem::renewNeighbors()
{
  std::vector<glm::dvec3> points;
  std::vector<double> radii;
  points.reserve(this->Movers.size());
  radii.reserve(this->Movers.size());
  for (const Mover& m : this->Movers)
  {
    points.push_back(m.position().xyz);
    // The neighbour's curvature may be as low as zero.
    radii.push_back(listSlack * this->Law.range(0.5 * m.curvature));
  }
  this->Neighbors = findNeighbors(points, radii, this->Parallel);
}

/// Energy of particle i, were it where `trial` is, and the force -dE/dx on it (eq. 3).
EnergyAndForce ClassicSystem::interact(std::size_t i, const Mover& trial) const
{
  EnergyAndForce sum;
  for (std::size_t n = this->Neighbors.start[i]; n < this->Neighbors.start[i + 1]; ++n)
  {
    const Mover& other = this->Movers[this->Neighbors.neighbor[n]];
    const double r = this->scaledDistance(trial, other);
    if (r >= 1.0 || dot(trial.normal, other.normal) <= 0.0)
    {
      continue;
    }
    sum.energy += pairEnergy(r);
    WorldVector apart = trial.position() - other.position();
    if (!(length(apart) > 0.0))
    {
      // Any direction will do, if the two do not choose the same.
      apart = { (i < static_cast<std::size_t>(this->Neighbors.neighbor[n]) ? 1.0 : -1.0) *
        orthogonal(trial.normal.xyz) };
    }
    const double distance = length(apart);
    const double range = this->Law.range(0.5 * (trial.curvature + other.curvature));
    sum.force = sum.force + (-pairEnergyDerivative(r) / (range * distance)) * apart;
  }
  return sum;
}

void ClassicSystem::relaxParticle(std::size_t i)
{
  const Mover start = this->Movers[i];
  const EnergyAndForce here = this->interact(i, start);
  this->Movers[i].energy = here.energy;
  const double h = this->Law.at(start.curvature);
  const WorldVector tangential = here.force - dot(here.force, start.normal) * start.normal;
  if (length(tangential) * h < 1e-6)
  {
    return;
  }
  double lambda = start.lambda;
  for (; lambda >= smallestLambda; lambda *= 0.1)
  {
    WorldVector step = (lambda * h * h) * tangential;
    step = std::min(1.0, h / length(step)) * step;
    Mover trial = start;
    if (!this->displace(start, step, h, trial))
    {
      continue;
    }
    const double energy = this->interact(i, trial).energy;
    if (energy < here.energy)
    {
      trial.energy = energy;
      trial.lambda = std::min(largestLambda, 10.0 * lambda);
      this->Movers[i] = trial;
      return;
    }
  }
  this->Movers[i].lambda = smallestLambda;
}

/// One pass over all particles; returns the energy of the whole.
double ClassicSystem::sweep()
{
  double energy = 0.0;
  for (std::size_t i = 0; i < this->Movers.size(); ++i)
  {
    if (i % 1024 == 0)
    {
      this->Work.ask();
    }
    this->relaxParticle(i);
    energy += this->Movers[i].energy;
  }
  ++this->Report.iterations;
  return energy;
}

bool ClassicSystem::addBeside(const Mover& parent, double distance, double angle)
{
  const glm::dvec3 e1 = orthogonal(parent.normal.xyz);
  const glm::dvec3 e2 = glm::cross(parent.normal.xyz, e1);
  const WorldVector step{ distance * (std::cos(angle) * e1 + std::sin(angle) * e2) };
  Mover child = parent;
  if (!this->displace(parent, step, 2.0 * distance, child))
  {
    ++this->Report.particlesRejected;
    return false;
  }
  child.lambda = initialLambda;
  this->Movers.push_back(child);
  return true;
}

/// Whether a particle of lower index lies all but in the same place.
bool ClassicSystem::overlapsEarlier(std::size_t i) const
{
  const auto begin = this->Neighbors.neighbor.begin();
  return std::any_of(begin + this->Neighbors.start[i], begin + this->Neighbors.start[i + 1],
    [&](std::size_t j)
    {
      return j < i && this->scaledDistance(this->Movers[i], this->Movers[j]) < overlapDistance &&
        dot(this->Movers[i].normal, this->Movers[j].normal) > 0.0;
    });
}

/// \return whether there were any
bool ClassicSystem::dropOverlapping()
{
  const std::size_t before = this->Movers.size();
  std::vector<char> apart(before);
  for (std::size_t i = 0; i < before; ++i)
  {
    apart[i] = !this->overlapsEarlier(i);
  }
  keepMarked(this->Movers, apart);
  return this->Movers.size() < before;
}

bool ClassicSystem::bendsTooFar(const Mover& mover)
{
  const Evaluated at = this->Walker.evaluateCurved(mover.at.location);
  const double magnitude = curvature(at.point.gradient, at.hessian).magnitude;
  return magnitude * this->Law.at(magnitude) > bentTooFar;
}

/// Splits lonely particles and deletes crowded ones by a biased coin, and overlapping ones always.
/// \return whether enough wanted to that the system has to settle again
bool ClassicSystem::changePopulation()
{
  enum class Fate : char
  {
    Stay,
    Split,
    Delete
  };
  std::vector<Fate> fates(this->Movers.size(), Fate::Stay);
  std::size_t changes = 0;
  bool overlaps = false;
  for (std::size_t i = 0; i < this->Movers.size(); ++i)
  {
    const Mover& m = this->Movers[i];
    const double bias = this->Dice.uniform() * (m.energy - m.ideal) / m.ideal;
    fates[i] = bias < splitBelow ? Fate::Split : bias > deleteAbove ? Fate::Delete : Fate::Stay;
    changes += fates[i] != Fate::Stay && !this->bendsTooFar(m);
    if (this->overlapsEarlier(i))
    {
      fates[i] = Fate::Delete;
      overlaps = true;
    }
  }
  if (!overlaps && changes < settledShare * static_cast<double>(this->Movers.size()))
  {
    return false;
  }
  const std::vector<Mover> before = std::move(this->Movers);
  this->Movers.clear();
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    if (fates[i] != Fate::Delete)
    {
      this->Movers.push_back(before[i]);
    }
    if (fates[i] == Fate::Split)
    {
      this->addBeside(
        before[i], 0.5 * this->Law.at(before[i].curvature), 2.0 * Pi * this->Dice.uniform());
    }
  }
  return true;
}

/// By how much the mean energy exceeds the ideal one, as a relative change of spacing: in hexagonal
/// packing dE/ds = -6 E'(beta) beta / s.
double ClassicSystem::excessEnergy() const
{
  constexpr double neighbors = 6.0;
  const double slope =
    -neighbors * pairEnergyDerivative(HexagonalDistance) * HexagonalDistance / idealEnergy();
  double energy = 0.0;
  double ideal = 0.0;
  for (const Mover& m : this->Movers)
  {
    // One pair that cannot part would outweigh all others.
    energy += std::min(m.energy, largestExcess * m.ideal);
    ideal += m.ideal;
  }
  return ideal > 0.0 ? (energy / ideal - 1.0) / slope : 0.0;
}

/// With a fixed number of particles the spacing changes until their mean energy is the ideal one.
void ClassicSystem::followEnergy()
{
  this->Law.spacing *= 1.0 - std::clamp(this->excessEnergy(), -0.1, 0.1);
}

/// The biased coin is content while every energy is above 0.65 of the ideal one: evenly so with an
/// eighth too few particles. This takes the population to where the mean energy is ideal.
void ClassicSystem::balancePopulation()
{
  const double change = std::clamp(-2.0 * this->excessEnergy(), -0.2, 0.2);
  this->forceCount(static_cast<std::size_t>(
    std::llround((1.0 + change) * static_cast<double>(this->Movers.size()))));
}

/// Relaxes, and changes the population unless the number of particles is fixed, until settled.
void ClassicSystem::relaxLevel(int maximumRounds, bool fixedNumber)
{
  this->Report.converged = true;
  bool balanced = false;
  for (int round = 0; round < maximumRounds; ++round)
  {
    double last = 0.0;
    bool steady = false;
    for (int n = 0; n < maximumSweeps && !steady; ++n)
    {
      if (n % sweepsPerNeighborList == 0)
      {
        if (fixedNumber && n > 0)
        {
          this->followEnergy();
        }
        this->renewNeighbors();
      }
      const double energy = this->sweep();
      if ((n + 1) % sweepsPerNeighborList == 0)
      {
        steady = std::abs(energy - last) <= steadyChange * energy;
        last = energy;
      }
    }
    if (fixedNumber ? steady : !this->changePopulation())
    {
      if (fixedNumber || balanced)
      {
        return;
      }
      this->balancePopulation();
      balanced = true;
    }
  }
  this->Report.converged = false;
}

/// After the spacing was halved: each particle becomes four on a flat surface, fewer where
/// curvature keeps the spacing.
void ClassicSystem::splitByFour(double oldSpacing)
{
  SpacingLaw oldLaw = this->Law;
  oldLaw.spacing = oldSpacing;
  const std::size_t count = this->Movers.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Mover parent = this->Movers[i];
    const double h = this->Law.at(parent.curvature);
    const double ratio = oldLaw.at(parent.curvature) / h;
    const int children = static_cast<int>(ratio * ratio - 1.0 + this->Dice.uniform());
    const double start = 2.0 * Pi * this->Dice.uniform();
    for (int child = 0; child < children; ++child)
    {
      this->addBeside(parent, 0.9 * h, start + 2.0 * Pi * child / children);
    }
  }
}

/// Splits the loneliest or deletes the most crowded until there are exactly `count`.
void ClassicSystem::forceCount(std::size_t count)
{
  std::vector<std::size_t> byEnergy(this->Movers.size());
  std::iota(byEnergy.begin(), byEnergy.end(), 0);
  const auto excess = [this](std::size_t i)
  { return this->Movers[i].energy / this->Movers[i].ideal; };
  std::stable_sort(byEnergy.begin(), byEnergy.end(),
    [&](std::size_t a, std::size_t b) { return excess(a) < excess(b); });
  if (count < byEnergy.size())
  {
    byEnergy.resize(count);
    std::sort(byEnergy.begin(), byEnergy.end());
    std::vector<Mover> kept;
    for (const std::size_t i : byEnergy)
    {
      kept.push_back(this->Movers[i]);
    }
    this->Movers = std::move(kept);
    return;
  }
  for (std::size_t tries = 0; this->Movers.size() < count && tries < 10 * count; ++tries)
  {
    const Mover parent = this->Movers[byEnergy[tries % byEnergy.size()]];
    this->addBeside(parent, 0.5 * this->Law.at(parent.curvature), 2.0 * Pi * this->Dice.uniform());
  }
}

/// Sets the coarsest spacing; how many times it is to be halved.
int ClassicSystem::chooseLevels(double extent)
{
  int levels = 0;
  while (this->Law.spacing * 2.0 <= coarsestSpacingPerExtent * extent)
  {
    this->Law.spacing *= 2.0;
    ++levels;
  }
  return levels;
}

bool ClassicSystem::tooMany(int levels)
{
  const double expected = this->Parameters.particleCount > 0
    ? static_cast<double>(this->Parameters.particleCount)
    : static_cast<double>(this->Movers.size()) * std::pow(4.0, levels);
  this->Report.error = this->Parameters.refusal(expected);
  return !this->Report.error.empty();
}

Distribution ClassicSystem::run()
{
  const ElementMesh& mesh = *this->Surface.mesh;
  if (mesh.elements.empty())
  {
    return {};
  }
  const double boxSize =
    std::max(boxSizePerSpacing * this->Law.spacing, smallestBoxPerExtent * meshExtent(mesh));
  const std::vector<Mover> seeds =
    this->makeSeeds(findSurfaceBoxes(mesh, this->Surface.isovalue, boxSize, this->Parallel));
  if (seeds.empty())
  {
    return this->finish();
  }

  const bool fixedNumber = this->Parameters.particleCount > 0;
  int levels = this->chooseLevels(extentOf(seeds));
  for (int level = 0; level <= levels; ++level)
  {
    if (level > 0)
    {
      const double oldSpacing = this->Law.spacing;
      this->Law.spacing *= 0.5;
      this->splitByFour(oldSpacing);
    }
    this->addUncovered(seeds);
    this->relaxLevel(level < levels ? maximumCoarseRounds : maximumPopulationRounds, false);
    // The biased coin may have taken the last particles of a component smaller than the spacing.
    this->addUncovered(seeds);
    if (level == 0 && fixedNumber)
    {
      // On a flat surface the number goes with 1/s^2.
      const double wanted = static_cast<double>(this->Parameters.particleCount);
      const double ratio = wanted / static_cast<double>(this->Movers.size());
      levels = std::max(0, static_cast<int>(std::floor(0.5 * std::log2(ratio))));
      this->Law.spacing /= std::sqrt(ratio) * std::pow(0.5, levels);
    }
    if (level == 0 && this->tooMany(levels))
    {
      return this->finish();
    }
    this->Work.raiseFraction(std::pow(0.25, levels - level));
  }
  for (int n = 0; n < (fixedNumber ? mostExchanges : 0); ++n)
  {
    if (n > 0 && !this->dropOverlapping())
    {
      break;
    }
    this->forceCount(static_cast<std::size_t>(this->Parameters.particleCount));
    this->relaxLevel(maximumPopulationRounds, true);
  }
  return this->finish();
}

Isosurface ClassicSystem::located(Isosurface surface, const FaceLocator& locator)
{
  surface.locator = &locator;
  return surface;
}

Isosurface ClassicSystem::whileMoving(const Isosurface& surface, const SpacingLaw& law)
{
  Isosurface moving = surface;
  moving.tolerance =
    std::max(surface.tolerance, movingTolerance * law.spacing / (1.0 + law.angularDensity));
  return moving;
}

/// Takes a particle at rest to the tolerance asked for, and looks at the surface there.
bool ClassicSystem::settle(const Mover& mover, SurfaceWalker& walker, Particle& particle) const
{
  Evaluated at;
  if (!walker.project(mover.at.location, this->Law.at(mover.curvature), at, true))
  {
    return false;
  }
  at = walker.evaluateCurved(at.location);
  const Curvature bend = curvature(at.point.gradient, at.hessian);
  particle = { at.location, at.point.map.position, surfaceNormal(at.point.gradient), bend,
    std::abs(at.point.value) / length(at.point.gradient), this->Law.at(bend.magnitude), {}, 0.0 };
  return true;
}

Distribution ClassicSystem::finish()
{
  Distribution result;
  const std::size_t count = this->Report.error.empty() ? this->Movers.size() : 0;
  Buffer<Particle> particles(count);
  std::vector<char> settled(count, 0);
  std::vector<std::int64_t> cost(count, 0);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(count),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        SurfaceWalker walker(this->Surface);
        settled[i] = this->settle(this->Movers[i], walker, particles[i]);
        cost[i] = walker.evaluations();
      }
    });
  for (std::size_t i = 0; i < count; ++i)
  {
    if (settled[i])
    {
      result.particles.push_back(particles[i]);
    }
  }
  this->Report.particlesRejected += static_cast<std::int64_t>(count - result.particles.size());
  this->Report.evaluations += std::accumulate(
    cost.begin(), cost.end(), this->Walker.evaluations() + this->Locator.evaluations());
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
