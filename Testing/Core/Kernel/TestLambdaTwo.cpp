#include "AvailableParts.h"

#include "Elements/SymmetricEigenvalues.h"
#include "Support/Random.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hop::testing
{
namespace
{

/// Gradients in world space and maps at some points, as the kernel wants them: U = G X.
struct GradientsAtPoints
{
  explicit GradientsAtPoints(std::size_t points)
    : numbers(18 * points)
    , count(points)
  {
  }

  /// Rows of matrices: columns of GLM are taken for rows.
  void set(std::size_t point, const glm::dmat3& g, const glm::dmat3& x)
  {
    const glm::dmat3 u = x * g; // the transposed of G X
    for (int n = 0; n < 9; ++n)
    {
      this->numbers[n * this->count + point] = x[n / 3][n % 3];
      this->numbers[(9 + n) * this->count + point] = u[n / 3][n % 3];
    }
  }

  std::vector<double> lambdaTwo() const
  {
    kernel::GradientRows rows{};
    for (int n = 0; n < 9; ++n)
    {
      rows.x[n] = &this->numbers[n * this->count];
      rows.u[n] = &this->numbers[(9 + n) * this->count];
    }
    std::vector<double> result(this->count + 1, 7.0);
    kernel::current().lambdaTwo(rows, static_cast<std::ptrdiff_t>(this->count), result.data());
    EXPECT_EQ(result.back(), 7.0) << "nothing is written behind the end";
    result.pop_back();
    return result;
  }

  std::vector<double> numbers;
  std::size_t count;
};

class LambdaTwo : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }
};

glm::dmat3 randomMatrix(Random& random)
{
  glm::dmat3 matrix;
  for (int n = 0; n < 9; ++n)
  {
    matrix[n / 3][n % 3] = 2.0 * random.uniform() - 1.0;
  }
  return matrix;
}

/// Beside Jacobi's rotations, of all numbers of points that leave something over beside whole vectors.
TEST_P(LambdaTwo, IsTheMiddleEigenvalue)
{
  Random random(5);
  for (std::size_t count = 1; count <= 19; ++count)
  {
    GradientsAtPoints points(count);
    std::vector<double> expected;
    for (std::size_t n = 0; n < count; ++n)
    {
      const glm::dmat3 g = randomMatrix(random);
      points.set(n, g, glm::dmat3(1.0) + 0.3 * randomMatrix(random));
      const glm::dmat3 square = g * g;
      expected.push_back(eigensystemOf(0.5 * (square + glm::transpose(square))).values.y);
    }
    const std::vector<double> lambda = points.lambdaTwo();
    for (std::size_t n = 0; n < count; ++n)
    {
      EXPECT_NEAR(lambda[n], expected[n], 2e-14) << n << " of " << count;
    }
  }
}

/// Q D Q^T squared, of any size: with two equal eigenvalues the error is the root of a rounding.
TEST_P(LambdaTwo, IsFoundBesideEqualEigenvalues)
{
  Random random(24);
  for (const double size : { 1e-60, 1.0, 1e60 })
  {
    for (const double gap : { 0.0, 1e-12, 1e-9, 1e-6, 1e-3 })
    {
      GradientsAtPoints points(40);
      std::vector<double> expected;
      for (std::size_t n = 0; n < points.count; ++n)
      {
        const glm::dmat3 q = eigensystemOf(0.5 * (glm::dmat3(1.0) + randomMatrix(random))).vectors;
        const double a = size * random.uniform();
        const glm::dvec3 values(a, a + gap * size, size * random.uniform());
        const glm::dmat3 d(glm::dvec3(values.x, 0.0, 0.0), glm::dvec3(0.0, values.y, 0.0),
          glm::dvec3(0.0, 0.0, values.z));
        points.set(n, q * d * glm::transpose(q), glm::dmat3(1.0));
        const double middle =
          std::max(std::min(values.x, values.y), std::min(std::max(values.x, values.y), values.z));
        expected.push_back(middle * middle);
      }
      const std::vector<double> lambda = points.lambdaTwo();
      for (std::size_t n = 0; n < points.count; ++n)
      {
        EXPECT_NEAR(lambda[n], expected[n], 4e-8 * size * size) << size << ", " << gap;
      }
    }
  }
}

TEST_P(LambdaTwo, OfNoGradientIsZeroAndOfASingularMapNotFinite)
{
  GradientsAtPoints points(3);
  points.set(0, glm::dmat3(0.0), glm::dmat3(1.0));
  points.set(1, glm::dmat3(2.0), glm::dmat3(3.0));
  points.set(2, glm::dmat3(1.0), glm::dmat3(0.0));
  const std::vector<double> lambda = points.lambdaTwo();
  EXPECT_EQ(lambda[0], 0.0);
  EXPECT_DOUBLE_EQ(lambda[1], 4.0);
  EXPECT_FALSE(std::isfinite(lambda[2]));
}

INSTANTIATE_TEST_SUITE_P(
  All, LambdaTwo, ::testing::ValuesIn(availableInstructionSets()), nameOfSet);

} // namespace
} // namespace hop::testing
