#include "Support/Buffer.h"

#include <gtest/gtest.h>

#include <numeric>

namespace hop::testing
{
namespace
{

struct Entry
{
  int number = 7;
  double weight = 0.5;
};

TEST(Buffer, LeavesNewEntriesAsTheyAre)
{
  Buffer<int> numbers(1000, 5);
  const int* const memory = numbers.data();
  numbers.clear();
  numbers.resize(1000); // of the same memory, in which nobody has written
  EXPECT_EQ(numbers.data(), memory);
  EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0), 5000);
}

TEST(Buffer, WritesValuesThatAreGiven)
{
  Buffer<Entry> entries(10, Entry());
  EXPECT_EQ(entries[9].number, 7);
  entries.push_back({ 3, 0.25 });
  entries.resize(12, { 4, 0.125 });
  EXPECT_EQ(entries[9].number, 7);
  EXPECT_EQ(entries[10].number, 3);
  EXPECT_EQ(entries[11].weight, 0.125);
}

TEST(Buffer, SpansSeeEntriesOfVectorsAndOfPartsOfThem)
{
  std::vector<int> numbers(10);
  std::iota(numbers.begin(), numbers.end(), 0);
  const Span<int> all(numbers);
  EXPECT_EQ(all.size(), 10u);
  EXPECT_EQ(std::accumulate(all.begin(), all.end(), 0), 45);
  const Span<int> some(numbers.data() + 3, 4);
  EXPECT_EQ(some.size(), 4u);
  EXPECT_EQ(some[0], 3);
  EXPECT_EQ(*(some.end() - 1), 6);
  EXPECT_FALSE(some.empty());
  EXPECT_TRUE(Span<int>(Buffer<int>()).empty());
}

} // namespace
} // namespace hop::testing
