#include "AvailableParts.h"

#include "Support/Random.h"

#include <algorithm>
#include <vector>

namespace hop::testing
{
namespace
{

class RowProducts : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }
};

std::vector<double> randomRow(int count, Random& random)
{
  std::vector<double> row(count);
  std::generate(row.begin(), row.end(), [&] { return 2.0 * random.uniform() - 1.0; });
  return row;
}

/// Pairs of rows of random lengths, the product of the longest of `length` entries.
struct Pairs
{
  Pairs(int count, int length, Random& random)
  {
    for (int n = 0; n < count; ++n)
    {
      const int together = length + 1 - static_cast<int>(n % 3 % length);
      const int ofLeft = 1 + static_cast<int>(random.uniform() * (together - 1));
      this->left.push_back(randomRow(ofLeft, random));
      this->right.push_back(randomRow(together - ofLeft, random));
      std::vector<double>& row = this->padded.emplace_back(3 * length + 8, 0.0);
      std::copy(this->right[n].begin(), this->right[n].end(), row.begin() + length);
    }
    for (int n = 0; n < count; ++n)
    {
      this->pairs.push_back({ this->left[n].data(), static_cast<int>(this->left[n].size()),
        this->padded[n].data() + length });
    }
  }

  std::vector<std::vector<double>> left;
  std::vector<std::vector<double>> right;
  std::vector<std::vector<double>> padded;
  std::vector<kernel::RowPair> pairs;
};

/// As polynomials are multiplied: entry i of one row times entry n of the other goes to entry i + n.
TEST_P(RowProducts, AreThoseOfPolynomials)
{
  Random random(3);
  for (int length = 1; length <= 50; ++length)
  {
    const Pairs some(5, length, random);
    std::vector<double> expected = randomRow(length, random);
    std::vector<double> sum = expected;
    sum.resize(length + kernel::MaximumLanes, 0.0);
    kernel::current().rowProducts(some.pairs.data(), 5, length, sum.data());
    for (int pair = 0; pair < 5; ++pair)
    {
      for (std::size_t i = 0; i < some.left[pair].size(); ++i)
      {
        for (std::size_t n = 0; n < some.right[pair].size(); ++n)
        {
          expected[i + n] += some.left[pair][i] * some.right[pair][n];
        }
      }
    }
    for (int n = 0; n < length; ++n)
    {
      EXPECT_NEAR(sum[n], expected[n], 1e-13) << n << " of " << length;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
  All, RowProducts, ::testing::ValuesIn(availableInstructionSets()), nameOfSet);

} // namespace
} // namespace hop::testing
