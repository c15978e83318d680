#include "SpacingGrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hop
{
namespace
{

constexpr int bitsPerAxis = 20;
constexpr std::int64_t cellsPerAxis = std::int64_t{ 1 } << bitsPerAxis;
/// Levels have four bits of a key.
constexpr int maximumLevels = 15;

std::size_t slotOf(std::uint64_t key, std::size_t mask)
{
  key *= 0x9e3779b97f4a7c15ULL;
  return static_cast<std::size_t>(key ^ (key >> 32)) & mask;
}

} // namespace

SpacingGrid::SpacingGrid(const std::vector<glm::dvec3>& positions,
  const std::vector<float>& spacings, double reach, double cellsPerReach,
  const ParallelFor& parallelFor)
  : Positions(positions)
  , Spacings(spacings)
  , Reach(reach)
{
  this->CellStart.push_back(0);
  if (positions.empty())
  {
    return;
  }
  const auto [smallest, largest] = std::minmax_element(spacings.begin(), spacings.end());
  this->SmallestSpacing = *smallest;
  const double largestSpacing = *largest;
  this->LevelCount = maximumLevels;
  this->LevelCount = this->levelOf(largestSpacing) + 1;
  glm::dvec3 upper = this->Origin = positions.front();
  for (const glm::dvec3& p : positions)
  {
    this->Origin = glm::min(this->Origin, p);
    upper = glm::max(upper, p);
  }
  const glm::dvec3 extent = upper - this->Origin;
  const double smallestCell = std::max({ extent.x, extent.y, extent.z }) / (cellsPerAxis - 4);
  for (int level = 0; level < this->LevelCount; ++level)
  {
    this->CellSizes.push_back(
      std::max(reach * std::ldexp(this->SmallestSpacing, level + 1) / cellsPerReach, smallestCell));
    this->LargestSpacings.push_back(std::ldexp(this->SmallestSpacing, level + 1));
  }
  if (this->LevelCount == 1)
  {
    this->LargestSpacings[0] = largestSpacing;
    this->CellSizes[0] = std::max(reach * largestSpacing / cellsPerReach, smallestCell);
  }

  std::size_t slots = 64;
  while (slots < positions.size())
  {
    slots *= 2;
  }
  this->Slots.assign(slots, { 0, -1 });
  std::vector<std::uint64_t> keys(positions.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(positions.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        const int level = this->levelOf(spacings[i]);
        keys[i] = keyOf(this->cellOf(positions[i], level), level);
      }
    });
  std::vector<int> cells(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    // Neighbours in memory often share a cell.
    cells[i] = i > 0 && keys[i] == keys[i - 1] ? cells[i - 1] : this->findOrAdd(keys[i]);
    ++this->CellStart[cells[i] + 1];
  }
  std::partial_sum(this->CellStart.begin(), this->CellStart.end(), this->CellStart.begin());
  std::vector<int> next(this->CellStart.begin(), this->CellStart.end() - 1);
  this->Order.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    this->Order[next[cells[i]]++] = static_cast<int>(i);
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
  const glm::dvec3 cell = glm::floor((position - this->Origin) / this->CellSizes[level]);
  return Cell(glm::clamp(cell, -1.0, static_cast<double>(cellsPerAxis - 2)));
}

std::uint64_t SpacingGrid::keyOf(const Cell& cell, int level)
{
  // Cell -1, just outside, exists for queries; shifted by one it is a key like any other.
  const glm::u64vec3 c(cell + std::int64_t{ 1 });
  return (static_cast<std::uint64_t>(level) << (3 * bitsPerAxis)) | (c.z << (2 * bitsPerAxis)) |
    (c.y << bitsPerAxis) | c.x;
}

int SpacingGrid::find(std::uint64_t key) const
{
  const std::size_t mask = this->Slots.size() - 1;
  for (std::size_t slot = slotOf(key, mask);; slot = (slot + 1) & mask)
  {
    if (this->Slots[slot].second < 0 || this->Slots[slot].first == key)
    {
      return this->Slots[slot].second;
    }
  }
}

int SpacingGrid::findOrAdd(std::uint64_t key)
{
  const int found = this->find(key);
  if (found >= 0)
  {
    return found;
  }
  const int added = static_cast<int>(this->CellStart.size()) - 1;
  this->CellStart.push_back(0);
  if (2 * this->CellStart.size() > this->Slots.size())
  {
    std::vector<std::pair<std::uint64_t, int>> old(2 * this->Slots.size(), { 0, -1 });
    old.swap(this->Slots);
    for (const auto& [oldKey, cell] : old)
    {
      if (cell >= 0)
      {
        this->place(oldKey, cell);
      }
    }
  }
  this->place(key, added);
  return added;
}

void SpacingGrid::place(std::uint64_t key, int cell)
{
  const std::size_t mask = this->Slots.size() - 1;
  std::size_t slot = slotOf(key, mask);
  while (this->Slots[slot].second >= 0)
  {
    slot = (slot + 1) & mask;
  }
  this->Slots[slot] = { key, cell };
}

SeenLists::SeenLists(const std::vector<glm::dvec3>& positions, const std::vector<float>& spacings,
  double reach, const ParallelFor& parallelFor)
{
  const SpacingGrid grid(positions, spacings, reach, 1.0, parallelFor);
  const auto& cellStart = grid.cellStart();
  const auto& order = grid.order();
  constexpr std::ptrdiff_t cellsPerChunk = 64;
  const auto cellCount = static_cast<std::ptrdiff_t>(cellStart.size()) - 1;
  this->Places.resize(positions.size());
  this->Chunks.resize((cellCount + cellsPerChunk - 1) / cellsPerChunk);

  // Two points see each other if d <= 2 reach/(1/h_i + 1/h_j): the same sum for both, so that either
  // both see each other or neither.
  struct Candidate
  {
    glm::dvec3 position;
    double inverseSpacing;
    int index;
  };
  const auto fillChunk = [&](std::ptrdiff_t chunk, std::vector<Candidate>& candidates)
  {
    std::vector<int>& lists = this->Chunks[chunk];
    std::size_t used = 0;
    const std::ptrdiff_t end = std::min(cellCount, (chunk + 1) * cellsPerChunk);
    for (std::ptrdiff_t cell = chunk * cellsPerChunk; cell < end; ++cell)
    {
      candidates.clear();
      grid.visitAround(static_cast<int>(cell),
        [&](int j) {
          candidates.push_back({ positions[j], 1.0 / spacings[j], j });
        });
      for (int n = cellStart[cell]; n < cellStart[cell + 1]; ++n)
      {
        const int i = order[n];
        const glm::dvec3 position = positions[i];
        const double inverseSpacing = 1.0 / spacings[i];
        const std::size_t first = used;
        lists.resize(std::max(lists.size(), used + candidates.size()));
        int* list = lists.data();
        for (const Candidate& c : candidates)
        {
          const glm::dvec3 d = c.position - position;
          const double sum = c.inverseSpacing + inverseSpacing;
          // Without a branch: nearly half of the candidates are neighbours.
          list[used] = c.index;
          used += (glm::dot(d, d) * (sum * sum) <= 4.0 * reach * reach) & (c.index != i);
        }
        this->Places[i] = { static_cast<int>(chunk), static_cast<int>(first),
          static_cast<int>(used - first) };
      }
    }
    lists.resize(used);
  };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Chunks.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::vector<Candidate> candidates;
      for (std::ptrdiff_t chunk = begin; chunk < end; ++chunk)
      {
        fillChunk(chunk, candidates);
      }
    });
}

} // namespace hop
