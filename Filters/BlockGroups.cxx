#include "BlockGroups.h"

#include "VtkCompatibility.h"

#include "vtkCellArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace
{

/// Where a cell of a block is: the sum of its first points, which are its corners. Copies of a grid
/// agree in it to the last bit, and no two cells of one sound grid do.
struct PlacedCell
{
  std::array<double, 3> place{};
  std::size_t block = 0;

  bool operator<(const PlacedCell& other) const
  {
    return std::tie(this->place, this->block) < std::tie(other.place, other.block);
  }
  bool operator==(const PlacedCell& other) const
  {
    return std::tie(this->place, this->block) == std::tie(other.place, other.block);
  }
};

/// Whether cells of a type have a volume.
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

/// The sum of up to eight points; not a number where a point is missing or not finite.
std::array<double, 3> placeOf(vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* room)
{
  constexpr vtkIdType mostCorners = 8;
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  cellPoints(grid->GetCells(), cell, count, ids, room);
  std::array<double, 3> place{};
  for (vtkIdType i = 0; i < std::min(count, mostCorners); ++i)
  {
    double x[3];
    std::fill_n(x, 3, std::numeric_limits<double>::quiet_NaN());
    if (ids[i] >= 0 && ids[i] < grid->GetNumberOfPoints())
    {
      grid->GetPoint(ids[i], x);
    }
    std::transform(place.begin(), place.end(), x, place.begin(), std::plus<>());
  }
  return place;
}

/// All cells with a volume that their block owns, in ascending order of their places; of cells of a block in
/// one place only one, as all may be in one where coordinates were never written.
std::vector<PlacedCell> placeCells(const std::vector<InputBlock>& blocks)
{
  std::vector<PlacedCell> cells;
  SolidTypes solid;
  vtkNew<vtkIdList> room;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    vtkUnstructuredGrid* grid = blocks[b].grid;
    vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      if (!isGhostCell(ghosts, cell) && solid.contains(grid->GetCellType(cell)))
      {
        const std::array<double, 3> place = placeOf(grid, cell, room);
        if (std::all_of(place.begin(), place.end(), [](double x) { return std::isfinite(x); }))
        {
          cells.push_back({ place, b });
        }
      }
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/// Pairs of blocks, the earlier one first, that have a cell in common.
std::set<std::pair<std::size_t, std::size_t>> blocksThatShareCells(
  const std::vector<InputBlock>& blocks)
{
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  const std::vector<PlacedCell> cells = placeCells(blocks);
  for (auto first = cells.begin(); first != cells.end(); ++first)
  {
    for (auto other = first + 1; other != cells.end() && other->place == first->place; ++other)
    {
      pairs.insert({ first->block, other->block });
    }
  }
  return pairs;
}

} // namespace

std::vector<std::vector<InputBlock>> groupWithoutSharedCells(const std::vector<InputBlock>& blocks)
{
  if (blocks.size() == 1)
  {
    return { blocks };
  }
  const auto sharing = blocksThatShareCells(blocks);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const auto isFree = [&](const std::vector<std::size_t>& group)
    {
      return std::none_of(group.begin(), group.end(),
        [&](std::size_t member) {
          return sharing.count({ member, b }) > 0;
        });
    };
    auto group = std::find_if(groups.begin(), groups.end(), isFree);
    if (group == groups.end())
    {
      group = groups.insert(groups.end(), std::vector<std::size_t>{});
    }
    group->push_back(b);
  }
  std::vector<std::vector<InputBlock>> result;
  for (const std::vector<std::size_t>& group : groups)
  {
    result.emplace_back();
    for (const std::size_t member : group)
    {
      result.back().push_back(blocks[member]);
    }
  }
  return result;
}
