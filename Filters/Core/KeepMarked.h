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

} // namespace hop
