#include "Fast/InsertionDeletion.h"

#include "Surface/Energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace hop
{
namespace
{

/// Energy, in units of that of hexagonal packing, from which on a particle is one too many.
constexpr double crowdedEnergy = 2.5;
/// Mean energy, in units of that of hexagonal packing, of as many particles in packings as a first round of
/// relaxation reaches: a quarter of them do not have six neighbours.
constexpr double typicalEnergy = 1.06;
/// How far energies are corrected where the number wanted is known, in shares of particles.
constexpr double largestCorrection = 0.05;
/// Shares up to this are left alone: what is missing here is too much there.
constexpr double smallestShare = 0.02;
/// Largest D h at which energies tell numbers.
constexpr float largestBend = 1.0f;
/// Energy, in units of that of hexagonal packing, below which a particle may stand beside a hole; where its
/// middle is looked for, first and then nearer and farther, and how far the nearest particles are from that, in
/// units of h; at the first distance it is this far at least.
constexpr double lonelyEnergy = 0.95;
constexpr std::array<float, 3> holeDistances{ 0.92f, 0.85f, 1.0f };
constexpr double holeClearance = 0.82;
constexpr double firstClearance = 0.7;
/// How far from a doubled particle the new one starts, in units of h.
constexpr float childDistance = 0.55f;

/// How many particles are missing for one that there is, by their energy in units of the ideal one,
/// less one. Inverts E(beta (1 + eps)) to second order, as far as that parabola falls: whatever more energy
/// there is says no more.
double missingShare(double excess)
{
  const double linear =
    HexagonalDistance * pairEnergyDerivative(HexagonalDistance) / pairEnergy(HexagonalDistance);
  const double quadratic = 0.5 * HexagonalDistance * HexagonalDistance *
    pairEnergySecondDerivative(HexagonalDistance) / pairEnergy(HexagonalDistance);
  const double bend = quadratic / linear; // < 0
  const double first = std::max(excess / linear, 0.5 / bend);
  const double eps = first - bend * first * first;
  return 2.0 * eps + eps * eps;
}

class InsertionDeletion
{
public:
  InsertionDeletion(const Buffer<Patch>& patches, const SeenLists& lists,
    const std::vector<float>& energies, Relaxed& relaxed)
    : Patches(patches)
    , Lists(lists)
    , Energies(energies)
    , Result(relaxed)
    , Touched(patches.size(), 0)
  {
  }

  /// Removes particles that have far too much energy, and more than all around them.
  void removeCrowded(const ParallelFor& parallelFor)
  {
    std::vector<char> crowded(this->Patches.size());
    forAll(
      parallelFor, this->Patches.size(), [&](std::size_t i) { crowded[i] = this->isCrowded(i); });
    for (std::size_t i = 0; i < this->Patches.size(); ++i)
    {
      if (crowded[i])
      {
        this->remove(static_cast<int>(i));
      }
    }
  }

  /// Doubles and removes particles; energies say where and, unless `missing` does, how many.
  void balance(const std::optional<double>& missing, const ParallelFor& parallelFor)
  {
    std::vector<double> shares(this->Patches.size());
    forAll(
      parallelFor, this->Patches.size(), [&](std::size_t i) { shares[i] = this->shareMissing(i); });
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    const auto counted = static_cast<double>(
      std::count_if(shares.begin(), shares.end(), [](double share) { return share != 0.0; }));
    const double correction = missing ? std::clamp((*missing - total) / std::max(counted, 1.0),
                                          -largestCorrection, largestCorrection)
                                      : 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i)
    {
      const double share = shares[i] != 0.0 ? shares[i] + correction : 0.0;
      sum += std::abs(share) > smallestShare ? share : 0.0;
      if (sum >= 0.5 && share > 0.0)
      {
        this->split(this->extreme(i, std::less<>()));
        sum -= 1.0;
      }
      else if (sum <= -0.5 && share < 0.0)
      {
        this->remove(this->extreme(i, std::greater<>()));
        sum += 1.0;
      }
    }
    std::vector<Split>& splits = this->Result.splits;
    forAll(parallelFor, splits.size(),
      [&](std::size_t n) {
        splits[n].displacement = this->freePlace(splits[n].particle, childDistance).displacement;
      });
  }

  /// Puts particles where one is missing among its neighbours, which have too little energy then.
  void fillHoles(const ParallelFor& parallelFor)
  {
    const auto lonely = static_cast<float>(lonelyEnergy * idealEnergy());
    std::vector<FreePlace> places(this->Patches.size());
    forAll(parallelFor, this->Patches.size(),
      [&](std::size_t i)
      {
        const Patch& patch = this->Patches[i];
        if (this->Energies[i] >= 0.0f && this->Energies[i] < lonely &&
          patch.curvatureMagnitude() * patch.spacing <= largestBend)
        {
          places[i] = this->hole(i);
        }
      });
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      // All around a hole find it: the first of them fills it.
      const auto fills = [&](int j)
      {
        return j < static_cast<int>(i) && this->Touched[j] &&
          glm::distance(places[j].position, places[i].position) <
          holeClearance * this->Patches[i].spacing;
      };
      if (places[i].clearance >= holeClearance &&
        std::none_of(this->Lists.begin(i), this->Lists.end(i), fills))
      {
        this->Result.splits.push_back({ static_cast<int>(i), places[i].displacement });
        this->Touched[i] = 1;
      }
    }
  }

private:
  void remove(int i)
  {
    this->Result.kept[i] = 0;
    this->Touched[i] = 1;
  }

  /// Where the new one stands is found later.
  void split(int i)
  {
    if (!this->Touched[i])
    {
      this->Result.splits.push_back({ i, glm::vec2(0.0f) });
      this->Touched[i] = 1;
    }
  }

  bool isCrowded(std::size_t i) const
  {
    const auto crowded = static_cast<float>(crowdedEnergy * idealEnergy());
    const float own = this->Energies[i];
    return own > crowded &&
      std::none_of(this->Lists.begin(i), this->Lists.end(i),
        [&](int j) {
          return this->Energies[j] > own || (this->Energies[j] == own && j < static_cast<int>(i));
        });
  }

  /// Among particle i and those that it sees, the one with the least or most energy that nothing was done
  /// about yet; i if there is none.
  template <class Compare>
  int extreme(std::size_t i, const Compare& compare) const
  {
    int best = static_cast<int>(i);
    for (const int* j = this->Lists.begin(i); j != this->Lists.end(i); ++j)
    {
      const bool free = this->Energies[*j] >= 0.0f && !this->Touched[*j] &&
        glm::dot(this->Patches[*j].normal, this->Patches[i].normal) > 0.5f;
      if (free && (this->Touched[best] || compare(this->Energies[*j], this->Energies[best])))
      {
        best = *j;
      }
    }
    return best;
  }

  /// How many particles are missing around particle i, for one that there is; zero where that cannot be
  /// told.
  double shareMissing(std::size_t i) const
  {
    const Patch& patch = this->Patches[i];
    const bool bent = patch.curvatureMagnitude() * patch.spacing > largestBend;
    if (this->Energies[i] < 0.0f || this->Touched[i] || bent)
    {
      return 0.0;
    }
    const auto most = static_cast<float>(crowdedEnergy * idealEnergy());
    double sum = std::min(this->Energies[i], most);
    int count = 1;
    for (const int* j = this->Lists.begin(i); j != this->Lists.end(i); ++j)
    {
      if (this->Energies[*j] >= 0.0f && glm::dot(this->Patches[*j].normal, patch.normal) > 0.5f)
      {
        sum += std::min(this->Energies[*j], most);
        ++count;
      }
    }
    return missingShare(sum / (count * typicalEnergy * idealEnergy()) - 1.0);
  }

  struct FreePlace
  {
    /// On the patch of the particle that it is found from.
    glm::vec2 displacement{ 0.0f };
    glm::dvec3 position{ 0.0 };
    /// To the particle nearest to it among those that are seen from there, in units of the spacing.
    double clearance = -1.0;
  };

  /// The place beside particle i that is farthest from all others, if that may be a hole.
  FreePlace hole(std::size_t i) const
  {
    FreePlace best = this->freePlace(i, holeDistances[0]);
    for (std::size_t n = 1; n < holeDistances.size() && best.clearance > firstClearance; ++n)
    {
      const FreePlace place = this->freePlace(i, holeDistances[n]);
      best = place.clearance > best.clearance ? place : best;
    }
    return best;
  }

  /// Of some places all around particle i, at that distance in units of its spacing, the one farthest from
  /// its neighbours.
  FreePlace freePlace(std::size_t i, float distance) const
  {
    constexpr int directions = 12;
    const Patch& patch = this->Patches[i];
    std::vector<glm::dvec3> others;
    others.reserve(this->Lists.count(i));
    for (const int* j = this->Lists.begin(i); j != this->Lists.end(i); ++j)
    {
      const Patch& other = this->Patches[*j];
      others.push_back(other.position + other.step(this->Result.displacements[*j]));
    }
    FreePlace best;
    for (int n = 0; n < directions; ++n)
    {
      const auto angle = static_cast<float>(2.0 * Pi * n / directions);
      FreePlace place;
      place.displacement = this->Result.displacements[i] +
        distance * patch.spacing * glm::vec2(std::cos(angle), std::sin(angle));
      place.position = patch.position + patch.step(place.displacement);
      place.clearance = distance;
      for (const glm::dvec3& other : others)
      {
        place.clearance =
          std::min(place.clearance, glm::distance(place.position, other) / patch.spacing);
        if (place.clearance <= best.clearance)
        {
          break;
        }
      }
      if (place.clearance > best.clearance)
      {
        best = place;
      }
    }
    return best;
  }

  const Buffer<Patch>& Patches;
  const SeenLists& Lists;
  const std::vector<float>& Energies;
  Relaxed& Result;
  /// Particles that were doubled or removed.
  std::vector<char> Touched;
};

} // namespace

void insertAndDelete(const Buffer<Patch>& patches, const SeenLists& lists,
  const std::vector<float>& energies, const Balance& balance, const ParallelFor& parallelFor,
  Relaxed& relaxed)
{
  InsertionDeletion insertionDeletion(patches, lists, energies, relaxed);
  if (balance.extent != Balance::None)
  {
    insertionDeletion.removeCrowded(parallelFor);
  }
  if (balance.extent == Balance::Defects)
  {
    insertionDeletion.fillHoles(parallelFor);
  }
  if (balance.extent == Balance::Everywhere)
  {
    insertionDeletion.balance(balance.missing, parallelFor);
  }
}

} // namespace hop
