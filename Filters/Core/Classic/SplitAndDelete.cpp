#include "Classic/SplitAndDelete.h"

#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hop
{
namespace
{

// The paper's constants.
constexpr double splitBelow = -0.35;
constexpr double deleteAbove = 0.75;
constexpr double settledShare = 0.01;

/// Where curvature times spacing exceeds this, neighbours cannot pack hexagonally: particles there
/// come and go for ever, so they do not keep the system from counting as settled.
constexpr double bentTooFar = 1.0;
/// Scaled distance of particles that nothing will part any more, as in a corner of the domain.
constexpr double overlapDistance = 0.1;
/// Energy, in units of that of hexagonal packing, beyond which it says nothing about the number of particles.
constexpr double largestExcess = 2.5;

enum class Fate : char
{
  Stay,
  Split,
  Delete
};

bool bendsTooFar(ClassicParticles& particles, const ClassicParticle& mover)
{
  const double bend = particles.bendAt(mover);
  return bend * particles.sizing.at(bend) > bentTooFar;
}

/// Whether a particle of lower index lies all but in the same place.
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

double anyDirection(Random& dice)
{
  return 2.0 * Pi * dice.uniform();
}

void follow(const std::vector<Fate>& fates, ClassicParticles& particles, Random& dice)
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
      const double distance = 0.5 * particles.sizing.at(before[i].curvature);
      particles.addBeside(before[i], distance, anyDirection(dice));
    }
  }
}

} // namespace

bool splitAndDelete(ClassicParticles& particles, Random& dice)
{
  const std::vector<ClassicParticle>& movers = particles.movers;
  std::vector<Fate> fates(movers.size(), Fate::Stay);
  std::size_t changes = 0;
  bool overlaps = false;
  for (std::size_t i = 0; i < movers.size(); ++i)
  {
    const ClassicParticle& m = movers[i];
    const double bias = dice.uniform() * (m.energy - m.ideal) / m.ideal;
    fates[i] = bias < splitBelow ? Fate::Split : bias > deleteAbove ? Fate::Delete : Fate::Stay;
    changes += fates[i] != Fate::Stay && !bendsTooFar(particles, m);
    if (overlapsEarlier(particles, i))
    {
      fates[i] = Fate::Delete;
      overlaps = true;
    }
  }
  if (!overlaps && changes < settledShare * static_cast<double>(movers.size()))
  {
    return false;
  }
  follow(fates, particles, dice);
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
    // One pair that cannot part would outweigh all others.
    energy += std::min(m.energy, largestExcess * m.ideal);
    ideal += m.ideal;
  }
  return ideal > 0.0 ? (energy / ideal - 1.0) / slope : 0.0;
}

void insertAndDelete(ClassicParticles& particles, Random& dice)
{
  const double change = std::clamp(-2.0 * excessEnergy(particles.movers), -0.2, 0.2);
  const double count = (1.0 + change) * static_cast<double>(particles.movers.size());
  forceCount(particles, static_cast<std::size_t>(std::llround(count)), dice);
}

void forceCount(ClassicParticles& particles, std::size_t count, Random& dice)
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
  for (std::size_t tries = 0; movers.size() < count && tries < 10 * count; ++tries)
  {
    const ClassicParticle parent = movers[byEnergy[tries % byEnergy.size()]];
    particles.addBeside(parent, 0.5 * particles.sizing.at(parent.curvature), anyDirection(dice));
  }
}

void splitByFour(ClassicParticles& particles, double oldSpacing, Random& dice)
{
  SizingFunction oldSizing = particles.sizing;
  oldSizing.spacing = oldSpacing;
  const std::size_t count = particles.movers.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const ClassicParticle parent = particles.movers[i];
    const double h = particles.sizing.at(parent.curvature);
    const double ratio = oldSizing.at(parent.curvature) / h;
    const int children = static_cast<int>(ratio * ratio - 1.0 + dice.uniform());
    const double start = anyDirection(dice);
    for (int child = 0; child < children; ++child)
    {
      particles.addBeside(parent, 0.9 * h, start + 2.0 * Pi * child / children);
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
