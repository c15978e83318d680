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

/// Nodes of two opposite edges are exchanged: the cell is bent, and its Jacobian determinant is -1 everywhere.
std::vector<Point> bentByOrder(std::vector<Point> nodes)
{
  std::swap(nodes[5], nodes[7]);
  return nodes;
}

/// An edge is an arc, as at the surface of a ball.
std::vector<Point> bent(std::vector<Point> nodes)
{
  nodes[5] = { 0.75, 0.75, 0.0 };
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

/// Looks for an order of cells that are sound: the first ones of the first block.
MisorderedCells displaced(const InputBlocks& blocks, int count)
{
  CellBases kinds(NodeSpacing::Uniform);
  BasisLookup bases(kinds);
  const CellBasis* cell = bases.basisOf(blocks[0].grid, 0);
  EXPECT_NE(cell, nullptr);
  std::vector<BlockCell> sound;
  for (int c = 0; c < count; ++c)
  {
    sound.push_back({ 0, c });
  }
  return findDisplaced(blocks, sound, *cell, kinds, testing::threadedFor(1));
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

TEST(NodeOrder, FindsExchangedNodesThatFoldNoCell)
{
  const std::vector<Point> sound = bent(tetrahedron());
  const std::vector<Point> bad = bentByOrder(tetrahedron());
  std::vector<std::vector<Point>> grid(12, sound);
  for (const int cell : { 0, 1, 2, 4, 5, 8, 10 })
  {
    grid[cell] = bad;
  }
  const InputBlocks blocks({ blockOf(VTK_QUADRATIC_TETRA, grid) }, 0);
  const MisorderedCells cells = displaced(blocks, 12);
  EXPECT_EQ(cells.describe(), "bent, but much straighter with nodes 5 and 7 exchanged");
  EXPECT_EQ(cells.cells, (std::vector<Ids>{ { 0, 1, 2, 4, 5, 8, 10 } }));
  EXPECT_TRUE(displaced(blocks, 9).isEmpty()) << "of few cells nothing is said";
}

TEST(NodeOrder, BentCellsAreNotMisordered)
{
  const InputBlocks blocks(
    { blockOf(VTK_QUADRATIC_TETRA, std::vector<std::vector<Point>>(12, bent(tetrahedron()))) }, 0);
  EXPECT_TRUE(displaced(blocks, 12).isEmpty());
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
