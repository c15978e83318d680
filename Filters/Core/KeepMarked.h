#pragma once

#include "Buffer.h"
#include "Monitor.h"

#include <algorithm>
#include <vector>

namespace hop
{

/// Removes the items that have no mark, and keeps the order of the others.
/// \param marks one for each item at least
template <class T>
void keepMarked(std::vector<T>& items, const std::vector<char>& marks)
{
  const auto end = marks.begin() + static_cast<std::ptrdiff_t>(items.size());
  std::size_t next = std::find(marks.begin(), end, 0) - marks.begin();
  for (std::size_t i = next; i < items.size(); ++i)
  {
    if (marks[i])
    {
      items[next++] = items[i];
    }
  }
  items.resize(next);
}

/// Copies of the items that have a mark, in their order.
/// \param marks one for each item at most
template <class T>
std::vector<T> marked(const std::vector<T>& items, const std::vector<char>& marks)
{
  std::vector<T> result;
  result.reserve(marks.size() - std::count(marks.begin(), marks.end(), 0));
  for (std::size_t i = 0; i < marks.size(); ++i)
  {
    if (marks[i])
    {
      result.push_back(items[i]);
    }
  }
  return result;
}

/// Puts items order[0], order[1], ... first, in this order, and leaves the rest.
template <class T>
void permute(std::vector<T>& items, const std::vector<int>& order, const ParallelFor& parallelFor)
{
  Buffer<T> before(order.size());
  forAll(parallelFor, order.size(), [&](std::size_t n) { before[n] = items[n]; });
  forAll(parallelFor, order.size(), [&](std::size_t n) { items[n] = before[order[n]]; });
}

} // namespace hop
