#include "AvailableParts.h"

#include "ElementCases.h"
#include "Elements/Bisection.h"
#include "Support/Random.h"

#include <algorithm>

namespace hop::testing
{
namespace
{

class Lines : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }
};

std::vector<Coefficient> randomCoefficients(std::size_t count)
{
  Random random(7);
  std::vector<Coefficient> coefficients(count);
  for (Coefficient& c : coefficients)
  {
    c = { random.uniform() - 0.5, random.uniform(), -random.uniform(), random.uniform() - 0.5 };
  }
  return coefficients;
}

/// Calls use(lines, coefficients) for the lines along each edge of all elements.
template <class Use>
void forAllLines(const Use& use)
{
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    for (const LatticePoint& direction : facts(which.domain).edgeDirections)
    {
      const LatticeLines lines(which.domain, which.degrees, direction);
      use(lines, randomCoefficients(coefficientCount(which.domain, which.degrees)));
    }
  }
}

TEST_P(Lines, AreBisectedToTheBitsOfPlainCode)
{
  forAllLines(
    [](const LatticeLines& lines, std::vector<Coefficient> first)
    {
      Buffer<Coefficient> firstOfKernel(first.begin(), first.end());
      std::vector<Coefficient> second;
      Buffer<Coefficient> secondOfKernel;
      lines.bisect(first, second);
      lines.bisect(firstOfKernel, secondOfKernel);
      EXPECT_TRUE(std::equal(first.begin(), first.end(), firstOfKernel.begin()));
      ASSERT_EQ(secondOfKernel.size(), second.size());
      EXPECT_TRUE(std::equal(second.begin(), second.end(), secondOfKernel.begin()));
    });
}

/// Several lines at a time, of which some have not all of the same length.
TEST_P(Lines, OfNumbersAreBisectedToTheSameBits)
{
  forAllLines(
    [](const LatticeLines& lines, std::vector<Coefficient> first)
    {
      std::vector<double> numbers;
      for (const Coefficient& c : first)
      {
        numbers.push_back(c.x);
      }
      std::vector<Coefficient> second;
      std::vector<double> secondNumbers;
      lines.bisect(first, second);
      lines.bisect(numbers, secondNumbers);
      ASSERT_EQ(secondNumbers.size(), second.size());
      for (std::size_t i = 0; i < first.size(); ++i)
      {
        EXPECT_EQ(numbers[i], first[i].x);
        EXPECT_EQ(secondNumbers[i], second[i].x);
      }
    });
}

TEST_P(Lines, BoundsAreThoseOfEachComponent)
{
  for (const std::size_t count : { 1, 2, 3, 4, 5, 8, 11, 64 })
  {
    SCOPED_TRACE(count);
    const std::vector<Coefficient> points = randomCoefficients(count);
    const auto [lower, upper] =
      kernel::current().bounds(&points.front().x, static_cast<std::ptrdiff_t>(count));
    for (int c = 0; c < 4; ++c)
    {
      const auto [least, greatest] = std::minmax_element(points.begin(), points.end(),
        [&](const Coefficient& a, const Coefficient& b) { return a[c] < b[c]; });
      EXPECT_EQ(lower[c], (*least)[c]);
      EXPECT_EQ(upper[c], (*greatest)[c]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Lines, ::testing::ValuesIn(availableInstructionSets()), nameOfSet);

} // namespace
} // namespace hop::testing
