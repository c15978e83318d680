#include "Support/DisjointSets.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

TEST(DisjointSets, StandAloneUntilTheyAreUnited)
{
  DisjointSets sets(5);
  for (int n = 0; n < 5; ++n)
  {
    EXPECT_EQ(sets.root(n), n);
  }
  sets.unite(4, 2);
  sets.unite(2, 2);
  EXPECT_EQ(sets.root(4), 2);
  EXPECT_EQ(sets.root(2), 2);
  EXPECT_EQ(sets.root(3), 3);
}

TEST(DisjointSets, GoByTheLeastOfTheirNumbersInWhateverOrderTheyAreUnited)
{
  constexpr int count = 300;
  Random random(8);
  const auto any = [&]() { return static_cast<int>(count * random.uniform()); };
  DisjointSets sets(count);
  std::vector<int> labels(count);
  std::iota(labels.begin(), labels.end(), 0);
  for (int n = 0; n < 250; ++n)
  {
    const int a = any(), b = any();
    sets.unite(a, b);
    const auto [less, more] = std::minmax({ labels[a], labels[b] });
    std::replace(labels.begin(), labels.end(), int(more), int(less));
  }
  for (int n = 0; n < count; ++n)
  {
    EXPECT_EQ(sets.root(n), labels[n]);
  }
}

TEST(DisjointSets, FollowLongChains)
{
  constexpr int count = 100000;
  DisjointSets sets(count);
  for (int n = count - 1; n > 0; --n)
  {
    sets.unite(n, n - 1);
  }
  EXPECT_EQ(sets.root(count - 1), 0);
}

} // namespace
} // namespace hop::testing
