#include "AvailableParts.h"

#include "Support/Random.h"

#include <algorithm>
#include <vector>

namespace hop::testing
{
namespace
{

class MatrixRows : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }
};

std::vector<double> randomNumbers(std::size_t count, Random& random)
{
  std::vector<double> numbers(count);
  std::generate(numbers.begin(), numbers.end(), [&] { return 2.0 * random.uniform() - 1.0; });
  return numbers;
}

/// Of all shapes that leave something over beside whole vectors and sets of rows.
TEST_P(MatrixRows, AreMultiplied)
{
  Random random(4);
  for (int rows = 1; rows <= 19; ++rows)
  {
    const int columns = 1 + rows % 6;
    for (int width = 1; width <= 20; ++width)
    {
      const std::vector<double> matrix = randomNumbers(rows * columns, random);
      const std::vector<double> values = randomNumbers(columns * width, random);
      std::vector<double> result(rows * width + 1, 7.0);
      kernel::current().matrix(matrix.data(), rows, columns, values.data(), width, result.data());
      for (int row = 0; row < rows; ++row)
      {
        for (int c = 0; c < width; ++c)
        {
          double expected = 0.0;
          for (int k = 0; k < columns; ++k)
          {
            expected += matrix[row * columns + k] * values[k * width + c];
          }
          EXPECT_NEAR(result[row * width + c], expected, 1e-14);
        }
      }
      EXPECT_EQ(result.back(), 7.0) << "nothing is written behind the end";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
  All, MatrixRows, ::testing::ValuesIn(availableInstructionSets()), nameOfSet);

} // namespace
} // namespace hop::testing
