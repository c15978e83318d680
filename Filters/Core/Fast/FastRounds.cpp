#include "Fast/FastSystem.h"

#include "Fast/PackingRepair.h"
#include "Fast/PatchDistances.h"

namespace hop
{
namespace
{

/// Number of sweeps in each round of relaxation. More of them make a more even spread and take longer; each round
/// costs one evaluation a particle. Chosen by experiment; TestFastQuality.cpp says how even Standard has to be.
std::vector<int> sweepsOfRounds(Quality quality, bool isWarm)
{
  switch (quality)
  {
    case Quality::Draft:
      return { 8 };
    case Quality::High:
      return { 5, 8, 8, 10 };
    case Quality::Standard:
      break;
  }
  // Particles of the previous run crowd or thin out where the surface has moved: the same quality takes more sweeps.
  return isWarm ? std::vector<int>{ 12, 22 } : std::vector<int>{ 7, 13 };
}

/// Where a distribution is changed. Chosen by experiment. Larger: more particles are moved, and what was well there is
/// spoilt; smaller: no room for those that come in.
constexpr RepairRegion changedRegion{ 8.0 };

} // namespace

/// What a round does about the number of particles: the last round repairs single defects, the rounds before it
/// insert and delete everywhere.
Balance FastSystem::balanceOf(bool isLast) const
{
  Balance balance;
  balance.extent = isLast ? Balance::Defects : Balance::Everywhere;
  const auto size = static_cast<double>(this->Moving->size());
  if (this->countIsGiven())
  {
    balance.missing = static_cast<double>(this->sizeForGivenNumber()) - size;
  }
  // Where spacings vary, energies tell of narrow places that the proxy misses. They would leave the particles of a
  // previous run as many as they are, though.
  else if (this->Sizing.angularDensity == 0.0 || this->IsWarm)
  {
    balance.missing = this->Part.isEverything()
      ? this->targetCount() - size
      : this->TargetInSlab - static_cast<double>(this->Moving->count());
  }
  return balance;
}

void FastSystem::relaxOnce(int sweeps, bool isLast, const Section& section)
{
  this->Moving->relax({ sweeps }, this->balanceOf(isLast),
    [&](double share) { this->Work.raiseFraction(section.at(share)); });
  this->dropNearBoundaryCurves(MinimumSeparation);
}

void FastSystem::relaxInRounds()
{
  if (!this->Changed.empty())
  {
    relaxAround(this->Changed, Balance::Everywhere, *this->Moving, this->Parallel, changedRegion);
    this->dropNearBoundaryCurves(MinimumSeparation);
    return;
  }
  const std::vector<int> rounds = sweepsOfRounds(this->Parameters.quality, this->IsWarm);
  const Section all{ ProgressAt::Seeded, ProgressAt::Relaxed };
  this->reach(all.begin);
  for (std::size_t n = 0; n < rounds.size(); ++n)
  {
    const auto count = static_cast<double>(rounds.size());
    const Section round{ all.at(n / count), all.at((n + 1) / count) };
    this->relaxOnce(rounds[n], n + 1 == rounds.size(), round);
    this->reach(round.end);
  }
}

} // namespace hop
