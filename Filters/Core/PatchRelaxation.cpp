#include "PatchRelaxation.h"

#include "Energy.h"
#include "InstructionSet.h"
#include "Population.h"
#include "SpacingGrid.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

using kernel::Seen;
using kernel::SweepBlock;
using kernel::SweepLanes;

/// Two particles interact up to h/beta; what they move in a round is added to that.
constexpr double listSlack = 0.35;
/// Blocks that one thread moves before another has started.
constexpr std::ptrdiff_t fewBlocks = 64;
/// Over-relaxation of Newton's steps where the surface is flat, and where it bends.
constexpr float flatRelaxation = 1.5f;
constexpr float bentRelaxation = 0.7f;
constexpr float flatUpTo = 0.3f;
/// Largest displacement, in units of h and of 1/D.
constexpr float farthestPerSpacing = 0.5f;
constexpr float farthestPerRadius = 0.5f;

/// Gives each particle that moves the lowest colour that none of those it sees has yet; -1 for fixed.
/// \return lists of particles by colour
std::vector<std::vector<int>> colorParticles(
  const std::vector<Patch>& patches, const SeenLists& lists)
{
  std::vector<std::vector<int>> byColor;
  std::vector<int> colors(patches.size(), -1);
  std::vector<int> takenBy;
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    if (patches[i].fixed)
    {
      continue;
    }
    for (const int* j = lists.begin(i); j != lists.end(i); ++j)
    {
      if (colors[*j] >= 0)
      {
        takenBy[colors[*j]] = static_cast<int>(i);
      }
    }
    const auto free = std::find_if(
      takenBy.begin(), takenBy.end(), [i](int taker) { return taker != static_cast<int>(i); });
    colors[i] = static_cast<int>(free - takenBy.begin());
    if (free == takenBy.end())
    {
      takenBy.push_back(-1);
      byColor.emplace_back();
    }
    byColor[colors[i]].push_back(static_cast<int>(i));
  }
  return byColor;
}

/// Particles and their neighbours as the sweeps want them: in single precision, about a common centre.
class SweepSystem
{
public:
  SweepSystem(const std::vector<Patch>& patches, const ParallelFor& parallelFor)
    : Patches(patches)
    , Parallel(parallelFor)
    , Lists(positionsOf(patches), spacingsOf(patches),
        (1.0 + listSlack * HexagonalDistance) / HexagonalDistance, parallelFor)
  {
    this->makeSeen();
    const auto byColor = colorParticles(patches, this->Lists);
    for (const auto& particles : byColor)
    {
      this->layOut(particles);
    }
    this->fillBlocks(byColor);
  }

  void sweep()
  {
    const auto sweepBlocks = kernel::current().sweep;
    for (std::size_t color = 0; color + 1 < this->ColorStart.size(); ++color)
    {
      const std::ptrdiff_t first = this->ColorStart[color];
      const std::ptrdiff_t count = this->ColorStart[color + 1] - first;
      const auto sweepRange = [&](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        sweepBlocks(this->Blocks.data() + first + begin, end - begin, this->Neighbors.data(),
          this->SeenParticles.data());
      };
      // The last colours have few particles: not worth waking threads for.
      if (count < fewBlocks)
      {
        sweepRange(0, count);
      }
      else
      {
        runParallel(this->Parallel, count, sweepRange);
      }
    }
  }

  Relaxed result(Balance balance) const;

private:
  void makeSeen();
  void layOut(const std::vector<int>& particles);
  void fillBlocks(const std::vector<std::vector<int>>& byColor);
  void fillLane(SweepBlock& block, int lane, int particle) const;

  const std::vector<Patch>& Patches;
  const ParallelFor& Parallel;
  SeenLists Lists;
  glm::dvec3 Center{ 0.0 };
  /// One a particle, and one beyond the sight of all that stands in for neighbours missing in a block.
  std::vector<Seen> SeenParticles;
  std::vector<SweepBlock> Blocks;
  std::vector<std::ptrdiff_t> ColorStart{ 0 };
  std::vector<std::int32_t> Neighbors;
};

void SweepSystem::makeSeen()
{
  glm::dvec3 lower = this->Patches.front().position;
  glm::dvec3 upper = lower;
  for (const Patch& patch : this->Patches)
  {
    lower = glm::min(lower, patch.position);
    upper = glm::max(upper, patch.position);
  }
  this->Center = 0.5 * (lower + upper);
  this->SeenParticles.reserve(this->Patches.size() + 1);
  for (const Patch& patch : this->Patches)
  {
    const glm::vec3 x(patch.position - this->Center);
    this->SeenParticles.push_back({ { x.x, x.y, x.z }, 1.0f / patch.spacing,
      { patch.normal.x, patch.normal.y, patch.normal.z }, 0.0f });
  }
  Seen beyond = this->SeenParticles.front();
  beyond.position[0] =
    static_cast<float>(4.0 * glm::distance(lower, upper)) + 100.0f / beyond.inverseSpacing;
  this->SeenParticles.push_back(beyond);
}

/// Appends the blocks of a colour, empty but for the sizes of their lists.
void SweepSystem::layOut(const std::vector<int>& particles)
{
  for (std::size_t first = 0; first < particles.size(); first += SweepLanes)
  {
    SweepBlock block{};
    block.count =
      static_cast<std::int32_t>(std::min<std::size_t>(SweepLanes, particles.size() - first));
    for (int lane = 0; lane < block.count; ++lane)
    {
      block.neighborCount =
        std::max(block.neighborCount, this->Lists.count(particles[first + lane]));
    }
    block.firstNeighbor = this->Blocks.empty()
      ? 0
      : this->Blocks.back().firstNeighbor + this->Blocks.back().neighborCount * SweepLanes;
    this->Blocks.push_back(block);
  }
  this->ColorStart.push_back(static_cast<std::ptrdiff_t>(this->Blocks.size()));
}

void SweepSystem::fillBlocks(const std::vector<std::vector<int>>& byColor)
{
  if (this->Blocks.empty())
  {
    return;
  }
  const auto beyond = static_cast<std::int32_t>(this->Patches.size());
  this->Neighbors.resize(
    this->Blocks.back().firstNeighbor + this->Blocks.back().neighborCount * SweepLanes);
  const auto fill = [&](const std::vector<int>& particles, SweepBlock& block, std::size_t first)
  {
    std::int32_t* neighbors = this->Neighbors.data() + block.firstNeighbor;
    std::fill_n(neighbors, block.neighborCount * SweepLanes, beyond);
    for (int lane = 0; lane < SweepLanes; ++lane)
    {
      const int particle = particles[first + std::min(lane, block.count - 1)];
      this->fillLane(block, lane, particle);
      std::int32_t* neighbor = neighbors + lane;
      for (const int* j = this->Lists.begin(particle); j != this->Lists.end(particle); ++j)
      {
        *neighbor = *j;
        neighbor += SweepLanes;
      }
    }
  };
  for (std::size_t color = 0; color < byColor.size(); ++color)
  {
    const std::ptrdiff_t start = this->ColorStart[color];
    runParallel(this->Parallel, this->ColorStart[color + 1] - start,
      [&](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        for (std::ptrdiff_t b = begin; b < end; ++b)
        {
          fill(byColor[color], this->Blocks[start + b], b * SweepLanes);
        }
      });
  }
}

Relaxed SweepSystem::result(Balance balance) const
{
  const std::size_t count = this->Patches.size();
  Relaxed result{ std::vector<glm::vec2>(count, glm::vec2(0.0f)), std::vector<char>(count, 1), {} };
  std::vector<float> energies(count, -1.0f);
  for (const SweepBlock& block : this->Blocks)
  {
    for (int lane = 0; lane < block.count; ++lane)
    {
      result.displacements[block.particle[lane]] = { block.moved[0][lane], block.moved[1][lane] };
      energies[block.particle[lane]] = block.energy[lane];
    }
  }
  balancePopulation(this->Patches, this->Lists, energies, balance, result);
  return result;
}

void SweepSystem::fillLane(SweepBlock& block, int lane, int particle) const
{
  const Patch& patch = this->Patches[particle];
  const auto tangents = tangentsOf(patch.normal);
  for (int axis = 0; axis < 3; ++axis)
  {
    block.base[axis][lane] = this->SeenParticles[particle].position[axis];
    block.tangents[0][axis][lane] = tangents[0][axis];
    block.tangents[1][axis][lane] = tangents[1][axis];
    block.normal[axis][lane] = patch.normal[axis];
    block.shape[axis][lane] = patch.shape[axis];
  }
  const float bend = patch.curvatureMagnitude();
  block.inverseSpacing[lane] = 1.0f / patch.spacing;
  block.relaxation[lane] =
    std::max(bentRelaxation, flatRelaxation - std::max(0.0f, bend * patch.spacing - flatUpTo));
  block.farthest[lane] =
    std::min(farthestPerSpacing * patch.spacing, farthestPerRadius / std::max(bend, 1e-30f));
  block.particle[lane] = particle;
}

} // namespace

float Patch::curvatureMagnitude() const
{
  const auto& s = this->shape;
  return std::sqrt(s[0] * s[0] + 2.0f * s[1] * s[1] + s[2] * s[2]);
}

float Patch::sink(const glm::vec2& t) const
{
  const auto& s = this->shape;
  return 0.5f * (s[0] * t.x * t.x + 2.0f * s[1] * t.x * t.y + s[2] * t.y * t.y);
}

std::vector<glm::dvec3> positionsOf(const std::vector<Patch>& patches)
{
  std::vector<glm::dvec3> positions(patches.size());
  std::transform(patches.begin(), patches.end(), positions.begin(),
    [](const Patch& patch) { return patch.position; });
  return positions;
}

std::vector<float> spacingsOf(const std::vector<Patch>& patches)
{
  std::vector<float> spacings(patches.size());
  std::transform(patches.begin(), patches.end(), spacings.begin(),
    [](const Patch& patch) { return patch.spacing; });
  return spacings;
}

std::array<glm::vec3, 2> tangentsOf(const glm::vec3& normal)
{
  const glm::vec3 other = std::abs(normal.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 first = glm::normalize(glm::cross(normal, other));
  return { first, glm::cross(normal, first) };
}

Relaxed relaxOnPatches(
  const std::vector<Patch>& patches, int sweeps, Balance balance, const ParallelFor& parallelFor)
{
  if (patches.empty())
  {
    return {};
  }
  SweepSystem system(patches, parallelFor);
  for (int n = 0; n < sweeps; ++n)
  {
    system.sweep();
  }
  return system.result(balance);
}

} // namespace hop
