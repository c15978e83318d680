#include "Classic/ClassicRelaxation.h"

namespace hop
{
namespace
{

/// Particles that are moved before the caller may end the work. More: it waits longer; fewer: more time goes into
/// asking.
constexpr std::size_t particlesAtOnce = 1024;

/// Force along the surface, in units of 1/h, below which a particle is at rest. Chosen by experiment. Larger: particles
/// stop early; smaller: steps shorter than the projection's tolerance are tried.
constexpr double leastForce = 1e-6;

/// Length of a step, in units of h, below which only a first try is made. Chosen by experiment. Larger: particles that
/// hardly feel a force move less; smaller: more tries at particles that are at rest.
constexpr double shortestStep = 1e-4;

/// Factors of the step length lambda after a first try that lowers the energy, and after a try that does not. From the
/// paper.
struct LambdaFactor
{
  static constexpr double Grow = 10.0;
  static constexpr double Shrink = 0.1;
};

struct EnergyAndForce
{
  double energy = 0.0;
  WorldVector force;
};

/// Energy of particle i if it were in the place of `trial`, and the force -dE/dx on it (eq. 3).
EnergyAndForce interact(
  const ClassicParticles& particles, std::size_t i, const ClassicParticle& trial)
{
  const NeighborLists& lists = particles.neighbors;
  EnergyAndForce sum;
  for (std::size_t n = lists.start[i]; n < lists.start[i + 1]; ++n)
  {
    const ClassicParticle& other = particles.movers[lists.neighbor[n]];
    const double r = particles.scaledDistance(trial, other);
    if (r >= 1.0 || dot(trial.normal, other.normal) <= 0.0)
    {
      continue;
    }
    sum.energy += pairEnergy(r);
    WorldVector apart = trial.position() - other.position();
    if (!(length(apart) > 0.0))
    {
      // In one place any direction will do, if the two particles take opposite ones.
      const double way = i < static_cast<std::size_t>(lists.neighbor[n]) ? 1.0 : -1.0;
      apart = { way * orthogonalTo(trial.normal.xyz) };
    }
    const double distance = length(apart);
    const double range = particles.sizing.range(0.5 * (trial.curvature + other.curvature));
    sum.force = sum.force + (-pairEnergyDerivative(r) / (range * distance)) * apart;
  }
  return sum;
}

/// Moves particle i by the first of ever shorter steps that lowers its energy. Steps longer than h are not tried. So
/// lambda, which has no bound, stays below ten steps of h under the least force.
void relax(ClassicParticles& particles, std::size_t i)
{
  const ClassicParticle start = particles.movers[i];
  const EnergyAndForce here = interact(particles, i, start);
  particles.movers[i].energy = here.energy;
  const double h = particles.sizing.at(start.curvature);
  const WorldVector tangential = here.force - dot(here.force, start.normal) * start.normal;
  if (length(tangential) * h < leastForce)
  {
    return;
  }
  for (double lambda = start.lambda;; lambda *= LambdaFactor::Shrink)
  {
    const bool isFirstTry = lambda == start.lambda;
    const WorldVector step = (lambda * h * h) * tangential;
    if (!isFirstTry && length(step) < shortestStep * h)
    {
      break;
    }
    ClassicParticle trial = start;
    if (length(step) > h || !particles.displace(start, step, h, trial))
    {
      continue;
    }
    const double energy = interact(particles, i, trial).energy;
    if (energy < here.energy)
    {
      trial.energy = energy;
      trial.lambda = isFirstTry ? LambdaFactor::Grow * lambda : lambda;
      particles.movers[i] = trial;
      return;
    }
  }
  particles.movers[i].lambda = ClassicParticle::SmallestLambda;
}

} // namespace

double sweepOnce(ClassicParticles& particles, const ParallelFor& parallelFor)
{
  double energy = 0.0;
  for (std::size_t i = 0; i < particles.movers.size(); ++i)
  {
    relax(particles, i);
    energy += particles.movers[i].energy;
    if ((i + 1) % particlesAtOnce == 0)
    {
      askCaller(parallelFor);
    }
  }
  return energy;
}

} // namespace hop
