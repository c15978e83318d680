#include "AvailableParts.h"

#include "Support/Random.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <iterator>
#include <vector>

namespace hop::testing
{
namespace
{

double crossOf(const glm::dvec2& a, const glm::dvec2& b)
{
  return a.x * b.y - a.y * b.x;
}

bool isBehindSegment(const glm::dvec2& place, const kernel::FlatSegment& segment)
{
  const glm::dvec2 a(segment.ax, segment.ay), b(segment.bx, segment.by);
  return crossOf(a, place) > 0.0 && crossOf(place, b) > 0.0 && crossOf(b - a, place - a) < 0.0;
}

/// Whether each place is behind a segment, as the kernel says.
std::vector<bool> hiddenOf(
  const std::vector<glm::dvec2>& places, const std::vector<kernel::FlatSegment>& segments)
{
  const std::size_t lanes = kernel::MaximumLanes;
  const std::size_t count = lanes * ((places.size() + lanes - 1) / lanes);
  std::vector<double> x(count), y(count), hidden(count);
  std::transform(places.begin(), places.end(), x.begin(), [](const glm::dvec2& p) { return p.x; });
  std::transform(places.begin(), places.end(), y.begin(), [](const glm::dvec2& p) { return p.y; });
  kernel::current().hidden({ x.data(), y.data(), static_cast<std::ptrdiff_t>(places.size()),
                             static_cast<std::ptrdiff_t>(count) },
    segments.data(), static_cast<std::ptrdiff_t>(segments.size()), hidden.data());
  std::vector<bool> result;
  std::transform(hidden.begin(), hidden.begin() + static_cast<std::ptrdiff_t>(places.size()),
    std::back_inserter(result), [](double depth) { return depth > 0.0; });
  return result;
}

class Hidden : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }
};

TEST_P(Hidden, IsWhatLiesBehindASegment)
{
  Random random(11);
  const auto anywhere = [&]()
  { return glm::dvec2(4.0 * random.uniform() - 2.0, 4.0 * random.uniform() - 2.0); };
  std::vector<kernel::FlatSegment> segments;
  while (segments.size() < 5)
  {
    const glm::dvec2 a = anywhere(), b = anywhere();
    if (crossOf(a, b) > 0.0)
    {
      segments.push_back({ a.x, a.y, b.x, b.y });
    }
  }
  std::vector<glm::dvec2> places(99);
  std::generate(places.begin(), places.end(), anywhere);
  const std::vector<bool> hidden = hiddenOf(places, segments);
  int count = 0;
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    const bool isBehind = std::any_of(segments.begin(), segments.end(),
      [&](const kernel::FlatSegment& segment) { return isBehindSegment(places[n], segment); });
    EXPECT_EQ(hidden[n], isBehind) << n;
    count += isBehind ? 1 : 0;
  }
  EXPECT_GT(count, 10);
  EXPECT_LT(count, 90);
}

TEST_P(Hidden, AreNoEndsOfSegments)
{
  Random random(12);
  for (int round = 0; round < 500; ++round)
  {
    const glm::dvec2 a(1.0 + random.uniform(), random.uniform() - 0.5);
    const glm::dvec2 b(random.uniform() - 0.5, 1.0 + random.uniform());
    const std::vector<bool> hidden = hiddenOf({ a, b, a + b }, { { a.x, a.y, b.x, b.y } });
    EXPECT_EQ(hidden, (std::vector<bool>{ false, false, true })) << round;
  }
}

TEST_P(Hidden, IsNothingWithoutSegments)
{
  EXPECT_EQ(hiddenOf({ { 1.0, 0.0 }, { 0.0, 0.0 } }, {}), (std::vector<bool>{ false, false }));
}

INSTANTIATE_TEST_SUITE_P(All, Hidden, ::testing::ValuesIn(availableInstructionSets()), nameOfSet);

} // namespace
} // namespace hop::testing
