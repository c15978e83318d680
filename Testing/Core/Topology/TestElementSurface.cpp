#include "Topology/ElementSurface.h"

#include "ElementCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

namespace hop::testing
{
namespace
{

/// Leaves of an octree down to a size, of which one in `oneIn` is kept, in the order in which leafAt() wants them.
void addLeaves(Random& random, const Leaf& box, int smallest, int oneIn, std::vector<Leaf>& leaves)
{
  const bool isLeaf = box.size == smallest || randomNumber(random) > 0.9;
  if (isLeaf && static_cast<int>(0.5 * oneIn * (1.0 + randomNumber(random))) == 0)
  {
    leaves.push_back(box);
  }
  for (int octant = 0; octant < 8 && !isLeaf; ++octant)
  {
    const int half = box.size / 2;
    const glm::ivec3 upper(octant >> 2, octant >> 1 & 1, octant & 1);
    addLeaves(random, { box.lower + half * upper, half }, smallest, oneIn, leaves);
  }
}

ElementSurface surfaceOf(std::uint64_t seed, int smallest, int oneIn)
{
  Random random(seed);
  ElementSurface surface;
  addLeaves(random, { glm::ivec3(0), LeafGrid::Size }, smallest, oneIn, surface.leaves);
  return surface;
}

double distanceFrom(const Leaf& leaf, const glm::dvec3& place)
{
  const glm::dvec3 nearest =
    glm::clamp(place, glm::dvec3(leaf.lower), glm::dvec3(leaf.lower + leaf.size));
  return glm::distance(nearest, place);
}

glm::dvec3 randomPlace(Random& random)
{
  return 0.5 + 0.5 * glm::dvec3(randomNumber(random), randomNumber(random), randomNumber(random));
}

TEST(ElementSurface, FindsTheNearestLeaf)
{
  for (const int oneIn : { 1, 3, 100 })
  {
    const ElementSurface surface = surfaceOf(oneIn, LeafGrid::Size / 16, oneIn);
    ASSERT_FALSE(surface.leaves.empty());
    Random random(7);
    for (int n = 0; n < 300; ++n)
    {
      const glm::dvec3 t = randomPlace(random);
      const glm::dvec3 place = LeafGrid::fromCube(t);
      const auto nearest = std::min_element(surface.leaves.begin(), surface.leaves.end(),
        [&](const Leaf& a, const Leaf& b)
        { return distanceFrom(a, place) < distanceFrom(b, place); });
      EXPECT_EQ(surface.leafAt(t), nearest - surface.leaves.begin());
    }
  }
}

/// Where noise leaves most of an element's leaves unproven, most particles stand beside the others.
TEST(ElementSurface, FindsTheNearestOfManyLeavesSoon)
{
  const ElementSurface surface = surfaceOf(1, LeafGrid::Size / 64, 3);
  ASSERT_GT(surface.leaves.size(), 20000U);
  Random random(7);
  const std::clock_t begin = std::clock();
  long sum = 0;
  for (int n = 0; n < 100000; ++n)
  {
    sum += surface.leafAt(randomPlace(random));
  }
  EXPECT_GT(sum, 0);
  // It takes 0.1 s; looking at all leaves took some 20 s.
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 3.0);
}

} // namespace
} // namespace hop::testing
