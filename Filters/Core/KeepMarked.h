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

/// Puts items order[0], order[1], ... first, in this order, and leaves the rest.
template <class T>
void permute(std::vector<T>& items, const std::vector<int>& order, const ParallelFor& parallelFor)
{
  Buffer<T> before(order.size());
  const auto forAll = [&](const auto& use)
  {
    runParallel(parallelFor, static_cast<std::ptrdiff_t>(order.size()),
      [&](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        for (std::ptrdiff_t n = begin; n < end; ++n)
        {
          use(n);
        }
      });
  };
  forAll([&](std::ptrdiff_t n) { before[n] = items[n]; });
  forAll([&](std::ptrdiff_t n) { items[n] = before[order[n]]; });
}

} // namespace hop
