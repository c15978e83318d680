#include "Support/KeepMarked.h"

#include <gtest/gtest.h>

namespace
{

std::vector<int> kept(std::vector<int> items, const std::vector<char>& marks)
{
  hop::keepMarked(items, marks);
  return items;
}

std::vector<int> closed(std::vector<int> items, const std::vector<char>& marks)
{
  items.resize(hop::closeGaps(items, items.size(), marks));
  return items;
}

TEST(KeepMarked, KeepsTheOrder)
{
  EXPECT_EQ(kept({ 1, 2, 3, 4, 5 }, { 1, 0, 1, 0, 1 }), (std::vector<int>{ 1, 3, 5 }));
  EXPECT_EQ(kept({ 1, 2 }, { 0, 0 }), std::vector<int>{});
  EXPECT_EQ(kept({ 1, 2 }, { 1, 1 }), (std::vector<int>{ 1, 2 }));
}

TEST(KeepMarked, GapsAreClosedByTheLastItems)
{
  EXPECT_EQ(closed({ 1, 2, 3, 4, 5 }, { 1, 0, 1, 1, 1 }), (std::vector<int>{ 1, 5, 3, 4 }));
  EXPECT_EQ(closed({ 1, 2, 3, 4, 5 }, { 0, 1, 0, 1, 0 }), (std::vector<int>{ 4, 2 }));
  EXPECT_EQ(closed({ 1, 2, 3 }, { 1, 1, 0 }), (std::vector<int>{ 1, 2 }));
  EXPECT_EQ(closed({ 1, 2, 3 }, { 0, 0, 0 }), std::vector<int>{});
  EXPECT_EQ(closed({ 1, 2, 3 }, { 1, 1, 1 }), (std::vector<int>{ 1, 2, 3 }));
  EXPECT_EQ(closed({}, {}), std::vector<int>{});
  // The last items that are kept fill gaps behind which nothing is kept.
  EXPECT_EQ(closed({ 1, 2, 3, 4 }, { 0, 0, 0, 1 }), std::vector<int>{ 4 });
  EXPECT_EQ(closed({ 1, 2, 3, 4, 5, 6 }, { 1, 0, 0, 0, 1, 1 }), (std::vector<int>{ 1, 6, 5 }));
}

TEST(KeepMarked, ItemsBehindThoseMeantAreNotMoved)
{
  std::vector<int> items{ 1, 2, 3, 10, 11 };
  EXPECT_EQ(hop::closeGaps(items, 3, { 0, 1, 1, 0, 0 }), 2u);
  EXPECT_EQ(items[0], 3);
  EXPECT_EQ(items[1], 2);
  EXPECT_EQ(items[3], 10);
  EXPECT_EQ(items[4], 11);
}

TEST(KeepMarked, MarkedItemsAreCopiedInTheirOrder)
{
  const std::vector<int> items{ 1, 2, 3, 4 };
  EXPECT_EQ(hop::marked(items, { 0, 1, 1 }), (std::vector<int>{ 2, 3 }));
}

TEST(KeepMarked, SaysWhichAreMarked)
{
  EXPECT_EQ(hop::markedIndices({ 0, 1, 1, 0, 1 }, 4), (std::vector<int>{ 1, 2 }));
  EXPECT_EQ(hop::markedIndices({}, 0), std::vector<int>{});
}

} // namespace
