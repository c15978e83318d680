#include "Conversion/NodeOrder.h"

#include "ThreadedFor.h"

#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkLagrangeHexahedron.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace hop
{
namespace
{

using Point = std::array<double, 3>;
using Ids = std::vector<vtkIdType>;

/// The nodes of a straight quadratic tetrahedron in VTK's order.
std::vector<Point> tetrahedron()
{
  std::vector<Point> nodes{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (const auto& [a, b] : { std::pair{ 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 1, 3 }, { 2, 3 } })
  {
    Point middle;
    for (int axis = 0; axis < 3; ++axis)
    {
      middle[axis] = 0.5 * (nodes[a][axis] + nodes[b][axis]);
    }
    nodes.push_back(middle);
  }
  return nodes;
}

std::vector<Point> exchanged(std::vector<Point> nodes)
{
  std::swap(nodes[8], nodes[9]);
  return nodes;
}

/// Folded in any order: a node is far outside.
std::vector<Point> torn(std::vector<Point> nodes)
{
  nodes[4] = { 0.5, 3.0, 3.0 };
  return nodes;
}

/// A block of cells of one type that share no nodes.
InputBlock blockOf(int type, const std::vector<std::vector<Point>>& cells)
{
  InputBlock block;
  block.grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName("f");
  block.grid->Allocate(static_cast<vtkIdType>(cells.size()));
  for (const std::vector<Point>& nodes : cells)
  {
    Ids ids;
    for (const Point& node : nodes)
    {
      ids.push_back(points->InsertNextPoint(node.data()));
      values->InsertNextValue(node[0]);
    }
    block.grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
  }
  block.grid->SetPoints(points);
  block.grid->GetPointData()->AddArray(values);
  block.scalars = values;
  return block;
}

/// Looks for an order of the cells that are folded, all of one kind.
MisorderedCells found(
  const InputBlocks& blocks, const std::vector<BlockCell>& folded, bool areMost, int threads = 1)
{
  CellBases kinds(NodeSpacing::Uniform);
  BasisLookup bases(kinds);
  const CellBasis* cell = bases.basisOf(blocks[folded[0].block].grid, folded[0].cell);
  EXPECT_NE(cell, nullptr);
  return findMisordered(blocks, folded, areMost, *cell, kinds, testing::threadedFor(threads));
}

TEST(NodeOrder, FindsExchangedNodesAmongSoundCellsInAllBlocks)
{
  const std::vector<Point> sound = tetrahedron();
  const std::vector<Point> bad = exchanged(sound);
  const InputBlocks blocks({ blockOf(VTK_QUADRATIC_TETRA, { bad, sound, bad, sound }),
                             blockOf(VTK_QUADRATIC_TETRA, { sound, bad }) },
    0);
  for (const int threads : { 1, 4 })
  {
    const MisorderedCells cells = found(blocks, { { 0, 2 } }, false, threads);
    EXPECT_EQ(cells.remedy, "nodes 8 and 9 exchanged");
    EXPECT_EQ(cells.cells, (std::vector<Ids>{ { 0, 2 }, { 1 } }));
    EXPECT_FALSE(cells.isEmpty());
  }
}

TEST(NodeOrder, NamesTheOrderOfAProgramThatSortsByPlace)
{
  const std::array<int, 3> degrees{ 2, 2, 2 };
  std::vector<Point> sorted;
  std::vector<int> order(27);
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        order[vtkLagrangeHexahedron::PointIndexFromIJK(i, j, k, degrees.data())] =
          static_cast<int>(sorted.size());
        sorted.push_back({ 0.5 * i, 0.5 * j, 0.5 * k });
      }
    }
  }
  std::string expected = "their nodes in the order";
  for (const int node : order)
  {
    expected += " " + std::to_string(node);
  }
  const InputBlocks blocks({ blockOf(VTK_LAGRANGE_HEXAHEDRON, { sorted, sorted }) }, 0);
  const MisorderedCells cells = found(blocks, { { 0, 0 } }, false);
  EXPECT_EQ(cells.remedy, expected);
  EXPECT_EQ(cells.cells, (std::vector<Ids>{ { 0, 1 } }));
}

TEST(NodeOrder, OrdersThatDifferFromCellToCellAreNoOneRemedy)
{
  std::vector<Point> other = tetrahedron();
  std::swap(other[4], other[5]);
  const InputBlocks blocks(
    { blockOf(VTK_QUADRATIC_TETRA, { exchanged(tetrahedron()), other }) }, 0);
  const MisorderedCells cells = found(blocks, { { 0, 0 }, { 0, 1 } }, true);
  EXPECT_EQ(cells.remedy, "their nodes in other orders, which differ from cell to cell");
  EXPECT_EQ(cells.cells, (std::vector<Ids>{ { 0, 1 } }));
}

TEST(NodeOrder, AFewFoldedCellsThatNoOrderMendsAreTheMeshsOwn)
{
  const std::vector<Point> sound = tetrahedron();
  const InputBlocks blocks({ blockOf(VTK_QUADRATIC_TETRA, { torn(sound), sound, sound }) }, 0);
  for (const bool areMostAtTheSurface : { false, true })
  {
    const MisorderedCells cells = found(blocks, { { 0, 0 } }, areMostAtTheSurface);
    EXPECT_EQ(cells.remedy, "");
    EXPECT_TRUE(cells.isEmpty());
  }
}

TEST(NodeOrder, MostCellsFoldedAreFoundWithoutARemedy)
{
  const std::vector<Point> sound = tetrahedron();
  const InputBlocks blocks(
    { blockOf(VTK_QUADRATIC_TETRA, { torn(sound), torn(sound), sound }) }, 0);
  const MisorderedCells cells = found(blocks, { { 0, 0 } }, true);
  EXPECT_EQ(cells.remedy, "");
  EXPECT_EQ(cells.cells, (std::vector<Ids>{ { 0, 1 } }));
  EXPECT_TRUE(found(blocks, { { 0, 0 } }, false).isEmpty());
}

} // namespace
} // namespace hop
