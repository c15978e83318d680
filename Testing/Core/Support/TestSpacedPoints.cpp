#include "Support/SpacedPoints.h"

#include "ThreadedFor.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

TEST(SpacedPoints, HoldWhatIsSaidOfEachPointWhateverTheThreads)
{
  constexpr std::size_t count = 20000;
  for (const int threads : { 1, 3 })
  {
    const SpacedPoints points(
      count, [](std::size_t i) { return glm::dvec3(i, 2.0 * i, 0.5); },
      [](std::size_t i) { return 0.25 * i; }, threadedFor(threads));
    ASSERT_EQ(points.positions.size(), count);
    ASSERT_EQ(points.spacings.size(), count);
    for (std::size_t i = 0; i < count; ++i)
    {
      ASSERT_EQ(points.positions[i], glm::dvec3(i, 2.0 * i, 0.5));
      ASSERT_EQ(points.spacings[i], 0.25f * static_cast<float>(i));
    }
  }
}

TEST(SpacedPoints, MayBeNone)
{
  const SpacedPoints none(
    0, [](std::size_t) { return glm::dvec3(0.0); }, [](std::size_t) { return 1.0; }, {});
  EXPECT_TRUE(none.positions.empty());
  EXPECT_TRUE(none.spacings.empty());
}

} // namespace
} // namespace hop::testing
