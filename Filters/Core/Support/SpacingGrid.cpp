#include "Support/SpacingGrid.h"

#include "Support/SeenPoints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hop
{
namespace
{

constexpr std::int64_t cellsPerAxis = std::int64_t{ 1 } << SpacingGrid::BitsPerAxis;
/// A key has four bits for its level. The last level takes all larger spacings, too.
constexpr int maximumLevels = 15;

} // namespace

SpacingGrid::SpacingGrid(Span<glm::dvec3> positions, Span<float> spacings, double reach,
  double cellsPerReach, const ParallelFor& parallelFor)
  : Positions(positions)
  , Spacings(spacings)
  , Reach(reach)
{
  if (!positions.empty())
  {
    this->chooseCellSizes(cellsPerReach, parallelFor);
    this->fillSlots(parallelFor);
    this->sortPoints();
  }
}

void SpacingGrid::chooseCellSizes(double cellsPerReach, const ParallelFor& parallelFor)
{
  const auto [smallest, largest] =
    std::minmax_element(this->Spacings.begin(), this->Spacings.end());
  this->SmallestSpacing = *smallest;
  const double largestSpacing = *largest;
  this->LevelCount = maximumLevels;
  this->LevelCount = this->levelOf(largestSpacing) + 1;
  const Bounds bounds = boundsOf(this->Positions, parallelFor);
  this->Origin = bounds.lower;
  const glm::dvec3 extent = bounds.upper - bounds.lower;
  constexpr double tiniest = std::numeric_limits<double>::min();
  // Cells of the bounds have numbers that a key can hold; there are more on either side, for queries from outside.
  constexpr std::int64_t outside = 4;
  const double smallestCell =
    std::max({ extent.x, extent.y, extent.z }) / static_cast<double>(cellsPerAxis - outside);
  for (int level = 0; level < this->LevelCount; ++level)
  {
    const double highest = std::ldexp(this->SmallestSpacing, level + 1);
    const bool isLast = level == this->LevelCount - 1;
    const double spacing = this->LevelCount == 1 ? largestSpacing
      : isLast                                   ? std::max(highest, largestSpacing)
                                                 : highest;
    this->LargestSpacings.push_back(spacing);
    this->CellsPerLength.push_back(
      1.0 / std::max({ this->Reach * spacing / cellsPerReach, smallestCell, tiniest }));
  }
}

/// Gives each point's cell a slot. No slot has points yet.
void SpacingGrid::fillSlots(const ParallelFor& parallelFor)
{
  // A block of cells at least, and three slots for two points, so that a cell is found after few steps even if each
  // point has a cell of its own. More slots would cost memory that is read in vain.
  this->SlotCount = 64;
  while (2 * this->SlotCount < 3 * this->Positions.size())
  {
    this->SlotCount *= 2;
  }
  this->Keys.reset(new std::atomic<std::uint64_t>[this->SlotCount]);
  this->SlotStart = Buffer<int>(this->SlotCount + 1);
  this->SlotStart.back() = 0;
  forAll(parallelFor, this->SlotCount,
    [this](std::size_t slot)
    {
      this->Keys[slot].store(0, std::memory_order_relaxed);
      this->SlotStart[slot] = 0;
    });
  this->SlotOfPoint = Buffer<int>(this->Positions.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Positions.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::uint64_t previous = 0;
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        const int level = this->levelOf(this->Spacings[i]);
        const std::uint64_t key = keyOf(this->cellOf(this->Positions[i], level), level);
        // Neighbours in memory often share a cell.
        this->SlotOfPoint[i] =
          key == previous ? this->SlotOfPoint[i - 1] : static_cast<int>(this->findOrAdd(key));
        previous = key;
      }
    });
}

/// Counting sort by slot, from the last point to the first: what was the end of a slot becomes its start.
void SpacingGrid::sortPoints()
{
  for (const int slot : this->SlotOfPoint)
  {
    ++this->SlotStart[slot];
  }
  std::partial_sum(this->SlotStart.begin(), this->SlotStart.end(), this->SlotStart.begin());
  this->Order = Buffer<int>(this->Positions.size());
  for (std::size_t i = this->Positions.size(); i-- > 0;)
  {
    this->Order[--this->SlotStart[this->SlotOfPoint[i]]] = static_cast<int>(i);
  }
}

int SpacingGrid::levelOf(double spacing) const
{
  const int level =
    spacing > this->SmallestSpacing ? std::ilogb(spacing / this->SmallestSpacing) : 0;
  return std::min(level, std::max(0, this->LevelCount - 1));
}

SpacingGrid::Cell SpacingGrid::cellOf(const glm::dvec3& position, int level) const
{
  // Queries may ask for cell 0, just outside of the bounds. Numbers are not negative, so that truncation is floor.
  const glm::dvec3 cell = (position - this->Origin) * this->CellsPerLength[level] + 1.0;
  return Cell(glm::min(glm::max(cell, 0.0), static_cast<double>(cellsPerAxis - 1)));
}

std::uint64_t SpacingGrid::keyOf(const Cell& cell, int level)
{
  const glm::u64vec3 c(cell);
  return (static_cast<std::uint64_t>(level) << (3 * BitsPerAxis)) | (c.z << (2 * BitsPerAxis)) |
    (c.y << BitsPerAxis) | c.x;
}

std::size_t SpacingGrid::findOrAdd(std::uint64_t key)
{
  for (std::size_t slot = this->firstSlotOf(key);; slot = this->nextSlot(slot))
  {
    std::uint64_t found = this->Keys[slot].load(std::memory_order_relaxed);
    const bool taken =
      found == 0 && this->Keys[slot].compare_exchange_strong(found, key, std::memory_order_relaxed);
    if (taken || found == key)
    {
      return slot;
    }
  }
}

SeenLists::SeenLists(
  Span<glm::dvec3> positions, Span<float> spacings, double reach, const ParallelFor& parallelFor)
{
  const SpacingGrid grid(positions, spacings, reach, 1.0, parallelFor);
  // Lists of so many points stand in one array, which one thread fills. Fewer points would make many small arrays; more
  // would leave threads waiting for each other. Chosen by experiment.
  constexpr std::size_t pointsPerChunk = 256;
  this->Places.resize(positions.size());
  this->Chunks.resize((positions.size() + pointsPerChunk - 1) / pointsPerChunk);

  Buffer<double> inverse(positions.size());
  forAll(parallelFor, inverse.size(), [&](std::size_t i) { inverse[i] = 1.0 / spacings[i]; });
  const auto fillChunk = [&](std::size_t chunk, SeenPoints& finder)
  {
    std::vector<int>& lists = this->Chunks[chunk];
    std::size_t used = 0;
    const std::size_t end = std::min(positions.size(), (chunk + 1) * pointsPerChunk);
    for (std::size_t first = chunk * pointsPerChunk; first < end; ++first)
    {
      // A cell is looked at once, when its first point comes.
      const SpacingGrid::Points points = grid.cellMates(static_cast<int>(first));
      if (*points.begin() != static_cast<int>(first))
      {
        continue;
      }
      finder.lookAround(points);
      for (const int i : points)
      {
        lists.resize(std::max(lists.size(), used + finder.most()));
        int* list = lists.data() + used;
        const int* listEnd = finder.list(i, list);
        this->Places[i] = { static_cast<int>(chunk), static_cast<int>(used),
          static_cast<int>(listEnd - list) };
        used += listEnd - list;
      }
    }
    lists.resize(used);
  };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Chunks.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      SeenPoints finder(grid, positions, inverse, reach);
      for (std::ptrdiff_t chunk = begin; chunk < end; ++chunk)
      {
        fillChunk(chunk, finder);
      }
    });
}

} // namespace hop
