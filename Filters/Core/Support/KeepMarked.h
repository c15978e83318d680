#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace hop
{

/// Removes the items that have no mark, and keeps the order of the others.
/// \param marks one for each item at least
template <class Items>
void keepMarked(Items& items, const std::vector<char>& marks)
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

/// Drops those of the first `end` items that have no mark, and fills their places with the last ones: where few are
/// dropped, nearly all stay where they are.
/// \param marks one for each of these items at least
/// \return how many are left; they are the first now
template <class Items>
std::size_t closeGaps(Items& items, std::size_t end, const std::vector<char>& marks)
{
  // Gaps before `first` are filled.
  const auto dropLast = [&](std::size_t first)
  {
    while (end > first && !marks[end - 1])
    {
      --end;
    }
  };
  dropLast(0);
  for (std::size_t i = 0; i < end; ++i)
  {
    if (!marks[i])
    {
      items[i] = items[--end];
      dropLast(i + 1);
    }
  }
  return end;
}

/// A mark where there was none, and none where there was one.
inline std::vector<char> opposite(std::vector<char> marks)
{
  std::transform(marks.begin(), marks.end(), marks.begin(), std::logical_not<>());
  return marks;
}

/// The indices below `count` that have a mark, ascending.
inline std::vector<int> markedIndices(const std::vector<char>& marks, std::size_t count)
{
  std::vector<int> indices;
  indices.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (marks[i])
    {
      indices.push_back(static_cast<int>(i));
    }
  }
  return indices;
}

/// Copies of the items that have a mark, in their order.
/// \param marks one for each item at most
template <class Items>
Items marked(const Items& items, const std::vector<char>& marks)
{
  Items result;
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

} // namespace hop
