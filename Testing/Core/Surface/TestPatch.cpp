#include "Surface/Patch.h"

#include "ElementCases.h"
#include "Surface/Energy.h"

#include <gtest/gtest.h>

#include <vector>

namespace hop::testing
{
namespace
{

/// Normals in all directions, along the axes too.
std::vector<glm::vec3> manyNormals()
{
  std::vector<glm::vec3> normals{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 }, { 0, -1, 0 },
    { 0, 0, -1 }, { 0.6f, 0.8f, 0.0f }, { -0.6f, 0.0f, 0.8f } };
  Random random(1);
  while (normals.size() < 200)
  {
    const glm::dvec3 v = randomVector(random);
    if (glm::length(v) > 0.1)
    {
      normals.emplace_back(glm::normalize(v));
    }
  }
  return normals;
}

Patch patchAt(const glm::dvec3& position, const glm::vec3& normal, double xx, double xy, double yy)
{
  Patch patch;
  patch.position = position;
  patch.normal = normal;
  patch.shape = { static_cast<float>(xx), static_cast<float>(xy), static_cast<float>(yy) };
  return patch;
}

TEST(Patch, TangentsAndNormalAreARightHandedBasis)
{
  for (const glm::vec3& normal : manyNormals())
  {
    const auto [e1, e2] = tangentsOf(normal);
    EXPECT_NEAR(glm::length(e1), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::length(e2), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::dot(e1, e2), 0.0f, 1e-6f);
    EXPECT_LE(glm::distance(glm::cross(e1, e2), normal), 1e-6f);
  }
}

TEST(Patch, OfASphereFollowsItToFourthOrder)
{
  constexpr double radius = 0.8;
  const glm::dvec3 centre(0.1, -0.2, 0.3);
  for (const glm::vec3& normal : manyNormals())
  {
    const Patch patch =
      patchAt(centre + radius * glm::dvec3(normal), normal, 1.0 / radius, 0.0, 1.0 / radius);
    for (const double length : { 0.0, 0.1, 0.2, 0.4 })
    {
      const glm::vec2 t(0.6 * length, -0.8 * length);
      // The paraboloid's distance from the centre is sqrt(r^2 + t^4 / (4 r^2)), about r + t^4 / (8 r^3).
      EXPECT_NEAR(glm::distance(patch.position + patch.step(t), centre),
        std::hypot(radius, length * length / (2.0 * radius)), 1e-6);
    }
  }
}

TEST(Patch, SlopeIsTheGradientOfItsSink)
{
  const Patch patch = patchAt({}, { 0, 0, 1 }, 1.5, -0.7, 0.3);
  constexpr double h = 1e-4;
  for (const glm::dvec2& t : { glm::dvec2(0.0), glm::dvec2(0.3, -0.2), glm::dvec2(-1.0, 2.0) })
  {
    const glm::dvec2 slope = patch.slope(t);
    for (int axis = 0; axis < 2; ++axis)
    {
      glm::dvec2 step(0.0);
      step[axis] = h;
      EXPECT_NEAR(slope[axis], (patch.sink(t + step) - patch.sink(t - step)) / (2.0 * h), 1e-6);
    }
  }
}

TEST(Patch, SinksByHalfTheCurvatureTimesTheSquare)
{
  const Patch patch = patchAt({}, { 0, 0, 1 }, 1.5, -0.5, 0.25);
  EXPECT_DOUBLE_EQ(patch.sink(glm::dvec2(2.0, 0.0)), 0.5 * 1.5 * 4.0);
  EXPECT_DOUBLE_EQ(patch.sink(glm::dvec2(0.0, 2.0)), 0.5 * 0.25 * 4.0);
  EXPECT_DOUBLE_EQ(patch.sink(glm::dvec2(1.0, 1.0)), 0.5 * (1.5 - 2.0 * 0.5 + 0.25));
}

TEST(Patch, PlacesInThePlaneAndHeightsUndoSteps)
{
  Random random(2);
  for (const glm::vec3& normal : manyNormals())
  {
    const Patch patch = patchAt(randomVector(random), normal, randomNumber(random),
      randomNumber(random), randomNumber(random));
    const glm::dvec2 t(randomNumber(random), randomNumber(random));
    const glm::dvec3 on = patch.position + patch.step(glm::vec2(t));
    EXPECT_LE(glm::distance(patch.inPlane(on), t), 1e-5);
    EXPECT_NEAR(patch.heightOf(on), 0.0, 1e-5);
    EXPECT_NEAR(patch.heightOf(on + 0.25 * glm::dvec3(normal)), 0.25, 1e-5) << "above";
    EXPECT_NEAR(patch.heightOf(on - 0.25 * glm::dvec3(normal)), -0.25, 1e-5) << "below";
  }
}

TEST(Patch, CurvatureMagnitudeDoesNotDependOnTheDirections)
{
  // Principal curvatures 3 and -4, turned by any angle.
  for (double angle = 0.0; angle < Pi; angle += 0.1)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    const Patch patch =
      patchAt({}, { 0, 0, 1 }, 3.0 * c * c - 4.0 * s * s, 7.0 * c * s, 3.0 * s * s - 4.0 * c * c);
    EXPECT_NEAR(patch.curvatureMagnitude(), 5.0f, 1e-5f) << angle;
  }
}

TEST(Patch, PositionsAndSpacingsOfAll)
{
  Buffer<Patch> patches(3);
  for (int i = 0; i < 3; ++i)
  {
    patches[i] = patchAt(glm::dvec3(i, 2 * i, -i), { 0, 0, 1 }, 0, 0, 0);
    patches[i].spacing = 0.5f + static_cast<float>(i);
  }
  const SpacedPoints points = spacedPoints(patches, {});
  ASSERT_EQ(points.positions.size(), 3u);
  ASSERT_EQ(points.spacings.size(), 3u);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(points.positions[i], patches[i].position);
    EXPECT_EQ(points.spacings[i], patches[i].spacing);
  }
}

} // namespace
} // namespace hop::testing
