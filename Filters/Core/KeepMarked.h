#pragma once

#include <cstddef>
#include <vector>

namespace hop
{

/// Removes the items that have no mark, and keeps the order of the others.
template <class T>
void keepMarked(std::vector<T>& items, const std::vector<char>& marks)
{
  std::size_t next = 0;
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    if (marks[i])
    {
      items[next++] = items[i];
    }
  }
  items.resize(next);
}

/// Puts items order[0], order[1], ... first, in this order, and leaves the rest; without a second array.
/// \param order a permutation
template <class T>
void permute(std::vector<T>& items, std::vector<int> order)
{
  for (std::size_t start = 0; start < order.size(); ++start)
  {
    const T first = items[start];
    std::size_t place = start;
    for (std::size_t from = order[place]; from != start; from = order[place])
    {
      items[place] = items[from];
      order[place] = static_cast<int>(place);
      place = from;
    }
    items[place] = first;
    order[place] = static_cast<int>(place);
  }
}

} // namespace hop
