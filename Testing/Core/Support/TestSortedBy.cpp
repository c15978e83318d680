#include "Support/Random.h"
#include "Support/SortedBy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace hop
{
namespace
{

/// Calls the body for pieces of an unusual size, the last one first.
void backwards(std::ptrdiff_t count, const LoopBody& body)
{
  constexpr std::ptrdiff_t piece = 3;
  for (std::ptrdiff_t end = count; end > 0; end -= piece)
  {
    body(std::max<std::ptrdiff_t>(0, end - piece), end);
  }
}

TEST(SortedBy, IsAStableSortInAnyNumberOfPieces)
{
  for (const std::size_t numbers : { 1, 5, 300, 5'000 })
  {
    for (const std::size_t count : { 0, 1, 1'000, 500'000 })
    {
      Random random(7);
      std::vector<int> items(count);
      for (int& item : items)
      {
        item = static_cast<int>(random.uniform() * static_cast<double>(numbers));
      }
      std::vector<int> expected(count);
      std::iota(expected.begin(), expected.end(), 0);
      std::stable_sort(
        expected.begin(), expected.end(), [&](int a, int b) { return items[a] < items[b]; });

      const Grouping groups = groupedBy(
        items, numbers, [](int item) { return item; }, backwards);
      EXPECT_EQ(groups.order, expected);
      ASSERT_EQ(groups.start.size(), numbers + 1);
      EXPECT_EQ(groups.start.back(), static_cast<int>(count));
      for (std::size_t n = 0; n < numbers; ++n)
      {
        ASSERT_LE(groups.start[n], groups.start[n + 1]);
        for (int i = groups.start[n]; i < groups.start[n + 1]; ++i)
        {
          ASSERT_EQ(items[groups.order[i]], static_cast<int>(n));
        }
      }
    }
  }
}

} // namespace
} // namespace hop
