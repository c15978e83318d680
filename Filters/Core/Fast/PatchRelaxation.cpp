#include "Fast/PatchRelaxation.h"

#include "Fast/InsertionDeletion.h"
#include "Kernel/InstructionSet.h"
#include "Support/Buffer.h"
#include "Support/DisjointSets.h"
#include "Support/Phases.h"
#include "Support/SortedBy.h"
#include "Support/SpacingGrid.h"
#include "Surface/Energy.h"

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
/// From so many particles on they are moved tile by tile, so many at a time.
constexpr std::size_t manyParticles = 150'000;
constexpr std::size_t particlesPerTile = 2048;
/// Blocks that a thread moves at a time, and those that are moved before others may interrupt.
constexpr std::ptrdiff_t blocksPerPiece = 8;
constexpr std::ptrdiff_t mostBlocksAtOnce = 200'000;
/// Up to this extent, in units of the smallest spacing, single precision tells less than a hundredth of that.
constexpr double farApart = 1e5;
/// Over-relaxation of Newton's steps where the surface is flat, and where it bends.
constexpr float flatRelaxation = 1.5f;
constexpr float bentRelaxation = 0.7f;
constexpr float flatUpTo = 0.3f;
/// Largest displacement, in units of 1/D.
constexpr float farthestPerRadius = 0.5f;

/// The lowest colour that none of those a particle sees has, as far as they are in [first, last); some 20 are
/// in use, as a rule.
int lowestFreeColor(
  const std::vector<int>& colors, const int* begin, const int* end, int first, int last)
{
  constexpr int colorsAtOnce = 64;
  for (int base = 0;; base += colorsAtOnce)
  {
    std::uint64_t taken = 0;
    for (const int* j = begin; j != end; ++j)
    {
      if (*j >= first && *j < last)
      {
        const auto color = static_cast<unsigned>(colors[*j] - base);
        taken |= color < colorsAtOnce ? std::uint64_t{ 1 } << color : 0;
      }
    }
    if (~taken != 0)
    {
      return base + glm::findLSB(~taken);
    }
  }
}

/// Gives each particle that moves the lowest colour that none of those it sees has yet; -1 for fixed ones.
/// Pieces of particles that follow each other are coloured in threads; then those that see their own colour
/// in a piece before theirs get another.
std::vector<int> colorParticles(
  const Buffer<Patch>& patches, const SeenLists& lists, const ParallelFor& parallelFor)
{
  constexpr int particlesPerPiece = 16384;
  const int count = static_cast<int>(patches.size());
  std::vector<int> colors(count, -1);
  std::vector<std::vector<int>> atBorders((count + particlesPerPiece - 1) / particlesPerPiece);
  forAll(parallelFor, atBorders.size(),
    [&](std::size_t piece)
    {
      const int first = static_cast<int>(piece) * particlesPerPiece;
      const int last = std::min(count, first + particlesPerPiece);
      for (int i = first; i < last; ++i)
      {
        if (!patches[i].fixed)
        {
          colors[i] = lowestFreeColor(colors, lists.begin(i), lists.end(i), first, last);
          if (std::any_of(lists.begin(i), lists.end(i), [=](int j) { return j < first; }))
          {
            atBorders[piece].push_back(i);
          }
        }
      }
    });
  for (const std::vector<int>& some : atBorders)
  {
    for (const int i : some)
    {
      const auto hasSame = [&](int j) { return j < i && colors[j] == colors[i]; };
      if (std::any_of(lists.begin(i), lists.end(i), hasSame))
      {
        colors[i] = lowestFreeColor(colors, lists.begin(i), lists.end(i), 0, count);
      }
    }
  }
  return colors;
}

/// Gives each tile of so many particles the lowest colour that no tile has of which it sees a particle.
std::vector<int> colorTiles(
  std::size_t tileSize, const SeenLists& lists, const ParallelFor& parallelFor)
{
  const std::size_t count = (lists.size() + tileSize - 1) / tileSize;
  std::vector<std::vector<int>> seen(count);
  forAll(parallelFor, count,
    [&](std::size_t tile)
    {
      std::vector<int>& others = seen[tile];
      const std::size_t end = std::min(lists.size(), (tile + 1) * tileSize);
      for (std::size_t i = tile * tileSize; i < end; ++i)
      {
        for (const int* j = lists.begin(i); j != lists.end(i); ++j)
        {
          const int other = static_cast<int>(static_cast<std::size_t>(*j) / tileSize);
          if (std::find(others.begin(), others.end(), other) == others.end())
          {
            others.push_back(other);
          }
        }
      }
    });
  std::vector<int> colors(count, -1);
  for (std::size_t tile = 0; tile < count; ++tile)
  {
    const std::vector<int>& others = seen[tile];
    colors[tile] = lowestFreeColor(
      colors, others.data(), others.data() + others.size(), 0, static_cast<int>(count));
  }
  return colors;
}

/// Particles and their neighbours as the sweeps want them: in single precision, about a common centre.
class SweepSystem
{
public:
  SweepSystem(const Buffer<Patch>& patches, float farthest, const ParallelFor& parallelFor)
    : Patches(patches)
    , Farthest(farthest)
    , Parallel(parallelFor)
    , Points(spacedPoints(patches, parallelFor))
    , Lists(Points.positions, Points.spacings,
        (1.0 + listSlack * HexagonalDistance) / HexagonalDistance, parallelFor)
  {
    this->makeSeen();
    this->layOut();
    this->fillBlocks();
  }

  /// Every particle moves that many times, stage by stage.
  void sweep(int times, const std::function<void(double share)>& reached)
  {
    const int stages = static_cast<int>(this->Stages.size());
    for (int first = 0; first < times * stages;)
    {
      std::ptrdiff_t blocks = 0;
      int last = first;
      for (; last < times * stages && blocks <= mostBlocksAtOnce; ++last)
      {
        for (const BlockRange& piece : this->Stages[last % stages])
        {
          blocks += piece.end - piece.begin;
        }
      }
      this->runStages(first, last);
      first = last;
      if (reached)
      {
        reached(first / static_cast<double>(times * stages));
      }
    }
  }

  Relaxed result(const Balance& balance) const;

private:
  struct BlockRange
  {
    std::ptrdiff_t begin = 0;
    std::ptrdiff_t end = 0;
  };

  void makeSeen();
  std::vector<glm::dvec3> centersOfGroups(const Bounds& bounds) const;
  void sortByNeighbors(int* begin, int* end) const;
  void layOut();
  void fillBlocks();
  void fillLane(int particle, SweepBlock& block, int lane);
  void makeStages(std::size_t tileSize, std::size_t groupsPerTile);
  void runStages(int first, int last);

  const Buffer<Patch>& Patches;
  float Farthest;
  const ParallelFor& Parallel;
  SpacedPoints Points;
  SeenLists Lists;
  /// One a particle, and one beyond the sight of all that stands in for neighbours missing in a block.
  Buffer<Seen> SeenParticles;
  Buffer<SweepBlock> Blocks;
  /// Where each particle that moves is: SweepLanes times its block, and its lane.
  Buffer<int> LaneOf;
  /// Blocks of particles of one tile and colour follow each other: where each such group starts.
  std::vector<std::ptrdiff_t> GroupStart{ 0 };
  /// What may move at the same time: within a piece one block after the other, pieces in threads.
  std::vector<std::vector<BlockRange>> Stages;
  Buffer<std::int32_t> Neighbors;
};

/// Stages first to last - 1, in the endless sequence of all stages.
void SweepSystem::runStages(int first, int last)
{
  const auto sweepBlocks = kernel::current().sweep;
  const auto stage = [&](int phase) -> const std::vector<BlockRange>&
  { return this->Stages[(first + phase) % this->Stages.size()]; };
  runPhases(
    this->Parallel, last - first,
    [&](int phase) { return static_cast<std::ptrdiff_t>(stage(phase).size()); },
    [&](int phase, std::ptrdiff_t piece)
    {
      const auto [begin, end] = stage(phase)[piece];
      sweepBlocks(this->Blocks.data() + begin, end - begin, this->Neighbors.data(),
        this->SeenParticles.data());
    });
}

void SweepSystem::makeSeen()
{
  const Bounds bounds = boundsOf(this->Points.positions, this->Parallel);
  const std::vector<glm::dvec3> centers = this->centersOfGroups(bounds);
  this->SeenParticles = Buffer<Seen>(this->Patches.size() + 1);
  forAll(this->Parallel, this->Patches.size(),
    [&](std::size_t i)
    {
      const Patch& patch = this->Patches[i];
      const glm::vec3 x(this->Points.positions[i] - centers[centers.size() > 1 ? i : 0]);
      this->SeenParticles[i] = { { x.x, x.y, x.z }, 1.0f / patch.spacing,
        { patch.normal.x, patch.normal.y, patch.normal.z }, 0.0f };
    });
  Seen& beyond = this->SeenParticles[this->Patches.size()];
  beyond = this->SeenParticles[0];
  beyond.position[0] = static_cast<float>(4.0 * glm::distance(bounds.lower, bounds.upper)) +
    100.0f / beyond.inverseSpacing;
}

/// The place from which each particle's position is counted in single precision. One for all, unless they lie
/// so far apart that it cannot tell neighbours any more: then each group that sees itself has its own.
std::vector<glm::dvec3> SweepSystem::centersOfGroups(const Bounds& bounds) const
{
  const float smallest =
    *std::min_element(this->Points.spacings.begin(), this->Points.spacings.end());
  if (glm::distance(bounds.lower, bounds.upper) <= farApart * static_cast<double>(smallest))
  {
    return { 0.5 * (bounds.lower + bounds.upper) };
  }
  const int count = static_cast<int>(this->Patches.size());
  DisjointSets groups(count);
  for (int i = 0; i < count; ++i)
  {
    std::for_each(this->Lists.begin(i), this->Lists.end(i), [&](int j) { groups.unite(i, j); });
  }
  std::vector<glm::dvec3> centers(count);
  for (int i = 0; i < count; ++i)
  {
    centers[i] = this->Points.positions[groups.root(i)];
  }
  return centers;
}

/// Sorts particles by the number of their neighbours, a few blocks at a time: lists of a block are filled up
/// to the longest.
void SweepSystem::sortByNeighbors(int* begin, int* end) const
{
  constexpr std::ptrdiff_t window = 16 * SweepLanes;
  for (; begin < end; begin += window)
  {
    std::sort(begin, std::min(end, begin + window),
      [this](int a, int b)
      {
        const int countA = this->Lists.count(a);
        const int countB = this->Lists.count(b);
        return countA != countB ? countA < countB : a < b;
      });
  }
}

/// Makes the blocks, of particles of one colour each, with room for their lists. Where there are many
/// particles, those of a tile follow each other, colour by colour, so that they stay in the cache while all
/// of them move.
void SweepSystem::layOut()
{
  const std::size_t count = this->Patches.size();
  const std::size_t tileSize = count < manyParticles ? count : particlesPerTile;
  std::vector<int> groupOf = colorParticles(this->Patches, this->Lists, this->Parallel);
  const auto colorCount =
    static_cast<std::size_t>(*std::max_element(groupOf.begin(), groupOf.end()) + 1);
  const std::size_t groupCount = (count + tileSize - 1) / tileSize * colorCount;
  forAll(this->Parallel, count,
    [&](std::size_t i)
    {
      groupOf[i] =
        static_cast<int>(groupOf[i] < 0 ? groupCount : i / tileSize * colorCount + groupOf[i]);
    });
  // Those that are fixed come last.
  Grouping groups = groupedBy(
    groupOf, groupCount + 1, [](int group) { return group; }, this->Parallel);
  forAll(this->Parallel, groupCount,
    [&](std::size_t g)
    {
      this->sortByNeighbors(
        groups.order.data() + groups.start[g], groups.order.data() + groups.start[g + 1]);
    });
  for (std::size_t g = 0; g < groupCount; ++g)
  {
    const int particles = groups.start[g + 1] - groups.start[g];
    this->GroupStart.push_back(this->GroupStart.back() + (particles + SweepLanes - 1) / SweepLanes);
  }
  this->makeStages(tileSize, colorCount);
  this->Blocks = Buffer<SweepBlock>(this->GroupStart.back());
  this->LaneOf = Buffer<int>(count);
  forAll(this->Parallel, this->Blocks.size(),
    [&](std::size_t b)
    {
      const auto next = std::upper_bound(
        this->GroupStart.begin(), this->GroupStart.end(), static_cast<std::ptrdiff_t>(b));
      const auto group = next - this->GroupStart.begin() - 1;
      const auto first = groups.start[group] +
        static_cast<int>(static_cast<std::ptrdiff_t>(b) - *(next - 1)) * SweepLanes;
      SweepBlock& block = this->Blocks[b];
      block = {};
      block.count = std::min(SweepLanes, groups.start[group + 1] - first);
      for (int lane = 0; lane < SweepLanes; ++lane)
      {
        const int particle = groups.order[first + std::min(lane, block.count - 1)];
        block.particle[lane] = particle;
        block.neighborCount = std::max(block.neighborCount, this->Lists.count(particle));
        if (lane < block.count)
        {
          this->LaneOf[particle] = static_cast<int>(b) * SweepLanes + lane;
        }
      }
    });
}

/// One tile: a stage for each colour. Several: a stage for each colour of tiles.
void SweepSystem::makeStages(std::size_t tileSize, std::size_t groupsPerTile)
{
  const std::size_t groups = this->GroupStart.size() - 1;
  if (groups <= groupsPerTile)
  {
    for (std::size_t color = 0; color < groups; ++color)
    {
      this->Stages.emplace_back();
      const std::ptrdiff_t end = this->GroupStart[color + 1];
      for (std::ptrdiff_t b = this->GroupStart[color]; b < end; b += blocksPerPiece)
      {
        this->Stages.back().push_back({ b, std::min(end, b + blocksPerPiece) });
      }
    }
    return;
  }
  const std::vector<int> colors = colorTiles(tileSize, this->Lists, this->Parallel);
  this->Stages.resize(*std::max_element(colors.begin(), colors.end()) + 1);
  for (std::size_t tile = 0; tile < colors.size(); ++tile)
  {
    const std::size_t group = tile * groupsPerTile;
    this->Stages[colors[tile]].push_back(
      { this->GroupStart[group], this->GroupStart[group + groupsPerTile] });
  }
}

/// Particle by particle, as what is known about them lies in memory: blocks that fill up at a time are few.
void SweepSystem::fillBlocks()
{
  std::ptrdiff_t neighbors = 0;
  for (SweepBlock& block : this->Blocks)
  {
    block.firstNeighbor = neighbors;
    neighbors += std::ptrdiff_t{ block.neighborCount } * SweepLanes;
  }
  this->Neighbors = Buffer<std::int32_t>(neighbors);
  forAll(this->Parallel, this->Patches.size(),
    [&](std::size_t i)
    {
      if (!this->Patches[i].fixed)
      {
        SweepBlock& block = this->Blocks[this->LaneOf[i] / SweepLanes];
        const int lane = this->LaneOf[i] % SweepLanes;
        // The last one takes lanes that are left over, too.
        const int end = lane == block.count - 1 ? SweepLanes : lane + 1;
        for (int n = lane; n < end; ++n)
        {
          this->fillLane(static_cast<int>(i), block, n);
        }
      }
    });
}

Relaxed SweepSystem::result(const Balance& balance) const
{
  const std::size_t count = this->Patches.size();
  Relaxed result{ std::vector<glm::vec2>(count, glm::vec2(0.0f)), std::vector<char>(count, 1), {} };
  std::vector<float> energies(count, -1.0f);
  forAll(this->Parallel, this->Blocks.size(),
    [&](std::size_t b)
    {
      const SweepBlock& block = this->Blocks[b];
      for (int lane = 0; lane < block.count; ++lane)
      {
        result.displacements[block.particle[lane]] = { block.moved[0][lane], block.moved[1][lane] };
        energies[block.particle[lane]] = block.energy[lane];
      }
    });
  insertAndDelete(this->Patches, this->Lists, energies, balance, this->Parallel, result);
  return result;
}

void SweepSystem::fillLane(int particle, SweepBlock& block, int lane)
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
    std::min(this->Farthest * patch.spacing, farthestPerRadius / std::max(bend, 1e-30f));
  std::int32_t* neighbor = this->Neighbors.data() + block.firstNeighbor + lane;
  for (const int* j = this->Lists.begin(particle); j != this->Lists.end(particle); ++j)
  {
    *neighbor = *j;
    neighbor += SweepLanes;
  }
  for (int n = this->Lists.count(particle); n < block.neighborCount; ++n)
  {
    *neighbor = static_cast<std::int32_t>(this->Patches.size());
    neighbor += SweepLanes;
  }
}

} // namespace

Relaxed relaxOnPatches(const Buffer<Patch>& patches, const Sweeps& sweeps, const Balance& balance,
  const ParallelFor& parallelFor, const std::function<void(double share)>& reached)
{
  if (patches.empty())
  {
    return {};
  }
  SweepSystem system(patches, sweeps.farthest, parallelFor);
  system.sweep(sweeps.count, reached);
  return system.result(balance);
}

} // namespace hop
