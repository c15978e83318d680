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

/// Slack of the neighbour lists, which are made once a round, in units of the spacing: it is added to the distance
/// h/beta up to which two particles interact, as they move in the meantime. Chosen by experiment. Larger: longer lists,
/// and slower sweeps; smaller: particles that come near each other do not interact.
constexpr double listSlack = 0.35;

/// Where there are many particles they are moved tile by tile, so that a tile stays in the cache while all its colours
/// move. The numbers change the time, and the order in which particles move; chosen by experiment.
struct Tiles
{
  /// Number of particles from which on there are tiles. With fewer of them all data fit into the caches.
  static constexpr std::size_t LeastParticles = 150'000;
  /// Larger tiles do not stay in the cache; smaller ones leave blocks of few particles.
  static constexpr std::size_t Particles = 2048;
};

/// How the sweeps are dealt out to threads. The numbers change the time alone; chosen by experiment.
struct Pieces
{
  /// Blocks that a thread takes at a time. More: threads wait for the last one; fewer: more dealing out.
  static constexpr std::ptrdiff_t Blocks = 8;
  /// Blocks that are moved before the caller may end the work. More: it waits longer; fewer: threads start more often.
  static constexpr std::ptrdiff_t BlocksAtOnce = 200'000;
};

/// Particles that a thread colours at a time. More: fewer threads have work; fewer: more particles have neighbours in
/// other pieces, and are coloured again in one thread. Chosen by experiment; it changes the colours, and with them the
/// order in which particles move.
constexpr int particlesPerPiece = 16384;

/// Largest extent of all particles, in units of the smallest spacing, at which single precision tells their positions
/// to a hundredth of a spacing: 1e5 times its rounding of 6e-8 is 0.006.
constexpr double largestExtent = 1e5;

/// Factor of the Newton steps: F - (D h - B), F at most and S at least, where a particle's curvature magnitude times
/// spacing is D h. Chosen by experiment. Larger: faster where the energy is nearly quadratic; from some size on
/// particles oscillate, soonest where the surface bends.
struct Overrelaxation
{
  /// F.
  static constexpr float Flat = 1.5f;
  /// S.
  static constexpr float Bent = 0.7f;
  /// B.
  static constexpr float FlatBend = 0.3f;
};

/// Largest displacement of a particle in units of the radius of curvature 1/D: its quadratic patch departs from a
/// sphere by less than 1% of the radius there. Chosen by experiment. Larger: steps that end off the surface are halved;
/// smaller: more rounds are needed where the surface bends.
constexpr float farthestPerRadius = 0.5f;

/// Curvature magnitudes are at least this, 1/world units, where they are divided by: a flat patch has none.
constexpr float smallestCurvature = 1e-30f;

/// The lowest colour that no particle of a list has. Particles outside [first, last) do not count. Some 20 colours are
/// in use, as a rule.
int lowestFreeColor(
  const std::vector<int>& colors, const int* begin, const int* end, int first, int last)
{
  // One a bit.
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

/// Gives each particle that moves the lowest colour that none of its neighbours has yet; -1 for fixed particles.
/// Pieces of consecutive particles are coloured in threads. Then a particle gets another colour if a neighbour in an
/// earlier piece has its own.
std::vector<int> colorParticles(
  const Buffer<Patch>& patches, const SeenLists& lists, const ParallelFor& parallelFor)
{
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

/// Gives each tile the lowest colour that no neighbouring tile has yet: one with a neighbour of its particles.
/// \param tileSize number of particles of each tile, in their order
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

/// Particles and their neighbours as the kernel of the sweeps (Kernels.h) needs them: in single precision, relative to
/// a common centre.
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

  /// Moves every particle a number of times, stage by stage.
  void sweep(int times, const std::function<void(double share)>& reached)
  {
    const int stages = static_cast<int>(this->Stages.size());
    for (int first = 0; first < times * stages;)
    {
      std::ptrdiff_t blocks = 0;
      int last = first;
      for (; last < times * stages && blocks <= Pieces::BlocksAtOnce; ++last)
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
  Grouping groupByTileAndColor(std::size_t tileSize, std::size_t& colorCount) const;
  void startGroups(const Grouping& groups, std::size_t groupCount);
  void placeInBlock(std::size_t b, const Grouping& groups);
  void fillBlocks();
  void fillLane(int particle, SweepBlock& block, int lane);
  void makeStages(std::size_t tileSize, std::size_t groupsPerTile);
  void runStages(int first, int last);

  const Buffer<Patch>& Patches;
  float Farthest;
  const ParallelFor& Parallel;
  SpacedPoints Points;
  SeenLists Lists;
  /// One a particle. One more, out of the range of all others, stands in for the neighbours that are missing in a
  /// block.
  Buffer<Seen> SeenParticles;
  Buffer<SweepBlock> Blocks;
  /// SweepLanes times the block plus the lane of each particle that moves.
  Buffer<int> LaneOf;
  /// Index of the first block of each group: the particles of one tile and colour have consecutive blocks.
  std::vector<std::ptrdiff_t> GroupStart{ 0 };
  /// Ranges of blocks that may move at the same time. Ranges are dealt out to threads; within one its blocks move one
  /// after the other.
  std::vector<std::vector<BlockRange>> Stages;
  Buffer<std::int32_t> Neighbors;
};

/// Runs the stages first to last - 1 of the endlessly repeated sequence of all stages.
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
  // Farther than the extent of all particles, and than any range.
  beyond.position[0] = static_cast<float>(4.0 * glm::distance(bounds.lower, bounds.upper)) +
    100.0f / beyond.inverseSpacing;
}

/// The origin of each particle's position in single precision: one for all, or one for each connected group of
/// particles where the extent of all is too large for single precision.
std::vector<glm::dvec3> SweepSystem::centersOfGroups(const Bounds& bounds) const
{
  const float smallest =
    *std::min_element(this->Points.spacings.begin(), this->Points.spacings.end());
  if (glm::distance(bounds.lower, bounds.upper) <= largestExtent * static_cast<double>(smallest))
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

/// Sorts particles by the number of their neighbours, as the lists of a block are filled up to the longest of them.
/// Particles move by a few blocks at most, so that neighbours stay near each other in memory.
void SweepSystem::sortByNeighbors(int* begin, int* end) const
{
  // Particles that are sorted at a time. Chosen by experiment; it changes the time, and the order in which particles
  // move.
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

/// Makes the blocks, of particles of one colour each, with room for their lists. Where there are many particles, the
/// blocks of a tile follow each other, colour by colour.
void SweepSystem::layOut()
{
  const std::size_t count = this->Patches.size();
  const std::size_t tileSize = count < Tiles::LeastParticles ? count : Tiles::Particles;
  std::size_t colorCount = 0;
  Grouping groups = this->groupByTileAndColor(tileSize, colorCount);
  const std::size_t groupCount = (count + tileSize - 1) / tileSize * colorCount;
  forAll(this->Parallel, groupCount,
    [&](std::size_t g)
    {
      this->sortByNeighbors(
        groups.order.data() + groups.start[g], groups.order.data() + groups.start[g + 1]);
    });
  this->startGroups(groups, groupCount);
  this->makeStages(tileSize, colorCount);
  this->Blocks = Buffer<SweepBlock>(this->GroupStart.back());
  this->LaneOf = Buffer<int>(count);
  forAll(
    this->Parallel, this->Blocks.size(), [&](std::size_t b) { this->placeInBlock(b, groups); });
}

/// Groups of the particles of one tile and colour, tile by tile; the last group holds the fixed particles.
/// \param colorCount gets the number of colours
Grouping SweepSystem::groupByTileAndColor(std::size_t tileSize, std::size_t& colorCount) const
{
  const std::size_t count = this->Patches.size();
  std::vector<int> groupOf = colorParticles(this->Patches, this->Lists, this->Parallel);
  const std::size_t colors =
    static_cast<std::size_t>(*std::max_element(groupOf.begin(), groupOf.end()) + 1);
  const std::size_t fixedGroup = (count + tileSize - 1) / tileSize * colors;
  forAll(this->Parallel, count,
    [&](std::size_t i)
    {
      groupOf[i] =
        static_cast<int>(groupOf[i] < 0 ? fixedGroup : i / tileSize * colors + groupOf[i]);
    });
  colorCount = colors;
  return groupedBy(
    groupOf, fixedGroup + 1, [](int group) { return group; }, this->Parallel);
}

void SweepSystem::startGroups(const Grouping& groups, std::size_t groupCount)
{
  for (std::size_t g = 0; g < groupCount; ++g)
  {
    const int particles = groups.start[g + 1] - groups.start[g];
    this->GroupStart.push_back(this->GroupStart.back() + (particles + SweepLanes - 1) / SweepLanes);
  }
}

/// Puts the particles of a block into its lanes, and finds the length of its lists.
void SweepSystem::placeInBlock(std::size_t b, const Grouping& groups)
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
}

/// One tile has a stage for each colour of particles; several tiles have a stage for each colour of tiles.
void SweepSystem::makeStages(std::size_t tileSize, std::size_t groupsPerTile)
{
  const std::size_t groups = this->GroupStart.size() - 1;
  if (groups <= groupsPerTile)
  {
    for (std::size_t color = 0; color < groups; ++color)
    {
      this->Stages.emplace_back();
      const std::ptrdiff_t end = this->GroupStart[color + 1];
      for (std::ptrdiff_t b = this->GroupStart[color]; b < end; b += Pieces::Blocks)
      {
        this->Stages.back().push_back({ b, std::min(end, b + Pieces::Blocks) });
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

/// Fills the blocks particle by particle, in the order in which these lie in memory: few blocks are written at a time.
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
        // The last particle of a block fills the lanes that are left over, too.
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
  block.relaxation[lane] = std::max(Overrelaxation::Bent,
    Overrelaxation::Flat - std::max(0.0f, bend * patch.spacing - Overrelaxation::FlatBend));
  block.farthest[lane] =
    std::min(this->Farthest * patch.spacing, farthestPerRadius / std::max(bend, smallestCurvature));
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
