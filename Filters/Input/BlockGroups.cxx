#include "Input/BlockGroups.h"

#include "Input/VtkCompatibility.h"
#include "Support/SortedBy.h"

#include "vtkBoundingBox.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <tuple>
#include <utility>

namespace hop
{

namespace
{

/// Blocks in ascending order.
using Members = std::vector<std::size_t>;

/// A cell's block, and its place: the mean of its first points, the corners among them. Copies of a cell have the same
/// place to the last bit; different cells of one sound grid have different places.
struct PlacedCell
{
  std::array<double, 3> place{};
  std::size_t block = 0;

  bool operator<(const PlacedCell& other) const
  {
    return std::tie(this->place, this->block) < std::tie(other.place, other.block);
  }
  std::size_t hash() const
  {
    std::size_t sum = 0;
    for (const double x : this->place)
    {
      sum = 31 * sum + std::hash<double>()(x); // an odd factor, as usual in polynomial hashes
    }
    return sum;
  }
};

/// Tells which types of cells have a volume.
class SolidTypes
{
public:
  bool contains(int type)
  {
    const auto [known, isNew] = this->Known.try_emplace(type, false);
    const auto cell =
      vtk::TakeSmartPointer(isNew ? vtkGenericCell::InstantiateCell(type) : nullptr);
    known->second = known->second || (cell && cell->GetCellDimension() == 3);
    return known->second;
  }

private:
  std::map<int, bool> Known;
};

/// Finds the cells that several blocks have in common.
class SharedCells
{
public:
  SharedCells(const InputBlocks& blocks, const ParallelFor& parallelFor);

  /// The sets of blocks that have a cell in common; each set once.
  std::set<Members> find() const;

private:
  std::vector<PlacedCell> placeCells() const;
  std::array<double, 3> middleOf(const BlockCell& where, vtkIdList* room) const;
  bool othersReach(std::size_t block, const std::array<double, 3>& place) const;

  const InputBlocks& Blocks;
  const ParallelFor& Parallel;
  /// For each block, the bounds of the other blocks that overlap it: it can share cells only there.
  std::vector<std::vector<vtkBoundingBox>> Others;
  std::vector<vtkUnsignedCharArray*> Ghosts;
};

SharedCells::SharedCells(const InputBlocks& blocks, const ParallelFor& parallelFor)
  : Blocks(blocks)
  , Parallel(parallelFor)
  , Others(blocks.size())
{
  std::vector<vtkBoundingBox> bounds;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    this->Ghosts.push_back(blocks[b].grid->GetCellGhostArray());
    bounds.push_back(finiteBounds(blocks[b].grid));
    for (std::size_t other = 0; other < b; ++other)
    {
      if (bounds[b].Intersects(bounds[other]))
      {
        this->Others[b].push_back(bounds[other]);
        this->Others[other].push_back(bounds[b]);
      }
    }
  }
}

/// The place of a cell; NaN where it has no points or one of them is not in the grid.
std::array<double, 3> SharedCells::middleOf(const BlockCell& where, vtkIdList* room) const
{
  constexpr vtkIdType mostCorners = 8; // of a hexahedron; VTK lists the corners of a cell first
  vtkUnstructuredGrid* grid = this->Blocks[where.block].grid;
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  cellPoints(grid->GetCells(), where.cell, count, ids, room);
  count = std::min(count, mostCorners);
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 3> middle;
  middle.fill(count > 0 ? 0.0 : nowhere);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    std::fill_n(x, 3, nowhere);
    if (ids[i] >= 0 && ids[i] < grid->GetNumberOfPoints())
    {
      grid->GetPoint(ids[i], x);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      middle[axis] += x[axis] / static_cast<double>(count);
    }
  }
  return middle;
}

/// Whether the bounds of another block hold the place of a cell.
bool SharedCells::othersReach(std::size_t block, const std::array<double, 3>& place) const
{
  const std::vector<vtkBoundingBox>& others = this->Others[block];
  return std::all_of(place.begin(), place.end(), [](double x) { return std::isfinite(x); }) &&
    std::any_of(others.begin(), others.end(),
      [&](const vtkBoundingBox& box) { return box.ContainsPoint(place.data()) != 0; });
}

/// The cells that may have copies in other blocks: cells with a volume that their block owns, in any order.
std::vector<PlacedCell> SharedCells::placeCells() const
{
  std::vector<PlacedCell> cells;
  std::mutex access;
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(this->Blocks.cellCount()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::vector<PlacedCell> found;
      SolidTypes solid;
      vtkNew<vtkIdList> room;
      for (std::ptrdiff_t number = begin; number < end; ++number)
      {
        const BlockCell where = this->Blocks.locate(number);
        if (!this->Others[where.block].empty() &&
          !isGhostCell(this->Ghosts[where.block], where.cell) &&
          solid.contains(this->Blocks[where.block].grid->GetCellType(where.cell)))
        {
          const PlacedCell cell{ this->middleOf(where, room), where.block };
          if (this->othersReach(cell.block, cell.place))
          {
            found.push_back(cell);
          }
        }
      }
      const std::lock_guard<std::mutex> lock(access);
      cells.insert(cells.end(), found.begin(), found.end());
    });
  return cells;
}

/// Sorts cells by place and adds, for every place, the set of blocks that have a cell there.
template <class Iterator>
void addSets(Iterator first, Iterator last, std::set<Members>& sets)
{
  std::sort(first, last);
  while (first != last)
  {
    Members members;
    const std::array<double, 3> place = first->place;
    for (; first != last && first->place == place; ++first)
    {
      // All cells of a block are in one place where coordinates were never written.
      if (members.empty() || members.back() != first->block)
      {
        members.push_back(first->block);
      }
    }
    if (members.size() > 1)
    {
      sets.insert(members);
    }
  }
}

std::set<Members> SharedCells::find() const
{
  // Mean number of cells that are sorted together; chosen by experiment. Fewer need more memory for bins, more make
  // sorting slower and leave less work to other threads.
  constexpr std::size_t cellsPerBin = 16;
  const std::vector<PlacedCell> cells = this->placeCells();
  const std::size_t bins = cells.size() / cellsPerBin + 1;
  const Grouping binned = groupedBy(
    cells, bins, [bins](const PlacedCell& cell) { return cell.hash() % bins; }, this->Parallel);
  std::set<Members> sets;
  std::mutex access;
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(bins),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::set<Members> found;
      std::vector<PlacedCell> bin;
      for (std::ptrdiff_t b = begin; b < end; ++b)
      {
        bin.clear();
        for (int n = binned.start[b]; n < binned.start[b + 1]; ++n)
        {
          bin.push_back(cells[binned.order[n]]);
        }
        addSets(bin.begin(), bin.end(), found);
      }
      const std::lock_guard<std::mutex> lock(access);
      sets.merge(found);
    });
  return sets;
}

} // namespace

BlockPairs blocksThatShareCells(const InputBlocks& blocks, const ParallelFor& parallelFor)
{
  BlockPairs pairs;
  for (const Members& members : SharedCells(blocks, parallelFor).find())
  {
    for (auto first = members.begin(); first != members.end(); ++first)
    {
      std::for_each(first + 1, members.end(),
        [&](std::size_t other) {
          pairs.insert(std::minmax({ blocks[*first].number, blocks[other].number }));
        });
    }
  }
  return pairs;
}

std::vector<std::set<int>> groupsWithoutSharedCells(
  const std::set<int>& numbers, const BlockPairs& sharing)
{
  std::vector<std::set<int>> groups;
  for (const int number : numbers)
  {
    const auto isFree = [&](const std::set<int>& group)
    {
      return std::none_of(group.begin(), group.end(),
        [&](int member) {
          return sharing.count({ member, number }) > 0;
        });
    };
    auto group = std::find_if(groups.begin(), groups.end(), isFree);
    if (group == groups.end())
    {
      group = groups.insert(groups.end(), std::set<int>());
    }
    group->insert(number);
  }
  return groups;
}

InputBlocks blocksOfGroup(const InputBlocks& blocks, const std::set<int>& group)
{
  std::vector<InputBlock> members;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    if (group.count(blocks[b].number) > 0)
    {
      members.push_back(blocks[b]);
    }
  }
  return { std::move(members), blocks.component(), blocks.quantity(), blocks.expression() };
}

} // namespace hop
