#include "MeshJudge.h"

#include "Support/DisjointSets.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <map>
#include <set>

namespace hop::testing
{
namespace
{

using Corners = std::vector<vtkIdType>;

/// The three corners of each triangle, one after the other; what is wrong with its nodes is told.
Corners cornersOf(vtkPointSet& mesh, std::vector<std::string>& found)
{
  vtkCellArray& cells = cellsOf(mesh);
  Corners corners;
  std::set<vtkIdType> used;
  const vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell)
  {
    cells.GetCellAtId(cell, ids);
    const std::set<vtkIdType> nodes(ids->begin(), ids->end());
    if (*nodes.begin() < 0 || *nodes.rbegin() >= mesh.GetNumberOfPoints())
    {
      found.emplace_back("a triangle has a corner that is not there");
      return {};
    }
    if (static_cast<vtkIdType>(nodes.size()) != ids->GetNumberOfIds())
    {
      found.emplace_back("a triangle has a node twice");
      return {};
    }
    used.insert(nodes.begin(), nodes.end());
    corners.insert(corners.end(), ids->begin(), ids->begin() + 3);
  }
  if (static_cast<vtkIdType>(used.size()) != mesh.GetNumberOfPoints())
  {
    found.emplace_back("a point has no triangle");
  }
  return corners;
}

/// The place in the list of the next corner of the same triangle.
std::size_t next(std::size_t i)
{
  return i % 3 == 2 ? i - 2 : i + 1;
}

} // namespace

vtkCellArray& cellsOf(vtkPointSet& output)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&output);
  return grid ? *grid->GetCells() : *vtkPolyData::SafeDownCast(&output)->GetPolys();
}

void judgeMesh(vtkPointSet& mesh, bool isPart, std::vector<std::string>& found)
{
  const Corners corners = cornersOf(mesh, found);
  // From an edge in the direction in which a triangle passes it to where the edge begins in the list.
  std::map<std::array<vtkIdType, 2>, std::size_t> edges;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (!edges.insert({ { corners[i], corners[next(i)] }, i }).second)
    {
      found.emplace_back("two triangles are on one side of an edge");
      return;
    }
  }
  // Corners of two triangles that share an edge belong to one fan.
  DisjointSets fans(corners.size());
  for (const auto& [ends, i] : edges)
  {
    const auto other = edges.find({ ends[1], ends[0] });
    if (other != edges.end())
    {
      fans.unite(static_cast<int>(i), static_cast<int>(next(other->second)));
      fans.unite(static_cast<int>(next(i)), static_cast<int>(other->second));
    }
  }
  std::map<vtkIdType, int> fanOf;
  for (std::size_t i = 0; i < corners.size() && !isPart; ++i)
  {
    const int fan = fans.root(static_cast<int>(i));
    if (fanOf.insert({ corners[i], fan }).first->second != fan)
    {
      found.emplace_back("two fans of triangles touch in a corner");
      return;
    }
  }
}

} // namespace hop::testing
