#include "Support/VectorHash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <unordered_set>
#include <vector>

namespace hop::testing
{
namespace
{

TEST(VectorHash, IsTheSameForNumbersThatAreEqual)
{
  EXPECT_EQ(hashOf({ 0.0, 0.0, 0.0 }), hashOf({ -0.0, 0.0, -0.0 }));
  EXPECT_EQ(hashOf({ 1.5, -2.0, 1e300 }), hashOf({ 3.0 / 2.0, -2.0, 1e300 }));
}

TEST(VectorHash, DependsOnEachNumberAndOnTheirOrder)
{
  const std::vector<glm::dvec3> different{ { 1.0, 2.0, 3.0 }, { 2.0, 1.0, 3.0 }, { 3.0, 2.0, 1.0 },
    { 1.0, 3.0, 2.0 }, { -1.0, 2.0, 3.0 }, { 1.0, -2.0, 3.0 }, { 1.0, 2.0, -3.0 },
    { 1.0 + 1e-15, 2.0, 3.0 } };
  std::unordered_set<std::uint64_t> hashes;
  for (const glm::dvec3& numbers : different)
  {
    hashes.insert(hashOf(numbers));
  }
  EXPECT_EQ(hashes.size(), different.size());
}

TEST(VectorHash, SpreadsCellsOfAGridEvenlyOverItsLowerBits)
{
  constexpr int side = 32, bins = side * side * side;
  std::vector<int> count(bins);
  for (int n = 0; n < bins; ++n)
  {
    ++count[hashOf({ n % side - 16, n / side % side - 16, n / (side * side) - 16 }) % bins];
  }
  // One a bin on the average; were they thrown by chance, 37% of the bins would be empty and none would hold ten.
  EXPECT_LT(*std::max_element(count.begin(), count.end()), 10);
  EXPECT_NEAR(std::count(count.begin(), count.end(), 0) / double(bins), 0.37, 0.05);
}

} // namespace
} // namespace hop::testing
