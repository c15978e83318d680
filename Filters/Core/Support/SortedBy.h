#pragma once

#include "Common/Monitor.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hop
{

/// Indices of items, grouped by a number that each item has: the items of number n are order[start[n]] to
/// order[start[n + 1] - 1], ascending.
struct Grouping
{
  std::vector<int> start;
  std::vector<int> order;
};

/// Groups items by a number in [0, count): a counting sort, in threads where there are several items for each number.
/// \param numberOf numberOf(item)
template <class Items, class NumberOf>
Grouping groupedBy(const Items& items, std::size_t count, const NumberOf& numberOf,
  const ParallelFor& parallelFor = {})
{
  // Each piece has a counter for each number, so that it pays only with so many items for each counter: with fewer, the
  // counters take longer than the items. All three chosen by experiment; the result does not depend on them.
  constexpr std::size_t mostPieces = 16;
  constexpr std::size_t itemsPerNumber = 4;
  // Below 1,024 items a piece, threads take longer to start than the items.
  constexpr std::size_t leastNumbers = 256;
  const std::size_t pieces = std::clamp<std::size_t>(
    items.size() / (itemsPerNumber * std::max<std::size_t>(count, leastNumbers)), 1, mostPieces);
  const auto forPiece = [&](std::size_t piece, const auto& use)
  {
    const std::size_t end = (piece + 1) * items.size() / pieces;
    for (std::size_t i = piece * items.size() / pieces; i < end; ++i)
    {
      use(i, static_cast<std::size_t>(numberOf(items[i])));
    }
  };
  std::vector<std::vector<int>> next(pieces);
  forAll(parallelFor, pieces,
    [&](std::size_t piece)
    {
      next[piece].assign(count, 0);
      forPiece(piece, [&](std::size_t, std::size_t number) { ++next[piece][number]; });
    });
  Grouping result{ std::vector<int>(count + 1), std::vector<int>(items.size()) };
  int sum = 0;
  for (std::size_t number = 0; number < count; ++number)
  {
    result.start[number] = sum;
    for (std::vector<int>& ofPiece : next)
    {
      const int here = ofPiece[number];
      ofPiece[number] = sum;
      sum += here;
    }
  }
  result.start[count] = sum;
  forAll(parallelFor, pieces,
    [&](std::size_t piece)
    {
      forPiece(piece,
        [&](std::size_t i, std::size_t number)
        { result.order[next[piece][number]++] = static_cast<int>(i); });
    });
  return result;
}

/// Indices of items sorted by a number in [0, count); items of equal number keep their order.
template <class Items, class NumberOf>
std::vector<int> sortedBy(const Items& items, std::size_t count, const NumberOf& numberOf,
  const ParallelFor& parallelFor = {})
{
  return groupedBy(items, count, numberOf, parallelFor).order;
}

} // namespace hop
