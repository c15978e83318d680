#include "Isolation/SizingField.h"

#include "ElementCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr SizingFunction sizing{ 0.5, 10.0 };

/// Places in a cube of side 2, with spacings of 0.05 to 0.5.
std::vector<SizingField::Limit> randomLimits(int count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<SizingField::Limit> limits;
  for (int n = 0; n < count; ++n)
  {
    const glm::dvec3 position = randomVector(random);
    limits.push_back({ position, static_cast<float>(0.05 + 0.45 * random.uniform()) });
  }
  return limits;
}

TEST(SizingField, IsTheSizingFunctionWithoutPlaces)
{
  const SizingField field(sizing);
  for (const float curvature : { 0.0f, 1.0f, 20.0f })
  {
    EXPECT_EQ(field.at({ 1, 2, 3 }, curvature), static_cast<float>(sizing.at(curvature)));
  }
  EXPECT_EQ(field.placeCount(), 0u);
}

TEST(SizingField, GrowsByTheSlopeAroundAPlace)
{
  SizingField field(sizing);
  const glm::dvec3 place(0.2, -0.3, 0.1);
  constexpr float spacing = 0.1f;
  field.add({ { place, spacing } }, {});
  const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 2, -1));
  for (double distance = 0.0; distance < 0.39; distance += 0.03)
  {
    EXPECT_NEAR(field.at(place + distance * direction, 0.0f),
      spacing + SizingField::GradationSlope * distance, 1e-6);
  }
  EXPECT_EQ(field.at(place + 5.0 * direction, 0.0f), 0.5f) << "far from the place";
  EXPECT_EQ(field.limited(place, 0.04f), 0.04f) << "less is left as it is";
}

TEST(SizingField, ItsPlacesKeepToTheGradation)
{
  const std::vector<SizingField::Limit> limits = randomLimits(400, 1);
  SizingField field(sizing);
  field.add(limits, {});
  std::size_t lowered = 0;
  for (const SizingField::Limit& limit : limits)
  {
    float least = limit.spacing;
    for (const SizingField::Limit& other : limits)
    {
      least = std::min(least,
        static_cast<float>(other.spacing +
          SizingField::GradationSlope * glm::distance(limit.position, other.position)));
    }
    EXPECT_FLOAT_EQ(field.limited(limit.position, limit.spacing), least);
    lowered += least < limit.spacing;
  }
  EXPECT_GT(lowered, 100u);
  EXPECT_EQ(field.placeCount(), limits.size() - lowered);
}

TEST(SizingField, LaterPlacesLimitEarlierOnes)
{
  SizingField field(sizing);
  const glm::dvec3 first(0.0), far(0.0, 0.0, 1.9), near(-0.2, 0.0, 0.0);
  field.add({ { first, 0.4f }, { far, 0.5f }, { near, 0.5f } }, {});
  EXPECT_EQ(field.limited(first, 0.4f), 0.4f);
  EXPECT_NEAR(field.limited(near, 0.5f), 0.4 + 0.2 * SizingField::GradationSlope, 1e-6);
  EXPECT_EQ(field.placeCount(), 2u);
  field.add({ { glm::dvec3(0.1, 0.0, 0.0), 0.1f } }, {});
  EXPECT_NEAR(field.limited(first, 0.4f), 0.1 + 0.1 * SizingField::GradationSlope, 1e-6);
  EXPECT_EQ(field.limited(far, 0.5f), 0.5f);
  EXPECT_NEAR(field.limited(near, 0.5f), 0.1 + 0.3 * SizingField::GradationSlope, 1e-6);
  EXPECT_EQ(field.placeCount(), 2u);
}

/// How many of some places are representatives, if most places are far from each other and some are in one place.
std::ptrdiff_t representativesWithCrowd(int crowd)
{
  std::vector<glm::dvec3> positions(crowd, glm::dvec3(0.123, 0.234, 0.345));
  for (const SizingField::Limit& limit : randomLimits(100, 2))
  {
    positions.push_back(2.0 * limit.position);
  }
  const std::vector<float> spacings(positions.size(), 0.1f);
  const std::vector<char> marks = markRepresentatives(positions, spacings);
  return std::count(marks.begin(), marks.end(), 1);
}

TEST(SizingField, OfFewPlacesInACellAllAreRepresentatives)
{
  EXPECT_EQ(representativesWithCrowd(0), 100);
  EXPECT_EQ(representativesWithCrowd(16), 116);
  EXPECT_EQ(representativesWithCrowd(17), 101) << "one of the crowd";
}

TEST(SizingField, OfDensePlacesOneInEachNeighbourhoodIsARepresentative)
{
  Random random(3);
  std::vector<glm::dvec3> positions;
  std::vector<float> spacings;
  for (int n = 0; n < 5000; ++n)
  {
    positions.push_back(0.5 * randomVector(random));
    spacings.push_back(static_cast<float>(0.3 + 0.2 * random.uniform()));
  }
  const std::vector<char> marks = markRepresentatives(positions, spacings);
  // Cells are half a spacing wide at most.
  const double cellDiagonal = std::sqrt(3.0) * 0.5 * 0.5;
  const auto marked = std::count(marks.begin(), marks.end(), 1);
  EXPECT_LT(marked, 1500);
  EXPECT_GT(marked, 100);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    bool hasRepresentative = false;
    for (std::size_t j = 0; j < positions.size() && !hasRepresentative; ++j)
    {
      hasRepresentative = marks[j] && spacings[j] <= spacings[i] &&
        glm::distance(positions[i], positions[j]) <= cellDiagonal;
    }
    EXPECT_TRUE(hasRepresentative) << i;
  }
}

} // namespace
} // namespace hop::testing
