#include "Run/RankBlocks.h"

#include "Conversion/GridElements.h"
#include "Input/BlockGroups.h"
#include "Support/ByteHash.h"

#include "vtkMultiProcessStream.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace hop
{

namespace
{

/// What ranks have written, in the order of ranks.
std::vector<vtkMultiProcessStream> gatherStreams(
  Exchange& exchange, const vtkMultiProcessStream& mine)
{
  Bytes bytes;
  mine.GetRawData(bytes);
  std::vector<vtkMultiProcessStream> streams;
  for (const Bytes& some : exchange.allGather(bytes))
  {
    streams.emplace_back().SetRawData(some);
  }
  return streams;
}

/// Reads a number that was written as that type.
template <class T>
T read(vtkMultiProcessStream& stream)
{
  T value{};
  stream >> value;
  return value;
}

} // namespace

int agreeOnComponent(Exchange& exchange, const InputBlocks& mine, UserMessages& messages)
{
  constexpr int nothing = InputBlocks::Magnitude - 1;
  int agreed = nothing;
  bool isSame = true;
  for (const int component : gatherFromAll(exchange, mine.size() > 0 ? mine.component() : nothing))
  {
    isSame = isSame && (component == nothing || agreed == nothing || component == agreed);
    agreed = agreed == nothing ? component : agreed;
  }
  if (!isSame && exchange.rank() == 0)
  {
    messages.push_back({ UserMessage::Error,
      "The array to contour by has other numbers of components on some ranks than on others." });
  }
  return !isSame || agreed == nothing ? mine.component() : agreed;
}

std::vector<std::set<int>> agreeOnGroups(
  Exchange& exchange, const InputBlocks& mine, const std::set<std::pair<int, int>>& sharing)
{
  vtkMultiProcessStream stream;
  stream << static_cast<int>(mine.size());
  for (std::size_t b = 0; b < mine.size(); ++b)
  {
    stream << mine[b].number;
  }
  stream << static_cast<int>(sharing.size());
  for (const auto& [first, second] : sharing)
  {
    stream << first << second;
  }
  std::set<int> numbers;
  BlockPairs pairs;
  for (vtkMultiProcessStream& some : gatherStreams(exchange, stream))
  {
    for (int left = read<int>(some); left > 0; --left)
    {
      numbers.insert(read<int>(some));
    }
    for (int left = read<int>(some); left > 0; --left)
    {
      const int first = read<int>(some);
      pairs.insert({ first, read<int>(some) });
    }
  }
  return groupsWithoutSharedCells(numbers, pairs);
}

RankBlocks::RankBlocks(Exchange& exchange, const InputBlocks& mine)
  : HasSeveralRanks(!exchange.isAlone())
  , Range(valueRange(mine))
{
  const RunOrigin own = mine.size() > 0 ? originOf(mine) : RunOrigin();
  vtkMultiProcessStream stream;
  stream << own.array << static_cast<vtkTypeUInt64>(own.dataTime)
         << static_cast<vtkTypeInt64>(own.points) << this->Range[0] << this->Range[1]
         << static_cast<int>(mine.size());
  for (std::size_t b = 0; b < mine.size(); ++b)
  {
    stream << mine[b].number << mine[b].name
           << static_cast<vtkTypeInt64>(mine[b].grid->GetNumberOfCells());
  }
  this->Origin.component = mine.component();
  this->Origin.quantity = mine.quantity();
  ByteHash times;
  int rank = 0;
  for (vtkMultiProcessStream& some : gatherStreams(exchange, stream))
  {
    const auto array = read<std::string>(some);
    times.addWord(read<vtkTypeUInt64>(some));
    this->Origin.points += read<vtkTypeInt64>(some);
    this->Range[0] = std::min(this->Range[0], read<double>(some));
    this->Range[1] = std::max(this->Range[1], read<double>(some));
    const int blocks = read<int>(some);
    this->Origin.array = blocks > 0 && this->Blocks.empty() ? array : this->Origin.array;
    for (int b = 0; b < blocks; ++b)
    {
      const int number = read<int>(some);
      this->Blocks.push_back({ rank, number, read<std::string>(some), this->Origin.cells });
      this->Origin.cells += read<vtkTypeInt64>(some);
    }
    ++rank;
  }
  this->Origin.dataTime = times.value();
}

const RankBlocks::Block& RankBlocks::locate(std::int64_t number) const
{
  const auto next = std::upper_bound(this->Blocks.begin(), this->Blocks.end(), number,
    [](std::int64_t cell, const Block& block) { return cell < block.firstCell; });
  return *(next - 1);
}

std::string RankBlocks::describe(std::int64_t number) const
{
  const Block& block = this->locate(number);
  return "cell " + std::to_string(number - block.firstCell) +
    (block.name.empty() ? "" : " of " + block.name) +
    (this->HasSeveralRanks ? " on rank " + std::to_string(block.rank) : "");
}

} // namespace hop
