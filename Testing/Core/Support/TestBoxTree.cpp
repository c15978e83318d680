#include "Support/BoxTree.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

std::vector<Bounds> randomBoxes(int count, double size, Random& random)
{
  std::vector<Bounds> boxes;
  for (int n = 0; n < count; ++n)
  {
    const glm::dvec3 lower(random.uniform(), random.uniform(), random.uniform());
    boxes.push_back(
      { lower, lower + size * glm::dvec3(random.uniform(), random.uniform(), random.uniform()) });
  }
  return boxes;
}

std::vector<int> byBruteForce(const std::vector<Bounds>& boxes, const Bounds& query)
{
  std::vector<int> found;
  for (int n = 0; n < static_cast<int>(boxes.size()); ++n)
  {
    if (boxes[n].overlaps(query))
    {
      found.push_back(n);
    }
  }
  return found;
}

TEST(BoxTree, FindsWhatBruteForceFinds)
{
  Random random(3);
  for (const int count : { 0, 1, 4, 5, 6, 33, 500 })
  {
    const std::vector<Bounds> boxes = randomBoxes(count, 0.2, random);
    const BoxTree tree(boxes);
    for (const Bounds& query : randomBoxes(50, 0.3, random))
    {
      EXPECT_EQ(tree.overlapping(query), byBruteForce(boxes, query)) << count;
    }
    EXPECT_EQ(tree.overlapping({ glm::dvec3(-1.0), glm::dvec3(3.0) }).size(), boxes.size());
    EXPECT_TRUE(tree.overlapping({ glm::dvec3(5.0), glm::dvec3(6.0) }).empty());
  }
}

TEST(BoxTree, HoldsBoxesOfEqualPlaceAndOfNoExtent)
{
  const glm::dvec3 point(0.5);
  const BoxTree tree(std::vector<Bounds>(100, { point, point }));
  EXPECT_EQ(tree.overlapping({ point, point }).size(), 100u);
  EXPECT_EQ(tree.overlapping({ glm::dvec3(0.0), point }).size(), 100u);
  EXPECT_TRUE(tree.overlapping({ glm::dvec3(0.0), glm::dvec3(0.4999) }).empty());
}

} // namespace
} // namespace hop::testing
