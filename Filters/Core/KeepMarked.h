#pragma once

#include <algorithm>
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

/// Follows each marked item by a copy of it.
template <class T>
void doubleMarked(std::vector<T>& items, const std::vector<char>& marks)
{
  const std::size_t count = items.size();
  items.resize(count + std::count_if(marks.begin(), marks.end(), [](char mark) { return mark; }));
  std::size_t next = items.size();
  for (std::size_t i = count; i-- > 0;)
  {
    items[--next] = items[i];
    if (marks[i])
    {
      items[--next] = items[i];
    }
  }
}

} // namespace hop
