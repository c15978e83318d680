#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace hop
{

/// Indices of items sorted by a number in [0, count), stably: a counting sort.
template <class Item, class NumberOf>
std::vector<int> sortedBy(
  const std::vector<Item>& items, std::size_t count, const NumberOf& numberOf)
{
  std::vector<int> next(count + 1, 0);
  for (const Item& item : items)
  {
    ++next[numberOf(item) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<int> order(items.size());
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    order[next[numberOf(items[i])]++] = static_cast<int>(i);
  }
  return order;
}

} // namespace hop
