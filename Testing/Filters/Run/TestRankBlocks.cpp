#include "Run/RankBlocks.h"

#include "RanksInMemory.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

/// A grid of vertices, one a value.
InputBlock blockOf(int number, const std::string& name, const std::vector<double>& values)
{
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkDoubleArray> array;
  array->SetName("u");
  for (const double value : values)
  {
    const vtkIdType id = points->InsertNextPoint(value, 0.0, 0.0);
    grid->InsertNextCell(VTK_VERTEX, 1, &id);
    array->InsertNextValue(value);
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(array);
  InputBlock block;
  block.grid = grid;
  block.scalars = array;
  block.name = name;
  block.number = number;
  return block;
}

/// Three ranks: two cells in a block, nothing, and three cells in each of two blocks.
InputBlocks blocksOfRank(int rank)
{
  switch (rank)
  {
    case 0:
      return { { blockOf(1, "block 1 'wing'", { 3.0, 4.0 }) }, 0 };
    case 2:
      return {
        { blockOf(1, "block 1 'wing'", { 1.0, 2.0, 2.5 }), blockOf(4, "", { 7.0, 8.0, 9.0 }) }, 0
      };
    default:
      return { {}, 0 };
  }
}

TEST(RankBlocks, NumberTheCellsOfAllRanksThrough)
{
  runRanks(3,
    [](Exchange& exchange)
    {
      const RankBlocks all(exchange, blocksOfRank(exchange.rank()));
      EXPECT_EQ(all.describe(1), "cell 1 of block 1 'wing' on rank 0");
      EXPECT_EQ(all.describe(2), "cell 0 of block 1 'wing' on rank 2");
      EXPECT_EQ(all.describe(7), "cell 2 on rank 2");
      EXPECT_EQ(all.origin().cells, 8);
      EXPECT_EQ(all.origin().points, 8);
      EXPECT_EQ(all.origin().array, "u");
      EXPECT_EQ(all.range(), (std::array<double, 2>{ 1.0, 9.0 }));
    });
}

TEST(RankBlocks, OfOneRankNameNoRank)
{
  NoExchange alone;
  EXPECT_EQ(RankBlocks(alone, blocksOfRank(0)).describe(1), "cell 1 of block 1 'wing'");
}

TEST(RankBlocks, AreOthersWhenDataOfOneRankAre)
{
  std::uint64_t times[2] = {};
  for (const int run : { 0, 1 })
  {
    runRanks(3,
      [&](Exchange& exchange)
      {
        InputBlock block = blockOf(1, "", { 1.0 });
        block.grid->GetPoints()->Modified();
        block.scalarsTime = 1'000'000'000 + (exchange.rank() == 2 ? run : 0);
        const RankBlocks all(exchange, { { block }, 0 });
        if (exchange.rank() == 1)
        {
          times[run] = all.origin().dataTime;
        }
      });
  }
  EXPECT_NE(times[0], times[1]);
}

TEST(RankBlocks, GhostCellsDoNotCountForTheRange)
{
  NoExchange alone;
  const InputBlock block = blockOf(1, "", { 1.0, 2.0, 9.0 });
  const vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName("vtkGhostType");
  for (const int ghost : { 0, 0, 1 })
  {
    ghosts->InsertNextValue(static_cast<unsigned char>(ghost));
  }
  block.grid->GetCellData()->AddArray(ghosts);
  EXPECT_EQ(RankBlocks(alone, { { block }, 0 }).range(), (std::array<double, 2>{ 1.0, 2.0 }));
  EXPECT_EQ(finiteBounds(block.grid).GetMaxPoint()[0], 2.0);
}

TEST(RankBlocks, AgreeOnTheComponentOfRanksWithBlocks)
{
  runRanks(3,
    [](Exchange& exchange)
    {
      UserMessages messages;
      const std::vector<InputBlock> some = { blockOf(1, "", { 1.0 }) };
      const InputBlocks mine(exchange.rank() == 1 ? some : std::vector<InputBlock>(),
        exchange.rank() == 1 ? InputBlocks::Magnitude : 0);
      EXPECT_EQ(agreeOnComponent(exchange, mine, messages), InputBlocks::Magnitude);
      EXPECT_TRUE(messages.empty());
    });
}

TEST(RankBlocks, OneRankTellsThatComponentsDiffer)
{
  runRanks(2,
    [](Exchange& exchange)
    {
      UserMessages messages;
      agreeOnComponent(exchange, { { blockOf(1, "", { 1.0 }) }, exchange.rank() }, messages);
      EXPECT_EQ(messages.size(), exchange.rank() == 0 ? 1u : 0u);
    });
}

TEST(RankBlocks, AgreeOnGroupsOfAllRanksBlocks)
{
  using Groups = std::vector<std::set<int>>;
  runRanks(3,
    [](Exchange& exchange)
    {
      const InputBlocks mine = blocksOfRank(exchange.rank());
      EXPECT_EQ(agreeOnGroups(exchange, mine, {}), (Groups{ { 1, 4 } }));
      const std::set<std::pair<int, int>> shared{ { 1, 4 } };
      EXPECT_EQ(agreeOnGroups(
                  exchange, mine, exchange.rank() == 2 ? shared : std::set<std::pair<int, int>>()),
        (Groups{ { 1 }, { 4 } }));
    });
}

} // namespace
} // namespace hop::testing
