#include "Support/GradationTree.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double slope = 0.25;

std::vector<GradationTree::Place> randomPlaces(int count)
{
  Random random(7);
  std::vector<GradationTree::Place> places;
  for (int n = 0; n < count; ++n)
  {
    const double x = random.uniform();
    const double y = random.uniform();
    const double z = 0.1 * random.uniform();
    places.push_back({ { x, y, z }, static_cast<float>(0.01 + 0.2 * random.uniform()) });
  }
  return places;
}

TEST(GradationTree, FindsTheLeastOfAllLimits)
{
  for (const int count : { 1, 2, 7, 100, 3000 })
  {
    const std::vector<GradationTree::Place> places = randomPlaces(count);
    const GradationTree tree(places, slope);
    ASSERT_EQ(tree.places().size(), places.size());
    int lowered = 0;
    for (const GradationTree::Place& at : randomPlaces(500))
    {
      // Places around the box of all of them, too.
      const glm::dvec3 position = 1.5 * at.position - 0.2;
      constexpr float wanted = 0.15f;
      double least = wanted;
      for (const GradationTree::Place& place : places)
      {
        least = std::min(least, place.spacing + slope * glm::distance(position, place.position));
      }
      EXPECT_FLOAT_EQ(tree.limited(position, wanted), static_cast<float>(least));
      lowered += least < wanted;
    }
    EXPECT_TRUE(count < 100 || lowered > 100) << count;
  }
}

TEST(GradationTree, OneSearchTellsTheLimitsInABall)
{
  constexpr float wanted = 0.15f;
  const std::vector<GradationTree::Place> places = randomPlaces(3000);
  const GradationTree tree(places, slope);
  Random random(3);
  const auto uniform = [&]() { return 2.0 * random.uniform() - 1.0; };
  std::vector<GradationTree::Place> around;
  std::size_t most = 0;
  for (const GradationTree::Place& at : randomPlaces(200))
  {
    for (const double radius : { 0.0, 0.01, 0.1 })
    {
      const glm::dvec3 center = 1.5 * at.position - 0.2;
      tree.findAround(center, radius, wanted, around);
      most = std::max(most, around.size());
      for (int n = 0; n < 20; ++n)
      {
        const double x = uniform();
        const double y = uniform();
        const double z = uniform();
        const glm::dvec3 position = center + radius / std::sqrt(3.0) * glm::dvec3(x, y, z);
        EXPECT_EQ(tree.limited(position, wanted, around), tree.limited(position, wanted));
      }
    }
  }
  EXPECT_GT(most, 1u);
  EXPECT_LT(most, 300u); // a tenth of all
}

TEST(GradationTree, MayBeEmptyOrHaveAllPlacesInOne)
{
  EXPECT_EQ(GradationTree({}, slope).limited(glm::dvec3(0.0), 0.3f), 0.3f);
  const GradationTree one(
    std::vector<GradationTree::Place>(1000, { glm::dvec3(1.0), 0.1f }), slope);
  EXPECT_EQ(one.limited(glm::dvec3(1.0), 0.3f), 0.1f);
  EXPECT_EQ(one.limited(glm::dvec3(1.0), 0.05f), 0.05f);
}

} // namespace
} // namespace hop::testing
