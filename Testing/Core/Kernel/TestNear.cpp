#include "AvailableParts.h"

#include "Support/Random.h"

#include <array>

namespace hop::testing
{
namespace
{

/// Points with spacings between 1/4 and 1/3, in the unit cube, and after them some out of reach, as many as make whole
/// vectors.
struct Crowd
{
  std::array<std::vector<double>, 4> rows;
  std::vector<std::int32_t> indices;
  std::size_t count;

  explicit Crowd(std::size_t pointCount)
    : count(pointCount)
  {
    constexpr double outOfReach = 1e150;
    Random random(5);
    for (std::size_t n = 0; n < this->count || n % kernel::MaximumLanes != 0; ++n)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        this->rows[axis].push_back(n < this->count ? random.uniform() : outOfReach);
      }
      this->rows[3].push_back(3.0 + random.uniform());
      this->indices.push_back(static_cast<std::int32_t>(1000 + 7 * n));
    }
  }

  kernel::Candidates candidates() const
  {
    return { this->rows[0].data(), this->rows[1].data(), this->rows[2].data(), this->rows[3].data(),
      this->indices.data(), static_cast<std::ptrdiff_t>(this->indices.size()) };
  }

  /// d^2 (1/h + 1/h')^2 of two points.
  double scaledDistance2(std::size_t i, std::size_t j) const
  {
    double distance2 = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double d = this->rows[axis][i] - this->rows[axis][j];
      distance2 += d * d;
    }
    const double sum = this->rows[3][i] + this->rows[3][j];
    return distance2 * sum * sum;
  }
};

class Near : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }

  static std::vector<std::int32_t> near(const Crowd& crowd, std::size_t i, double limit)
  {
    const double position[3] = { crowd.rows[0][i], crowd.rows[1][i], crowd.rows[2][i] };
    std::vector<std::int32_t> found(crowd.indices.size());
    const std::int32_t* end =
      kernel::current().near(crowd.candidates(), position, crowd.rows[3][i], limit, found.data());
    found.resize(end - found.data());
    return found;
  }
};

TEST_P(Near, FindsInOrderWhatBruteForceFinds)
{
  constexpr double limit = 9.0;
  for (const std::size_t count : { 1, 7, 8, 9, 100 })
  {
    const Crowd crowd(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      std::vector<std::int32_t> expected;
      for (std::size_t j = 0; j < count; ++j)
      {
        if (crowd.scaledDistance2(i, j) <= limit)
        {
          expected.push_back(crowd.indices[j]);
        }
      }
      EXPECT_EQ(near(crowd, i, limit), expected) << "point " << i << " of " << count;
      EXPECT_TRUE(count < 100 || (expected.size() > 1 && expected.size() < count));
    }
  }
}

TEST_P(Near, IncludesTheLimitAndNothingBeyondIt)
{
  // Numbers that are exact: d = 1 and 1/h + 1/h' = 2.
  Crowd crowd(2);
  crowd.rows[0][0] = crowd.rows[1][0] = crowd.rows[2][0] = 0.0;
  crowd.rows[0][1] = 1.0;
  crowd.rows[1][1] = crowd.rows[2][1] = 0.0;
  crowd.rows[3][0] = crowd.rows[3][1] = 1.0;
  EXPECT_EQ(near(crowd, 0, 4.0).size(), 2u);
  EXPECT_EQ(near(crowd, 1, 4.0).size(), 2u);
  EXPECT_EQ(near(crowd, 0, 3.999), std::vector<std::int32_t>{ crowd.indices[0] });
  EXPECT_EQ(near(crowd, 1, 3.999), std::vector<std::int32_t>{ crowd.indices[1] });
}

INSTANTIATE_TEST_SUITE_P(All, Near, ::testing::ValuesIn(availableInstructionSets()), nameOfSet);

} // namespace
} // namespace hop::testing
