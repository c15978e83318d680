#include "Elements/LostComponents.h"

#include "Elements/BatchEvaluator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hop
{

namespace
{

/// How peaks between nodes are searched: the best of the places around takes the search there, where none is better the
/// step is halved.
struct Climb
{
  /// How much farther than by its estimate a peak may rise above a node. Larger: more searches for nothing; smaller: ridges
  /// that run askew to the axes are passed over.
  static constexpr double Caution = 2.0;
  /// First step, in units of the mean distance of nodes.
  static constexpr double FirstStep = 0.5;
  /// Times that places are looked at. Fewer: ridges that run askew to the axes are not followed to their peaks; more: an
  /// evaluation of all places around takes as long as one of 26 nodes.
  static constexpr int Times = 8;
  /// Height of the polynomial on a peak, of the field's, that is enough. Lower: the polynomial has the peak, but beside it, and
  /// particles that start there do not find the surface; higher: parts are halved for nothing.
  static constexpr double Kept = 0.5;
};

/// A place on the way to a peak.
struct Climber
{
  ReferencePoint place;
  double height = 0.0;
  double step = 0.0;
  /// Whether a peak above zero may be near.
  bool mayRise = true;
};

/// The places around a place that are in the domain. In faces the steps that lead out of it go along them.
std::vector<ReferencePoint> placesAround(Domain domain, const ReferencePoint& u, double step)
{
  // Of coordinates. Larger: places outside count; smaller: places in oblique faces are left out.
  constexpr double rounding = 1e-12;
  std::vector<ReferencePoint> places;
  for (int n = 0; n < 27; ++n)
  {
    const glm::dvec3 direction(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    const ReferencePoint place = broughtInside(domain, { u.xyz + step * direction });
    if (place.xyz != u.xyz && insideMargin(domain, place) > -rounding)
    {
      places.push_back(place);
    }
  }
  return places;
}

/// Heights above an isovalue on one side of it.
std::vector<double> heightsOf(const std::vector<double>& field, double isovalue, double side)
{
  std::vector<double> heights(field.size());
  std::transform(field.begin(), field.end(), heights.begin(),
    [&](double value) { return side * (value - isovalue); });
  return heights;
}

/// How the field runs through each node.
struct Slopes
{
  explicit Slopes(std::size_t count)
    : highestIn(count, 0)
    , lowestIn(count, 0)
    , rise(count, 0.0)
  {
  }

  /// In how many directions of the lattice neither of the nodes beside it is higher, or lower.
  std::vector<char> highestIn;
  std::vector<char> lowestIn;
  /// How far a peak beside it may rise above it, or fall below it: with straight flanks by half the difference of the two
  /// nodes beside it, a direction, a round one by less.
  std::vector<double> rise;
};

Slopes slopesOf(const SamplingLattice& lattice, const std::vector<double>& field)
{
  const std::size_t count = field.size();
  Slopes slopes(count);
  std::vector<double> difference(count);
  std::vector<char> isHighest(count);
  std::vector<char> isLowest(count);
  for (const std::vector<std::array<int, 2>>& direction : lattice.edges)
  {
    std::fill(difference.begin(), difference.end(), 0.0);
    std::fill(isHighest.begin(), isHighest.end(), 1);
    std::fill(isLowest.begin(), isLowest.end(), 1);
    for (const auto& [a, b] : direction)
    {
      const double step = field[b] - field[a];
      isHighest[a] &= static_cast<char>(step <= 0.0);
      isHighest[b] &= static_cast<char>(step >= 0.0);
      isLowest[a] &= static_cast<char>(step >= 0.0);
      isLowest[b] &= static_cast<char>(step <= 0.0);
      difference[a] += step;
      difference[b] += step;
    }
    for (std::size_t n = 0; n < count; ++n)
    {
      slopes.highestIn[n] = static_cast<char>(slopes.highestIn[n] + isHighest[n]);
      slopes.lowestIn[n] = static_cast<char>(slopes.lowestIn[n] + isLowest[n]);
      slopes.rise[n] += Climb::Caution * 0.5 * std::abs(difference[n]);
    }
  }
  return slopes;
}

/// Nodes below zero from which a peak above zero may be reached: peaks, and ridges, which are lower than a node beside them
/// in one direction only. Where that is above zero or on the ridge, too, the search begins there.
/// \param highestIn see Slopes
std::vector<int> nodesBelowPeaks(const SamplingLattice& lattice, const std::vector<double>& heights,
  const std::vector<char>& highestIn, const std::vector<double>& rise)
{
  const int least = static_cast<int>(lattice.edges.size()) - 1;
  std::vector<char> isOnRidge(heights.size());
  for (std::size_t n = 0; n < heights.size(); ++n)
  {
    isOnRidge[n] =
      static_cast<char>(heights[n] <= 0.0 && heights[n] + rise[n] > 0.0 && highestIn[n] >= least);
  }
  if (std::find(isOnRidge.begin(), isOnRidge.end(), 1) == isOnRidge.end())
  {
    return {};
  }
  std::vector<char> isBegin = isOnRidge;
  for (const std::vector<std::array<int, 2>>& direction : lattice.edges)
  {
    for (const auto& [a, b] : direction)
    {
      const auto [lower, higher] = heights[a] < heights[b] ? std::pair(a, b) : std::pair(b, a);
      if (heights[higher] > heights[lower] && (heights[higher] > 0.0 || isOnRidge[higher] != 0))
      {
        isBegin[lower] = 0;
      }
    }
  }
  std::vector<int> nodes;
  for (std::size_t n = 0; n < heights.size(); ++n)
  {
    if (isBegin[n] != 0)
    {
      nodes.push_back(static_cast<int>(n));
    }
  }
  return nodes;
}

/// Moves a climber to the highest place around it, if that is higher.
/// \param heights of the places around
void move(Climber& climber, const ReferencePoint* places, const double* heights, std::size_t count)
{
  const double* end = heights + count;
  const double* best = std::max_element(heights, end);
  climber.mayRise = best != end && *best > climber.height;
  if (climber.mayRise)
  {
    climber.height = *best;
    climber.place = places[best - heights];
    return;
  }
  // It has a peak within a step. By straight flanks that rises as far above it as the flanks fall.
  const double lowest = count > 0 ? *std::min_element(heights, end) : climber.height;
  climber.mayRise = climber.height > 0.0 || 2.0 * climber.height > lowest;
  climber.step *= 0.5;
}

/// Moves all climbers once, and drops those that stay below zero.
void climb(const ComparedField& field, double isovalue, double side, std::vector<Climber>& climbers)
{
  std::vector<ReferencePoint> places;
  std::vector<std::size_t> begins;
  for (const Climber& climber : climbers)
  {
    begins.push_back(places.size());
    const std::vector<ReferencePoint> around =
      placesAround(field.domain, climber.place, climber.step);
    places.insert(places.end(), around.begin(), around.end());
  }
  begins.push_back(places.size());
  const std::vector<double> heights = heightsOf(field.at(places), isovalue, side);
  for (std::size_t c = 0; c < climbers.size(); ++c)
  {
    const std::size_t first = begins[c];
    move(climbers[c], places.data() + first, heights.data() + first, begins[c + 1] - first);
  }
  climbers.erase(std::remove_if(climbers.begin(), climbers.end(),
                   [](const Climber& climber) { return !climber.mayRise; }),
    climbers.end());
}

/// Whether there is a peak above zero between nodes below zero, and the polynomial is not above zero on it, or much lower
/// than the field.
bool losesPeaks(const ComparedField& field, const Slopes& slopes, double isovalue, double side)
{
  const std::vector<double> heights = heightsOf(field.atNodes, isovalue, side);
  const std::vector<char>& highestIn = side > 0.0 ? slopes.highestIn : slopes.lowestIn;
  std::vector<Climber> climbers;
  for (const int node : nodesBelowPeaks(field.lattice, heights, highestIn, slopes.rise))
  {
    climbers.push_back(
      { field.lattice.nodes[node], heights[node], Climb::FirstStep / field.lattice.degrees[0] });
  }
  for (int n = 0; n < Climb::Times && !climbers.empty(); ++n)
  {
    climb(field, isovalue, side, climbers);
  }
  return std::any_of(climbers.begin(), climbers.end(),
    [&](const Climber& climber)
    {
      const double polynomial = evaluateGradient(field.polynomial, climber.place).value.w;
      return climber.height > 0.0 &&
        !(side * (polynomial - isovalue) > Climb::Kept * climber.height);
    });
}

/// Whether nodes hang together on one side of an isovalue where the polynomial is at none of them.
/// \param polynomial at the nodes
bool losesNodes(const ComparedField& field, const std::vector<double>& polynomial, double isovalue)
{
  std::vector<char> isAbove(polynomial.size());
  std::vector<char> isKept(polynomial.size());
  for (std::size_t n = 0; n < polynomial.size(); ++n)
  {
    isAbove[n] = static_cast<char>(field.atNodes[n] > isovalue);
    isKept[n] = static_cast<char>((isAbove[n] != 0) == (polynomial[n] > isovalue));
  }
  return hasSetWithoutMark(field.lattice, isAbove, isKept);
}

} // namespace

bool losesComponents(const ComparedField& field, const std::vector<double>& isovalues)
{
  const std::vector<double> polynomial = fieldAtNodes(field.lattice, field.polynomial);
  const Slopes slopes = slopesOf(field.lattice, field.atNodes);
  return std::any_of(isovalues.begin(), isovalues.end(),
    [&](double isovalue)
    {
      return losesNodes(field, polynomial, isovalue) || losesPeaks(field, slopes, isovalue, 1.0) ||
        losesPeaks(field, slopes, isovalue, -1.0);
    });
}

} // namespace hop
