#pragma once

#include "Monitor.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace hop
{

/// Finds which points see each other when each has a spacing h of its own and two of them interact
/// within `reach` times the harmonic mean of theirs.
///
/// Points are sorted into cubic cells, by levels: those of level l have spacings in
/// [2^l, 2^(l+1)) times the smallest, and cells of `reach` times the largest of these or more. Spacings of
/// points that see each other are taken to differ by less than a factor of two (SurfaceProxy.h grades
/// them so), so that three levels are looked at.
class SpacingGrid
{
public:
  /// \param reach > 0
  /// \param cellsPerReach one: good for visiting whole cells; a half: for single points, which then
  ///   look into fewer cells
  /// \pre as many spacings as points, all > 0; positions and spacings outlive the grid
  SpacingGrid(const std::vector<glm::dvec3>& positions, const std::vector<float>& spacings,
    double reach, double cellsPerReach = 1.0, const ParallelFor& parallelFor = {});

  /// Calls use(j) for every point that may be within reach of a point at `position` with that
  /// spacing, and for some farther off, in a fixed order. The caller tests.
  template <class Use>
  void visit(const glm::dvec3& position, double spacing, const Use& use) const;

  /// Calls use(j) for every point of the same level as `spacing` or a higher one that is within reach
  /// times its own spacing of the position, and for some farther off.
  template <class Use>
  void visitCoarser(const glm::dvec3& position, double spacing, const Use& use) const;

  /// visit() for all points of a cell at once.
  template <class Use>
  void visitAround(int cell, const Use& use) const;

  /// Cell c holds the points order()[n] with cellStart()[c] <= n < cellStart()[c + 1].
  const std::vector<int>& order() const { return this->Order; }
  const std::vector<int>& cellStart() const { return this->CellStart; }

private:
  using Cell = glm::i64vec3;

  int levelOf(double spacing) const;
  Cell cellOf(const glm::dvec3& position, int level) const;
  static std::uint64_t keyOf(const Cell& cell, int level);
  int find(std::uint64_t key) const;
  int findOrAdd(std::uint64_t key);
  void place(std::uint64_t key, int cell);
  template <class Use>
  void visitLevel(
    int level, const glm::dvec3& lower, const glm::dvec3& upper, const Use& use) const;
  template <class Use>
  void visitBox(const glm::dvec3& lower, const glm::dvec3& upper, double spacing, int level,
    const Use& use) const;

  const std::vector<glm::dvec3>& Positions;
  const std::vector<float>& Spacings;
  double Reach;
  double SmallestSpacing = 1.0;
  int LevelCount = 0;
  glm::dvec3 Origin{ 0.0 };
  std::vector<double> CellSizes;
  std::vector<double> LargestSpacings;
  /// Open addressing: key and cell of each slot, cell -1 where it is free.
  std::vector<std::pair<std::uint64_t, int>> Slots;
  std::vector<int> CellStart;
  std::vector<int> Order;
};

/// The points that each point sees, in lists whose order is fixed.
class SeenLists
{
public:
  /// Those within reach times the harmonic mean of the spacings.
  SeenLists(const std::vector<glm::dvec3>& positions, const std::vector<float>& spacings,
    double reach, const ParallelFor& parallelFor);

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
      for (auto x = first.x; x <= last.x; ++x)
      {
        const int cell = this->find(keyOf({ x, y, z }, level));
        for (int n = cell < 0 ? 0 : this->CellStart[cell];
             cell >= 0 && n < this->CellStart[cell + 1]; ++n)
        {
          use(this->Order[n]);
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
void SpacingGrid::visitCoarser(const glm::dvec3& position, double spacing, const Use& use) const
{
  for (int level = this->levelOf(spacing); level < this->LevelCount; ++level)
  {
    const double radius = this->Reach * this->LargestSpacings[level];
    this->visitLevel(level, position - radius, position + radius, use);
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
void SpacingGrid::visitAround(int cell, const Use& use) const
{
  // The bounds of the points are tighter than those of the cell: a surface fills a slice of it.
  const int* points = this->Order.data() + this->CellStart[cell];
  const int* end = this->Order.data() + this->CellStart[cell + 1];
  glm::dvec3 lower = this->Positions[*points];
  glm::dvec3 upper = lower;
  double spacing = 0.0;
  for (const int* p = points; p != end; ++p)
  {
    lower = glm::min(lower, this->Positions[*p]);
    upper = glm::max(upper, this->Positions[*p]);
    spacing = std::max<double>(spacing, this->Spacings[*p]);
  }
  this->visitBox(lower, upper, spacing, this->levelOf(this->Spacings[*points]), use);
}

} // namespace hop
