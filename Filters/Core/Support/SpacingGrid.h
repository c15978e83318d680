#pragma once

#include "Support/Bounds.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace hop
{

/// Finds which points see each other when each has a spacing h of its own and two points interact within `reach` times
/// the harmonic mean of their spacings.
///
/// Points are sorted into cubic cells, by levels: points of level l have spacings in [2^l, 2^(l+1)) times the
/// smallest, and their cells are `reach` times the largest of these spacings wide, or wider. Spacings of points that
/// see each other are taken to differ by less than a factor of two (the gradation of SurfaceProxy.h ensures that), so
/// that three levels are looked at.
class SpacingGrid
{
public:
  /// \param reach > 0
  /// \param cellsPerReach 1 is good for visiting whole cells; a half, for wider cells, is good for single points, which
  ///   then look into fewer cells
  /// \pre as many spacings as points, all > 0; positions and spacings outlive the grid
  SpacingGrid(Span<glm::dvec3> positions, Span<float> spacings, double reach,
    double cellsPerReach = 1.0, const ParallelFor& parallelFor = {});

  /// Calls use(j) for every point that a point at `position` with that spacing would see, and for some farther off, in
  /// a fixed order. The caller tests.
  template <class Use>
  void visit(const glm::dvec3& position, double spacing, const Use& use) const;

  /// The points of a cell, ascending.
  struct Points
  {
    const int* First;
    const int* Last;

    const int* begin() const { return this->First; }
    const int* end() const { return this->Last; }
  };

  /// All points in the cell of a point, itself included.
  Points cellMates(int point) const { return this->pointsIn(this->SlotOfPoint[point]); }

  /// visit() for all points of a cell at once.
  template <class Use>
  void visitAround(const Points& points, const Use& use) const;

  /// Bits of a cell's key for each coordinate. Three times this and four bits for the level make up 64.
  static constexpr int BitsPerAxis = 20;

private:
  using Cell = glm::i64vec3;

  void chooseCellSizes(double cellsPerReach, const ParallelFor& parallelFor);
  void fillSlots(const ParallelFor& parallelFor);
  void sortPoints();
  int levelOf(double spacing) const;
  Cell cellOf(const glm::dvec3& position, int level) const;
  static std::uint64_t keyOf(const Cell& cell, int level);
  std::size_t firstSlotOf(std::uint64_t key) const;
  std::size_t nextSlot(std::size_t slot) const { return (slot + 1) & (this->SlotCount - 1); }
  Points find(std::uint64_t key) const;
  std::size_t findOrAdd(std::uint64_t key);
  Points pointsIn(std::size_t slot) const
  {
    const int* points = this->Order.data();
    return { points + this->SlotStart[slot], points + this->SlotStart[slot + 1] };
  }
  template <class Use>
  void visitLevel(
    int level, const glm::dvec3& lower, const glm::dvec3& upper, const Use& use) const;
  template <class Use>
  void visitBox(const glm::dvec3& lower, const glm::dvec3& upper, double spacing, int level,
    const Use& use) const;

  Span<glm::dvec3> Positions;
  Span<float> Spacings;
  double Reach;
  double SmallestSpacing = 1.0;
  int LevelCount = 0;
  glm::dvec3 Origin{ 0.0 };
  std::vector<double> CellsPerLength;
  std::vector<double> LargestSpacings;
  /// A hash table with open addressing: the key of the cell in each slot, 0 where there is none. Which slot a cell gets
  /// may depend on threads, but no visit depends on that.
  std::unique_ptr<std::atomic<std::uint64_t>[]> Keys;
  std::size_t SlotCount = 0;
  Buffer<int> SlotOfPoint;
  /// The cell in slot s holds the points Order[n], ascending, SlotStart[s] <= n < SlotStart[s + 1].
  Buffer<int> SlotStart;
  Buffer<int> Order;
};

/// The points that each point sees, in lists whose order is fixed.
class SeenLists
{
public:
  /// \param reach two points see each other within this times the harmonic mean of their spacings
  SeenLists(
    Span<glm::dvec3> positions, Span<float> spacings, double reach, const ParallelFor& parallelFor);

  const int* begin(std::size_t i) const
  {
    const Place& place = this->Places[i];
    return this->Chunks[place.chunk].data() + place.first;
  }
  const int* end(std::size_t i) const { return this->begin(i) + this->Places[i].count; }
  int count(std::size_t i) const { return this->Places[i].count; }
  std::size_t size() const { return this->Places.size(); }

private:
  struct Place
  {
    int chunk = 0;
    int first = 0;
    int count = 0;
  };
  std::vector<Place> Places;
  std::vector<std::vector<int>> Chunks;
};

/// Cells of a block of 4 x 4 x 4 have slots next to each other, as they are looked at together.
inline std::size_t SpacingGrid::firstSlotOf(std::uint64_t key) const
{
  constexpr std::uint64_t low = 3;
  constexpr std::uint64_t inBlock = low | (low << BitsPerAxis) | (low << (2 * BitsPerAxis));
  const std::uint64_t cell = (key & low) | ((key >> (BitsPerAxis - 2)) & (low << 2)) |
    ((key >> (2 * BitsPerAxis - 4)) & (low << 4));
  // 2^64 over the golden ratio (VectorHash.h). Multiplied twice: the upper bits of a product depend on all bits of its
  // factors, the lower ones on few.
  std::uint64_t block = (key & ~inBlock) * 0x9e3779b97f4a7c15ULL;
  block = (block ^ (block >> 32)) * 0x9e3779b97f4a7c15ULL;
  return static_cast<std::size_t>(((block >> 32) << 6) + cell) & (this->SlotCount - 1);
}

inline SpacingGrid::Points SpacingGrid::find(std::uint64_t key) const
{
  for (std::size_t slot = this->firstSlotOf(key);; slot = this->nextSlot(slot))
  {
    const std::uint64_t found = this->Keys[slot].load(std::memory_order_relaxed);
    if (found == key)
    {
      return this->pointsIn(slot);
    }
    if (found == 0)
    {
      return { nullptr, nullptr };
    }
  }
}

template <class Use>
void SpacingGrid::visitLevel(
  int level, const glm::dvec3& lower, const glm::dvec3& upper, const Use& use) const
{
  const Cell first = this->cellOf(lower, level);
  const Cell last = this->cellOf(upper, level);
  for (auto z = first.z; z <= last.z; ++z)
  {
    for (auto y = first.y; y <= last.y; ++y)
    {
      std::uint64_t key = keyOf({ first.x, y, z }, level);
      for (auto x = first.x; x <= last.x; ++x, ++key)
      {
        for (const int point : this->find(key))
        {
          use(point);
        }
      }
    }
  }
}

template <class Use>
void SpacingGrid::visitBox(const glm::dvec3& lower, const glm::dvec3& upper, double spacing,
  int ownLevel, const Use& use) const
{
  for (int level = std::max(0, ownLevel - 1); level <= ownLevel + 1 && level < this->LevelCount;
       ++level)
  {
    // Harmonic mean of the spacing and the largest one of the level.
    const double largest = this->LargestSpacings[level];
    const double radius = this->Reach * 2.0 * spacing * largest / (spacing + largest);
    this->visitLevel(level, lower - radius, upper + radius, use);
  }
}

template <class Use>
void SpacingGrid::visit(const glm::dvec3& position, double spacing, const Use& use) const
{
  if (this->LevelCount > 0)
  {
    this->visitBox(position, position, spacing, this->levelOf(spacing), use);
  }
}

template <class Use>
void SpacingGrid::visitAround(const Points& points, const Use& use) const
{
  // The bounds of the points are tighter than those of the cell: a surface fills a slice of it.
  glm::dvec3 lower = this->Positions[*points.begin()];
  glm::dvec3 upper = lower;
  double spacing = 0.0;
  for (const int p : points)
  {
    lower = glm::min(lower, this->Positions[p]);
    upper = glm::max(upper, this->Positions[p]);
    spacing = std::max<double>(spacing, this->Spacings[p]);
  }
  this->visitBox(lower, upper, spacing, this->levelOf(this->Spacings[*points.begin()]), use);
}

} // namespace hop
