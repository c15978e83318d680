#include "Classic/SplitAndDelete.h"

#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hop
{
namespace
{

/// Scaled distance r at which particles overlap: nothing will part them any more, as in a corner of the domain. Chosen
/// by experiment. Larger: pairs are deleted that would part; smaller: doubled particles remain.
constexpr double overlapDistance = 0.1;

/// Energy, in units of the ideal one, beyond which it says nothing about the number of particles. Chosen by experiment.
/// Larger: one pair that cannot part lowers the number everywhere.
constexpr double largestEnergy = 2.5;

/// Largest relative change of the number of particles at once. Chosen by experiment. Larger: first order no longer
/// holds; smaller: more rounds.
constexpr double largestChange = 0.2;

/// Distance of a new particle from the one that is split, in units of the spacing: after a split, where the sweeps part
/// the two, and where four take the place of one, which have about a spacing each. Chosen by experiment.
struct ChildDistance
{
  static constexpr double OfSplit = 0.5;
  static constexpr double OfFour = 0.9;
};

/// Attempts to add a particle for each one asked for: some cannot be put on the surface. Chosen by experiment; the
/// number stays too small where they do not suffice.
constexpr std::size_t attemptsPerParticle = 10;

enum class Fate : char
{
  Stay,
  Split,
  Delete
};

/// Whether particle i overlaps one of lower index.
bool overlapsEarlier(const ClassicParticles& particles, std::size_t i)
{
  const NeighborLists& lists = particles.neighbors;
  const ClassicParticle& mover = particles.movers[i];
  return std::any_of(lists.neighbor.begin() + lists.start[i],
    lists.neighbor.begin() + lists.start[i + 1],
    [&](std::size_t j)
    {
      const ClassicParticle& other = particles.movers[j];
      return j < i && particles.scaledDistance(mover, other) < overlapDistance &&
        dot(mover.normal, other.normal) > 0.0;
    });
}

double anyDirection(Random& random)
{
  return 2.0 * Pi * random.uniform();
}

/// Deletes and splits particles.
/// \param fates one for each particle
void apply(const std::vector<Fate>& fates, ClassicParticles& particles, Random& random)
{
  const std::vector<ClassicParticle> before = std::move(particles.movers);
  particles.movers.clear();
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    if (fates[i] != Fate::Delete)
    {
      particles.movers.push_back(before[i]);
    }
    if (fates[i] == Fate::Split)
    {
      const double distance = ChildDistance::OfSplit * particles.sizing.at(before[i].curvature);
      particles.addBeside(before[i], distance, anyDirection(random));
    }
  }
}

} // namespace

bool splitAndDelete(
  ClassicParticles& particles, Random& random, const ClassicParameters& parameters)
{
  const std::vector<ClassicParticle>& movers = particles.movers;
  std::vector<Fate> fates(movers.size(), Fate::Stay);
  std::size_t changes = 0;
  bool overlaps = false;
  for (std::size_t i = 0; i < movers.size(); ++i)
  {
    const ClassicParticle& m = movers[i];
    const double bias = random.uniform() * (m.energy - m.ideal) / m.ideal;
    fates[i] = bias < parameters.splitBelow ? Fate::Split
      : bias > parameters.deleteAbove       ? Fate::Delete
                                            : Fate::Stay;
    changes += fates[i] != Fate::Stay;
    if (overlapsEarlier(particles, i))
    {
      fates[i] = Fate::Delete;
      overlaps = true;
    }
  }
  if (!overlaps && changes < parameters.settledShare * static_cast<double>(movers.size()))
  {
    return false;
  }
  apply(fates, particles, random);
  return true;
}

double excessEnergy(const std::vector<ClassicParticle>& movers)
{
  constexpr double neighbors = 6.0;
  const double slope =
    -neighbors * pairEnergyDerivative(HexagonalDistance) * HexagonalDistance / idealEnergy();
  double energy = 0.0;
  double ideal = 0.0;
  for (const ClassicParticle& m : movers)
  {
    // A pair that cannot part would outweigh all other particles.
    energy += std::min(m.energy, largestEnergy * m.ideal);
    ideal += m.ideal;
  }
  return ideal > 0.0 ? (energy / ideal - 1.0) / slope : 0.0;
}

void reachIdealEnergy(ClassicParticles& particles, Random& random)
{
  // The number is proportional to 1/s^2: twice the relative change of the spacing.
  const double change =
    std::clamp(-2.0 * excessEnergy(particles.movers), -largestChange, largestChange);
  const double count = (1.0 + change) * static_cast<double>(particles.movers.size());
  setCount(particles, static_cast<std::size_t>(std::llround(count)), random);
}

void setCount(ClassicParticles& particles, std::size_t count, Random& random)
{
  std::vector<ClassicParticle>& movers = particles.movers;
  std::vector<std::size_t> byEnergy(movers.size());
  std::iota(byEnergy.begin(), byEnergy.end(), 0);
  const auto excess = [&](std::size_t i) { return movers[i].energy / movers[i].ideal; };
  std::stable_sort(byEnergy.begin(), byEnergy.end(),
    [&](std::size_t a, std::size_t b) { return excess(a) < excess(b); });
  if (count < byEnergy.size())
  {
    std::vector<char> kept(movers.size(), 0);
    std::for_each(byEnergy.begin(), byEnergy.begin() + static_cast<std::ptrdiff_t>(count),
      [&](std::size_t i) { kept[i] = 1; });
    keepMarked(movers, kept);
    return;
  }
  for (std::size_t tries = 0; movers.size() < count && tries < attemptsPerParticle * count; ++tries)
  {
    const ClassicParticle parent = movers[byEnergy[tries % byEnergy.size()]];
    particles.addBeside(
      parent, ChildDistance::OfSplit * particles.sizing.at(parent.curvature), anyDirection(random));
  }
}

void splitByFour(ClassicParticles& particles, double oldSpacing, Random& random)
{
  SizingFunction oldSizing = particles.sizing;
  oldSizing.spacing = oldSpacing;
  const std::size_t count = particles.movers.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const ClassicParticle parent = particles.movers[i];
    const double h = particles.sizing.at(parent.curvature);
    const double ratio = oldSizing.at(parent.curvature) / h;
    const int children = static_cast<int>(ratio * ratio - 1.0 + random.uniform());
    const double start = anyDirection(random);
    for (int child = 0; child < children; ++child)
    {
      particles.addBeside(parent, ChildDistance::OfFour * h, start + 2.0 * Pi * child / children);
    }
  }
}

bool dropOverlapping(ClassicParticles& particles)
{
  const std::size_t before = particles.movers.size();
  std::vector<char> apart(before);
  for (std::size_t i = 0; i < before; ++i)
  {
    apart[i] = !overlapsEarlier(particles, i);
  }
  keepMarked(particles.movers, apart);
  return particles.movers.size() < before;
}

} // namespace hop
