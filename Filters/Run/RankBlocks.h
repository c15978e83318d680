#pragma once

#include "Input/InputBlocks.h"
#include "Input/UserMessage.h"
#include "Run/PreviousRun.h"
#include "Support/Exchange.h"

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace hop
{

/// The component to contour by, as a rank with blocks has it. Every rank calls it.
/// \param messages of the first rank receive an error where ranks differ in the number of components
int agreeOnComponent(Exchange& exchange, const InputBlocks& mine, UserMessages& messages);

/// The numbers of all ranks' blocks in groups that can be contoured as one mesh each, see Input/BlockGroups.h. Every
/// rank calls it.
/// \param sharing pairs of this rank's blocks that share cells
std::vector<std::set<int>> agreeOnGroups(
  Exchange& exchange, const InputBlocks& mine, const std::set<std::pair<int, int>>& sharing);

/// What every rank knows of the blocks of all ranks. Their cells are numbered through: first the cells of rank 0, then
/// the cells of rank 1, and so on; on each rank as in InputBlocks.
class RankBlocks
{
public:
  /// Every rank calls it, also one without blocks.
  RankBlocks(Exchange& exchange, const InputBlocks& mine);

  /// "cell 7 of block 3 'wing'", with the rank where there are several.
  std::string describe(std::int64_t number) const;

  /// The InputBlock::number of the block of a cell.
  int blockOf(std::int64_t number) const { return this->locate(number).number; }

  /// What the data of all ranks say about their isosurfaces, see originOf(). It is another one whenever the data of
  /// one rank are others.
  const RunOrigin& origin() const { return this->Origin; }

  /// Lowest and highest value of the chosen scalar, see valueRange().
  const std::array<double, 2>& range() const { return this->Range; }

private:
  struct Block
  {
    int rank = 0;
    int number = 0;
    std::string name;
    std::int64_t firstCell = 0;
  };

  const Block& locate(std::int64_t number) const;

  bool HasSeveralRanks;
  std::vector<Block> Blocks;
  RunOrigin Origin;
  std::array<double, 2> Range;
};

} // namespace hop
