#include "PatchRelaxation.h"

#include "Buffer.h"
#include "Energy.h"
#include "InstructionSet.h"
#include "Phases.h"
#include "Population.h"
#include "SpacingGrid.h"

#include <glm/integer.hpp>

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
/// Blocks that a thread moves at a time, and those that are moved before others may interrupt.
constexpr std::ptrdiff_t blocksPerPiece = 8;
constexpr std::ptrdiff_t mostBlocksAtOnce = 200'000;
/// Over-relaxation of Newton's steps where the surface is flat, and where it bends.
constexpr float flatRelaxation = 1.5f;
constexpr float bentRelaxation = 0.7f;
constexpr float flatUpTo = 0.3f;
/// Largest displacement, in units of h and of 1/D.
constexpr float farthestPerSpacing = 0.5f;
constexpr float farthestPerRadius = 0.5f;

/// The lowest colour that none of those a particle sees has; some 20 are in use, as a rule.
int lowestFreeColor(const std::vector<int>& colors, const int* begin, const int* end)
{
  constexpr int colorsAtOnce = 64;
  for (int base = 0;; base += colorsAtOnce)
  {
    std::uint64_t taken = 0;
    for (const int* j = begin; j != end; ++j)
    {
      const auto color = static_cast<unsigned>(colors[*j] - base);
      taken |= color < colorsAtOnce ? std::uint64_t{ 1 } << color : 0;
    }
    if (~taken != 0)
    {
      return base + glm::findLSB(~taken);
    }
  }
}

/// Gives each particle that moves the lowest colour that none of those it sees has yet.
/// \return lists of particles by colour
std::vector<std::vector<int>> colorParticles(
  const std::vector<Patch>& patches, const SeenLists& lists)
{
  std::vector<std::vector<int>> byColor;
  std::vector<int> colors(patches.size(), -1);
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    if (patches[i].fixed)
    {
      continue;
    }
    colors[i] = lowestFreeColor(colors, lists.begin(i), lists.end(i));
    byColor.resize(std::max<std::size_t>(byColor.size(), colors[i] + 1));
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
    this->layOut();
    this->fillBlocks();
  }

  /// Every particle moves that many times, colour by colour.
  void sweep(int times)
  {
    const int colors = static_cast<int>(this->ColorStart.size()) - 1;
    for (int first = 0; first < times * colors;)
    {
      std::ptrdiff_t blocks = 0;
      int last = first;
      for (; last < times * colors && blocks <= mostBlocksAtOnce; ++last)
      {
        blocks += this->blockCount(last % colors);
      }
      this->moveColors(first, last);
      first = last;
    }
  }

  Relaxed result(const Balance& balance) const;

private:
  void makeSeen();
  void sortByNeighbors(std::vector<int>& particles) const;
  void layOut();
  void fillBlocks();
  void fillNeighbors(const SweepBlock& block);
  void fillLane(SweepBlock& block, int lane) const;
  std::ptrdiff_t blockCount(int color) const
  {
    return this->ColorStart[color + 1] - this->ColorStart[color];
  }
  void moveColors(int first, int last);
  template <class Work>
  void forAll(std::size_t count, const Work& work) const
  {
    runParallel(this->Parallel, static_cast<std::ptrdiff_t>(count),
      [&](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        for (std::ptrdiff_t i = begin; i < end; ++i)
        {
          work(static_cast<std::size_t>(i));
        }
      });
  }

  const std::vector<Patch>& Patches;
  const ParallelFor& Parallel;
  SeenLists Lists;
  glm::dvec3 Center{ 0.0 };
  /// One a particle, and one beyond the sight of all that stands in for neighbours missing in a block.
  Buffer<Seen> SeenParticles;
  Buffer<SweepBlock> Blocks;
  std::vector<std::ptrdiff_t> ColorStart{ 0 };
  Buffer<std::int32_t> Neighbors;
};

/// Colours first to last - 1, in the endless sequence of all colours.
void SweepSystem::moveColors(int first, int last)
{
  const int colors = static_cast<int>(this->ColorStart.size()) - 1;
  const auto sweepBlocks = kernel::current().sweep;
  runPhases(
    this->Parallel, last - first,
    [&](int phase)
    {
      const std::ptrdiff_t blocks = this->blockCount((first + phase) % colors);
      return (blocks + blocksPerPiece - 1) / blocksPerPiece;
    },
    [&](int phase, std::ptrdiff_t piece)
    {
      const int color = (first + phase) % colors;
      const std::ptrdiff_t begin = this->ColorStart[color] + piece * blocksPerPiece;
      const std::ptrdiff_t end = std::min(begin + blocksPerPiece, this->ColorStart[color + 1]);
      sweepBlocks(this->Blocks.data() + begin, end - begin, this->Neighbors.data(),
        this->SeenParticles.data());
    });
}

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
  this->SeenParticles = Buffer<Seen>(this->Patches.size() + 1);
  this->forAll(this->Patches.size(),
    [&](std::size_t i)
    {
      const Patch& patch = this->Patches[i];
      const glm::vec3 x(patch.position - this->Center);
      this->SeenParticles[i] = { { x.x, x.y, x.z }, 1.0f / patch.spacing,
        { patch.normal.x, patch.normal.y, patch.normal.z }, 0.0f };
    });
  Seen& beyond = this->SeenParticles[this->Patches.size()];
  beyond = this->SeenParticles[0];
  beyond.position[0] =
    static_cast<float>(4.0 * glm::distance(lower, upper)) + 100.0f / beyond.inverseSpacing;
}

/// Sorts particles by the number of their neighbours, a few blocks at a time: lists of a block are filled up
/// to the longest.
void SweepSystem::sortByNeighbors(std::vector<int>& particles) const
{
  constexpr std::size_t window = 16 * SweepLanes;
  for (std::size_t first = 0; first < particles.size(); first += window)
  {
    const std::size_t last = std::min(particles.size(), first + window);
    std::sort(particles.begin() + first, particles.begin() + last,
      [this](int a, int b)
      {
        const int countA = this->Lists.count(a);
        const int countB = this->Lists.count(b);
        return countA != countB ? countA < countB : a < b;
      });
  }
}

/// Makes the blocks of each colour, with their particles and room for their lists.
void SweepSystem::layOut()
{
  std::vector<std::vector<int>> byColor = colorParticles(this->Patches, this->Lists);
  this->forAll(byColor.size(), [&](std::size_t color) { this->sortByNeighbors(byColor[color]); });
  for (const std::vector<int>& particles : byColor)
  {
    this->ColorStart.push_back(this->ColorStart.back() +
      static_cast<std::ptrdiff_t>((particles.size() + SweepLanes - 1) / SweepLanes));
  }
  this->Blocks = Buffer<SweepBlock>(this->ColorStart.back());
  this->forAll(this->Blocks.size(),
    [&](std::size_t b)
    {
      const auto next = std::upper_bound(
        this->ColorStart.begin(), this->ColorStart.end(), static_cast<std::ptrdiff_t>(b));
      const std::vector<int>& particles = byColor[next - this->ColorStart.begin() - 1];
      const std::size_t first = (b - *(next - 1)) * SweepLanes;
      SweepBlock& block = this->Blocks[b];
      block = {};
      block.count =
        static_cast<std::int32_t>(std::min<std::size_t>(SweepLanes, particles.size() - first));
      for (int lane = 0; lane < SweepLanes; ++lane)
      {
        block.particle[lane] = particles[first + std::min(lane, block.count - 1)];
        block.neighborCount =
          std::max(block.neighborCount, this->Lists.count(block.particle[lane]));
      }
    });
}

void SweepSystem::fillBlocks()
{
  std::ptrdiff_t neighbors = 0;
  for (SweepBlock& block : this->Blocks)
  {
    block.firstNeighbor = neighbors;
    neighbors += std::ptrdiff_t{ block.neighborCount } * SweepLanes;
  }
  this->Neighbors = Buffer<std::int32_t>(neighbors);
  this->forAll(this->Blocks.size(),
    [&](std::size_t b)
    {
      SweepBlock& block = this->Blocks[b];
      for (int lane = 0; lane < SweepLanes; ++lane)
      {
        this->fillLane(block, lane);
      }
      this->fillNeighbors(block);
    });
}

void SweepSystem::fillNeighbors(const SweepBlock& block)
{
  const auto beyond = static_cast<std::int32_t>(this->Patches.size());
  std::int32_t* rows = this->Neighbors.data() + block.firstNeighbor;
  std::fill_n(rows, block.neighborCount * SweepLanes, beyond);
  for (int lane = 0; lane < SweepLanes; ++lane)
  {
    std::int32_t* neighbor = rows + lane;
    const int particle = block.particle[lane];
    for (const int* j = this->Lists.begin(particle); j != this->Lists.end(particle); ++j)
    {
      *neighbor = *j;
      neighbor += SweepLanes;
    }
  }
}

Relaxed SweepSystem::result(const Balance& balance) const
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
  balancePopulation(this->Patches, this->Lists, energies, balance, this->Parallel, result);
  return result;
}

void SweepSystem::fillLane(SweepBlock& block, int lane) const
{
  const int particle = block.particle[lane];
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

Relaxed relaxOnPatches(const std::vector<Patch>& patches, int sweeps, const Balance& balance,
  const ParallelFor& parallelFor)
{
  if (patches.empty())
  {
    return {};
  }
  SweepSystem system(patches, parallelFor);
  system.sweep(sweeps);
  return system.result(balance);
}

} // namespace hop
