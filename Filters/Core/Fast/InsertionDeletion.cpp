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

/// What energies, in units of the ideal one of hexagonal packing, tell about the number of particles. All numbers were
/// chosen by experiment; they hold for the packings that the sweeps of PatchRelaxation.h reach.
struct EnergyOfNumber
{
  /// A particle with more energy than this is one too many. Hexagonal packing has as much where all distances are 0.80
  /// of the spacing. Larger: crowded pairs survive; smaller: particles are deleted that the sweeps would still part.
  static constexpr double Crowded = 2.5;
  /// Mean energy of a relaxed packing with the right number of particles: a quarter of the particles do not have six
  /// neighbours after a first round. Larger: more particles come out, smaller: fewer.
  static constexpr double Typical = 1.06;
  /// Largest correction of the share missing around a particle where the number missing in all is known. Larger: wrong
  /// numbers are put right even where energies contradict; smaller: energies have the last word.
  static constexpr double Correction = 0.05;
  /// Shares up to this are ignored, as what is missing in one place is too much in the next. Larger: numbers stay
  /// wrong; smaller: particles are inserted and deleted where nothing is wrong.
  static constexpr double SmallestShare = 0.02;
  /// Largest curvature magnitude times spacing at which energies tell numbers: beyond it neighbours do not lie near one
  /// plane, in which packings are compared.
  static constexpr float LargestCurvatureTimesSpacing = 1.0f;
};

/// A hole between particles that is as wide as one. All numbers were chosen by experiment; distances are in units of
/// the spacing.
struct Hole
{
  /// A particle with less energy than this, in units of the ideal one, may stand beside a hole: one of six
  /// neighbours less is 0.83. Larger: more particles are searched around; smaller: holes stay open.
  static constexpr double Energy = 0.95;
  /// Distances of the hole's middle from a particle beside it, in the order in which they are tried.
  static constexpr std::array<float, 3> Distances{ 0.92f, 0.85f, 1.0f };
  /// Least clearance of a new particle in the hole. Larger: holes stay open; smaller: new particles crowd.
  static constexpr double Clearance = 0.82;
  /// Least clearance at the first distance for the others to be tried. Larger: less time; fewer holes are found.
  static constexpr double FirstClearance = 0.7;
};

/// Distance of a new particle from the one beside which it is inserted, in units of the spacing, before sweeps part
/// them. Chosen by experiment. Larger: it starts near other neighbours; smaller: the two repel each other too strongly.
constexpr float insertionDistance = 0.55f;

/// Directions in which a free place is looked for, one every 30 degrees. Chosen by experiment. More of them find the
/// middles of holes more exactly, and take longer.
constexpr int directions = 12;

/// Least cosine between the normals of neighbours that lie on the same sheet: up to 60 degrees, as where pairs do not
/// fade in the sweeps. Larger: fewer neighbours count where the surface bends; smaller: neighbours on other sheets do.
constexpr float sameSheetCosine = 0.5f;

/// Share of a particle that is missing for each one that there is, (1 + eps)^2 - 1. Inverts E(beta (1 + eps)) to second
/// order up to the vertex of the parabola: more energy than there says no more.
/// \param excess mean energy, in units of the ideal one, less one
double missingShare(double excess)
{
  const double linear =
    HexagonalDistance * pairEnergyDerivative(HexagonalDistance) / pairEnergy(HexagonalDistance);
  const double quadratic = 0.5 * HexagonalDistance * HexagonalDistance *
    pairEnergySecondDerivative(HexagonalDistance) / pairEnergy(HexagonalDistance);
  const double ratio = quadratic / linear; // < 0
  const double first = std::max(excess / linear, 0.5 / ratio);
  const double eps = first - ratio * first * first;
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
    , Changed(patches.size(), 0)
  {
  }

  /// Deletes particles that have far too much energy, and more than all their neighbours.
  void deleteCrowded(const ParallelFor& parallelFor)
  {
    std::vector<char> crowded(this->Patches.size());
    forAll(
      parallelFor, this->Patches.size(), [&](std::size_t i) { crowded[i] = this->isCrowded(i); });
    for (std::size_t i = 0; i < this->Patches.size(); ++i)
    {
      if (crowded[i])
      {
        this->erase(static_cast<int>(i));
      }
    }
  }

  /// Inserts and deletes particles. Energies tell where and, unless `missing` is known, how many.
  void balance(const std::optional<double>& missing, const ParallelFor& parallelFor)
  {
    std::vector<double> shares(this->Patches.size());
    forAll(
      parallelFor, this->Patches.size(), [&](std::size_t i) { shares[i] = this->shareMissing(i); });
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    const auto counted = static_cast<double>(
      std::count_if(shares.begin(), shares.end(), [](double share) { return share != 0.0; }));
    const double correction = missing ? std::clamp((*missing - total) / std::max(counted, 1.0),
                                          -EnergyOfNumber::Correction, EnergyOfNumber::Correction)
                                      : 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i)
    {
      const double share = shares[i] != 0.0 ? shares[i] + correction : 0.0;
      sum += std::abs(share) > EnergyOfNumber::SmallestShare ? share : 0.0;
      if (sum >= 0.5 && share > 0.0)
      {
        this->insertBeside(this->extreme(i, std::less<>()));
        sum -= 1.0;
      }
      else if (sum <= -0.5 && share < 0.0)
      {
        this->erase(this->extreme(i, std::greater<>()));
        sum += 1.0;
      }
    }
    std::vector<Insertion>& insertions = this->Result.insertions;
    forAll(parallelFor, insertions.size(),
      [&](std::size_t n)
      {
        insertions[n].displacement =
          this->freePlace(insertions[n].beside, insertionDistance, -1.0).displacement;
      });
  }

  /// Inserts particles into holes: the particles around a hole have too little energy.
  void fillHoles(const ParallelFor& parallelFor)
  {
    const auto largest = static_cast<float>(Hole::Energy * idealEnergy());
    std::vector<FreePlace> places(this->Patches.size());
    forAll(parallelFor, this->Patches.size(),
      [&](std::size_t i)
      {
        const Patch& patch = this->Patches[i];
        if (this->Energies[i] >= 0.0f && this->Energies[i] < largest &&
          patch.curvatureMagnitude() * patch.spacing <=
            EnergyOfNumber::LargestCurvatureTimesSpacing)
        {
          places[i] = this->hole(i);
        }
      });
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      // All particles around a hole find it; the first of them fills it.
      const auto fills = [&](int j)
      {
        return j < static_cast<int>(i) && this->Changed[j] &&
          glm::distance(places[j].position, places[i].position) <
          Hole::Clearance * this->Patches[i].spacing;
      };
      if (places[i].clearance >= Hole::Clearance &&
        std::none_of(this->Lists.begin(i), this->Lists.end(i), fills))
      {
        this->Result.insertions.push_back({ static_cast<int>(i), places[i].displacement });
        this->Changed[i] = 1;
      }
    }
  }

private:
  void erase(int i)
  {
    this->Result.kept[i] = 0;
    this->Changed[i] = 1;
  }

  /// The place of the new particle is found later.
  void insertBeside(int i)
  {
    if (!this->Changed[i])
    {
      this->Result.insertions.push_back({ i, glm::vec2(0.0f) });
      this->Changed[i] = 1;
    }
  }

  bool isCrowded(std::size_t i) const
  {
    const auto crowded = static_cast<float>(EnergyOfNumber::Crowded * idealEnergy());
    const float own = this->Energies[i];
    return own > crowded &&
      std::none_of(this->Lists.begin(i), this->Lists.end(i),
        [&](int j) {
          return this->Energies[j] > own || (this->Energies[j] == own && j < static_cast<int>(i));
        });
  }

  /// Of particle i and its neighbours the one with the least or most energy that was not changed yet; i if there is
  /// none.
  template <class Compare>
  int extreme(std::size_t i, const Compare& compare) const
  {
    int best = static_cast<int>(i);
    for (const int* j = this->Lists.begin(i); j != this->Lists.end(i); ++j)
    {
      const bool free = this->Energies[*j] >= 0.0f && !this->Changed[*j] &&
        glm::dot(this->Patches[*j].normal, this->Patches[i].normal) > sameSheetCosine;
      if (free && (this->Changed[best] || compare(this->Energies[*j], this->Energies[best])))
      {
        best = *j;
      }
    }
    return best;
  }

  /// Share of a particle that is missing around particle i for each one there; zero where energies do not tell.
  double shareMissing(std::size_t i) const
  {
    const Patch& patch = this->Patches[i];
    const bool bent =
      patch.curvatureMagnitude() * patch.spacing > EnergyOfNumber::LargestCurvatureTimesSpacing;
    if (this->Energies[i] < 0.0f || this->Changed[i] || bent)
    {
      return 0.0;
    }
    const auto most = static_cast<float>(EnergyOfNumber::Crowded * idealEnergy());
    double sum = std::min(this->Energies[i], most);
    int count = 1;
    for (const int* j = this->Lists.begin(i); j != this->Lists.end(i); ++j)
    {
      if (this->Energies[*j] >= 0.0f &&
        glm::dot(this->Patches[*j].normal, patch.normal) > sameSheetCosine)
      {
        sum += std::min(this->Energies[*j], most);
        ++count;
      }
    }
    return missingShare(sum / (count * EnergyOfNumber::Typical * idealEnergy()) - 1.0);
  }

  struct FreePlace
  {
    /// On the patch of the particle beside it.
    glm::vec2 displacement{ 0.0f };
    glm::dvec3 position{ 0.0 };
    /// Distance of the nearest particle among the neighbours of the one beside it, in units of the spacing.
    double clearance = -1.0;
  };

  /// The middle of a hole beside particle i, if there is one: the free place with the largest clearance.
  FreePlace hole(std::size_t i) const
  {
    FreePlace best = this->freePlace(i, Hole::Distances[0], Hole::FirstClearance);
    for (std::size_t n = 1; n < Hole::Distances.size() && best.clearance > Hole::FirstClearance;
         ++n)
    {
      const FreePlace place = this->freePlace(i, Hole::Distances[n], best.clearance);
      best = place.clearance > best.clearance ? place : best;
    }
    return best;
  }

  /// Of some places around particle i, at a distance in units of its spacing, the one farthest from all neighbours; none,
  /// of clearance -1, if no place has more than `least`.
  FreePlace freePlace(std::size_t i, float distance, double least) const
  {
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
        if (place.clearance <= least)
        {
          break;
        }
      }
      if (place.clearance > least)
      {
        best = place;
        least = place.clearance;
      }
    }
    return best;
  }

  const Buffer<Patch>& Patches;
  const SeenLists& Lists;
  const std::vector<float>& Energies;
  Relaxed& Result;
  /// Marks the particles that were deleted or have a new particle beside them.
  std::vector<char> Changed;
};

} // namespace

void insertAndDelete(const Buffer<Patch>& patches, const SeenLists& lists,
  const std::vector<float>& energies, const Balance& balance, const ParallelFor& parallelFor,
  Relaxed& relaxed)
{
  InsertionDeletion insertionDeletion(patches, lists, energies, relaxed);
  if (balance.extent != Balance::None)
  {
    insertionDeletion.deleteCrowded(parallelFor);
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
