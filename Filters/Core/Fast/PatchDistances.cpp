#include "Fast/PatchDistances.h"

#include "Support/KeepFirst.h"
#include "Support/KeepMarked.h"
#include "Support/SpacingGrid.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// When a particle covers a sample of the surface, so that the sample's box needs no particle of its own.
struct Coverage
{
  /// Largest distance of the sample from the particle's patch, in units of the particle's spacing; curvature adds to
  /// it. Chosen by experiment. Larger: the particle covers another sheet nearby, whose component may be lost; smaller:
  /// particles are added that are not needed.
  static constexpr float Height = 0.1f;
  /// Distance up to which a sample that becomes a particle covers other samples, in units of its spacing. Chosen by
  /// experiment. Larger: holes; smaller: crowds.
  static constexpr double Distance = 0.7;
};

/// Cells of the grids in one reach (see SpacingGrid). They change the time alone; chosen by experiment.
struct GridCells
{
  /// For visits around single points.
  static constexpr double PerReach = 0.3;
  /// Where most visits find nothing.
  static constexpr double PerReachOfFew = 0.25;
  /// For points that may stand much closer than their reach.
  static constexpr double PerReachOfMany = 1.0;
};

bool isNear(const Patch& a, const Patch& b, double distance)
{
  return glm::distance(a.position, b.position) < distance && glm::dot(a.normal, b.normal) > 0.0f;
}

/// Whether the surface around a patch runs through a sample.
bool covers(const Patch& patch, const Patch& sample)
{
  const auto distance = static_cast<float>(glm::distance(patch.position, sample.position));
  if (distance > patch.spacing || glm::dot(patch.normal, sample.normal) <= 0.0f)
  {
    return false;
  }
  const float bend = patch.curvatureMagnitude() * distance;
  return std::abs(patch.heightOf(sample.position)) <=
    (Coverage::Height + bend * bend) * patch.spacing;
}

/// test(i) for every i in [0, count), in threads.
template <class Test>
std::vector<char> testAll(std::size_t count, const ParallelFor& parallelFor, const Test& test)
{
  std::vector<char> results(count);
  forAll(parallelFor, count, [&](std::size_t i) { results[i] = test(i); });
  return results;
}

/// How many of some ordered patches are looked at first to select `count` of them. More: all take long to look at;
/// fewer: the look is repeated with twice as many. It changes the time alone; chosen by experiment.
std::size_t firstLook(std::size_t count, std::size_t size)
{
  constexpr std::size_t perSelected = 4;
  constexpr std::size_t atLeast = 256;
  return std::min(size, std::max(perSelected * count, atLeast));
}

/// Looks up patches nearer to each other than a distance, in units of the smaller of their spacings.
class NearPatches
{
public:
  NearPatches(const Buffer<Patch>& patches, double distance, const ParallelFor& parallelFor)
    : Patches(patches)
    , Distance(distance)
    , Points(spacedPoints(patches, parallelFor))
    , Grid(Points.positions, Points.spacings, distance, GridCells::PerReach, parallelFor)
  {
  }

  template <class Use>
  void visitNear(std::size_t i, const Use& use) const
  {
    const Buffer<glm::dvec3>& positions = this->Points.positions;
    const Buffer<float>& spacings = this->Points.spacings;
    this->Grid.visit(positions[i], spacings[i],
      [&](int j)
      {
        const double nearest = this->Distance * std::min(spacings[i], spacings[j]);
        const glm::dvec3 apart = positions[j] - positions[i];
        // Patches are large: the normals of the few that are near are read last.
        if (glm::dot(apart, apart) < nearest * nearest && static_cast<std::size_t>(j) != i &&
          glm::dot(this->Patches[i].normal, this->Patches[j].normal) > 0.0f)
        {
          use(j);
        }
      });
  }

  bool isSeparated(std::size_t i) const
  {
    bool separated = true;
    this->visitNear(i, [&](int) { separated = false; });
    return separated;
  }

private:
  const Buffer<Patch>& Patches;
  double Distance;
  SpacedPoints Points;
  SpacingGrid Grid;
};

} // namespace

std::vector<char> areFarFrom(const Buffer<Patch>& patches, std::size_t count,
  const Buffer<Patch>& others, double distance, const ParallelFor& parallelFor)
{
  const SpacedPoints points = spacedPoints(others, parallelFor);
  const SpacingGrid grid(
    points.positions, points.spacings, distance, GridCells::PerReachOfFew, parallelFor);
  return testAll(count, parallelFor,
    [&](std::size_t i)
    {
      const Patch& patch = patches[i];
      const double nearest = distance * patch.spacing;
      bool far = true;
      // Where boundary curves crowd there are thousands of points to look at: patches are large, and read last.
      grid.visit(patch.position, patch.spacing,
        [&](int j)
        {
          far = far &&
            !(glm::distance(patch.position, points.positions[j]) < nearest &&
              glm::dot(patch.normal, others[j].normal) > 0.0f);
        });
      return far;
    });
}

std::vector<char> areSeparated(
  const Buffer<Patch>& patches, std::size_t count, double distance, const ParallelFor& parallelFor)
{
  const NearPatches nearPatches(patches, distance, parallelFor);
  return testAll(count, parallelFor, [&](std::size_t i) { return nearPatches.isSeparated(i); });
}

std::vector<char> thinOut(const Buffer<Patch>& patches, const std::vector<char>& candidates,
  double distance, const ParallelFor& parallelFor)
{
  const NearPatches nearPatches(patches, distance, parallelFor);
  return keepFirst(candidates, patches.size(), parallelFor,
    [&](std::size_t i, const auto& use) { nearPatches.visitNear(i, use); });
}

std::vector<double> clearances(const Buffer<Patch>& patches, std::size_t count,
  const Buffer<Patch>& others, double most, const ParallelFor& parallelFor)
{
  const SpacedPoints points = spacedPoints(others, parallelFor);
  const SpacingGrid grid(points.positions, points.spacings, most, GridCells::PerReach, parallelFor);
  const bool areTheSame = &patches == &others;
  std::vector<double> result(count, most);
  forAll(parallelFor, count,
    [&](std::size_t i)
    {
      const Patch& patch = patches[i];
      grid.visit(patch.position, patch.spacing,
        [&](int j)
        {
          const bool isOther = !areTheSame || static_cast<std::size_t>(j) != i;
          if (isOther && isNear(patch, others[j], result[i] * patch.spacing))
          {
            result[i] = glm::distance(patch.position, others[j].position) / patch.spacing;
          }
        });
    });
  return result;
}

std::vector<int> selectSeparated(const Buffer<Patch>& patches, const std::vector<int>& order,
  std::size_t count, double distance, const ParallelFor& parallelFor)
{
  // The first few, as a rule, tell enough. Which of them are separated does not depend on the ones behind them.
  std::vector<char> separated;
  std::size_t found = 0;
  for (std::size_t looked = firstLook(count, order.size()); found < count;
       looked = std::min(order.size(), 2 * looked))
  {
    Buffer<Patch> inOrder;
    for (std::size_t n = 0; n < looked; ++n)
    {
      inOrder.push_back(patches[order[n]]);
    }
    separated = thinOut(inOrder, std::vector<char>(looked, 1), distance, parallelFor);
    found = static_cast<std::size_t>(std::count(separated.begin(), separated.end(), 1));
    if (looked == order.size())
    {
      break;
    }
  }
  std::vector<int> chosen;
  for (const char pass : { 1, 0 })
  {
    for (std::size_t n = 0; n < separated.size() && chosen.size() < count; ++n)
    {
      if (separated[n] == pass)
      {
        chosen.push_back(order[n]);
      }
    }
  }
  return chosen;
}

std::vector<char> findUncovered(const std::vector<SurfaceProxy::Sample>& samples,
  const Buffer<Patch>& patches, const ParallelFor& parallelFor)
{
  const SpacedPoints points = spacedPoints(patches, parallelFor);
  const SpacingGrid grid(points.positions, points.spacings, 1.0, GridCells::PerReach, parallelFor);
  return testAll(samples.size(), parallelFor,
    [&](std::size_t b)
    {
      const Patch& sample = samples[b].patch;
      bool covered = !samples[b].found;
      grid.visit(sample.position, sample.spacing,
        [&](int j) { covered = covered || covers(patches[j], sample); });
      return !covered;
    });
}

std::vector<int> chooseUncovered(const std::vector<SurfaceProxy::Sample>& samples,
  const std::vector<char>& marks, const ParallelFor& parallelFor)
{
  Buffer<Patch> patches;
  const std::vector<int> marked = markedIndices(marks, samples.size());
  for (const int b : marked)
  {
    patches.push_back(samples[b].patch);
  }
  const SpacedPoints points = spacedPoints(patches, parallelFor);
  // The grid reaches as far as the harmonic mean of two spacings: enough even where the other one is half as large.
  const SpacingGrid grid(
    points.positions, points.spacings, 1.0, GridCells::PerReachOfMany, parallelFor);
  std::vector<char> isChosen(marked.size(), 0);
  std::vector<int> chosen;
  // Samples after which the caller is asked whether to go on. More: it waits longer; fewer: more time goes into asking.
  constexpr std::size_t samplesAtOnce = 4096;
  for (std::size_t i = 0; i < marked.size(); ++i)
  {
    if (i % samplesAtOnce == 0)
    {
      askCaller(parallelFor);
    }
    bool covered = false;
    const auto cover = [&](int j)
    {
      const double distance = glm::distance(points.positions[i], points.positions[j]);
      covered = covered ||
        (isChosen[j] && distance <= Coverage::Distance * points.spacings[j] &&
          glm::dot(patches[i].normal, patches[j].normal) > 0.0f);
    };
    grid.visit(points.positions[i], points.spacings[i], cover);
    if (!covered)
    {
      isChosen[i] = 1;
      chosen.push_back(marked[i]);
    }
  }
  return chosen;
}

} // namespace hop
