#include "Isolation/ProxyPolygons.h"

#include "AnalyticFields.h"
#include "Isolation/SurfaceBoxes.h"
#include "PieceCases.h"

#include <cmath>
#include <numeric>

namespace hop::testing
{
namespace
{

/// The box that is all of a domain, with a field's values at its corners.
SurfaceBox boxOfDomain(Domain domain, const Field& field)
{
  SurfaceBox box;
  box.middle = { 0, middleOf(facts(domain)) };
  const auto& corners = facts(domain).corners;
  for (std::size_t c = 0; c < corners.size(); ++c)
  {
    box.corners[c] = glm::vec3(corners[c].xyz);
    box.values[c] = static_cast<float>(field(corners[c].xyz));
  }
  return box;
}

std::vector<ReferenceTriangle> trianglesOf(Domain domain, const SurfaceBox& box)
{
  std::vector<ReferenceTriangle> triangles;
  appendProxyTriangles(domain, box, triangles);
  return triangles;
}

double areaOf(const std::vector<ReferenceTriangle>& triangles)
{
  return std::accumulate(triangles.begin(), triangles.end(), 0.0,
    [](double sum, const ReferenceTriangle& t)
    { return sum + 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0])); });
}

/// Area in which a plane through a place cuts a domain: a large square of the plane, clipped by the half-spaces of the
/// faces one after the other.
double exactArea(Domain domain, const glm::dvec3& normal, const glm::dvec3& through)
{
  const glm::dvec3 aside = glm::normalize(
    glm::cross(normal, std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(normal, aside);
  constexpr double large = 10.0;
  std::vector<glm::dvec3> polygon{ through + large * aside, through + large * up,
    through - large * aside, through - large * up };
  for (const Face& face : facts(domain).faces)
  {
    std::vector<glm::dvec3> clipped;
    for (std::size_t n = 0; n < polygon.size(); ++n)
    {
      const glm::dvec3& a = polygon[n];
      const glm::dvec3& b = polygon[(n + 1) % polygon.size()];
      const double atA = faceMargin(face, { a });
      const double atB = faceMargin(face, { b });
      if (atA >= 0.0)
      {
        clipped.push_back(a);
      }
      if ((atA >= 0.0) != (atB >= 0.0))
      {
        clipped.push_back(a + atA / (atA - atB) * (b - a));
      }
    }
    polygon = std::move(clipped);
  }
  glm::dvec3 twice(0.0);
  for (std::size_t n = 2; n < polygon.size(); ++n)
  {
    twice += glm::cross(polygon[n - 1] - polygon[0], polygon[n] - polygon[0]);
  }
  return 0.5 * glm::length(twice);
}

TEST(ProxyPolygons, OfPlanesThroughTheCubeHaveTheirKnownAreas)
{
  const auto areaAt = [](const glm::dvec3& normal, double offset)
  {
    return areaOf(trianglesOf(Domain::Hexahedron,
      boxOfDomain(
        Domain::Hexahedron, [&](const glm::dvec3& u) { return glm::dot(normal, u) - offset; })));
  };
  EXPECT_NEAR(areaAt({ 0, 0, 1 }, 0.3), 1.0, 1e-6);
  EXPECT_NEAR(areaAt({ 1, 1, 0 }, 1.0), std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(areaAt({ 1, 1, 1 }, 1.0), std::sqrt(3.0) / 2.0, 1e-6) << "a triangle of side sqrt(2)";
  EXPECT_NEAR(areaAt({ 1, 1, 1 }, 1.5), 3.0 * std::sqrt(3.0) / 4.0, 1e-6)
    << "a hexagon of side 1/sqrt(2)";
}

class ProxyPolygons : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(ProxyPolygons, ProxyPolygons, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(ProxyPolygons, OfPlanesAreExact)
{
  Random random(1);
  for (int n = 0; n < 200; ++n)
  {
    const glm::dvec3 normal = glm::normalize(randomVector(random));
    const glm::dvec3 through = randomPoint(this->GetParam(), random).xyz;
    const Field field = [&](const glm::dvec3& u) { return glm::dot(normal, u - through); };
    const auto triangles = trianglesOf(this->GetParam(), boxOfDomain(this->GetParam(), field));
    EXPECT_NEAR(areaOf(triangles), exactArea(this->GetParam(), normal, through), 1e-5);
    for (const ReferenceTriangle& triangle : triangles)
    {
      for (const glm::vec3& corner : triangle)
      {
        EXPECT_NEAR(field(glm::dvec3(corner)), 0.0, 1e-6);
        EXPECT_GE(insideMargin(this->GetParam(), { glm::dvec3(corner) }), -1e-6);
      }
    }
  }
}

TEST_P(ProxyPolygons, AreTheSameForTheNegativeField)
{
  Random random(2);
  for (int n = 0; n < 50; ++n)
  {
    SurfaceBox box =
      boxOfDomain(this->GetParam(), [&](const glm::dvec3&) { return randomNumber(random); });
    const double area = areaOf(trianglesOf(this->GetParam(), box));
    for (float& value : box.values)
    {
      value = -value;
    }
    EXPECT_NEAR(areaOf(trianglesOf(this->GetParam(), box)), area, 1e-5);
  }
}

TEST_P(ProxyPolygons, AreNoneWithoutAChangeOfSign)
{
  for (const double sign : { 1.0, -1.0 })
  {
    const SurfaceBox box = boxOfDomain(this->GetParam(), [=](const glm::dvec3&) { return sign; });
    EXPECT_TRUE(trianglesOf(this->GetParam(), box).empty());
    EXPECT_EQ(proxyMiddle(this->GetParam(), box).xyz, box.middle.u.xyz);
  }
}

TEST_P(ProxyPolygons, ZeroCountsAsBelow)
{
  const auto areaOfFloor = [&](double sign)
  {
    return areaOf(trianglesOf(this->GetParam(),
      boxOfDomain(this->GetParam(), [=](const glm::dvec3& u) { return sign * u.z; })));
  };
  EXPECT_NEAR(areaOfFloor(1.0), this->GetParam() == Domain::Hexahedron ? 1.0 : 0.5, 1e-6);
  EXPECT_EQ(areaOfFloor(-1.0), 0.0);
}

TEST_P(ProxyPolygons, TheMiddleIsTheCentroid)
{
  const SurfaceBox box =
    boxOfDomain(this->GetParam(), [](const glm::dvec3& u) { return u.z - 0.4; });
  const glm::dvec3 middle = proxyMiddle(this->GetParam(), box).xyz;
  // Of a square of side 1, and of triangles with right angles and sides of 1, or 0.6 in the tetrahedron.
  const double expected = this->GetParam() == Domain::Hexahedron ? 0.5
    : this->GetParam() == Domain::Wedge                          ? 1.0 / 3.0
                                                                 : 0.2;
  EXPECT_NEAR(middle.x, expected, 1e-6);
  EXPECT_NEAR(middle.y, expected, 1e-6);
  EXPECT_NEAR(middle.z, 0.4, 1e-6);
}

TEST_P(ProxyPolygons, OfSmallBoxesHaveTheAreaOfASphere)
{
  constexpr double radius = 0.15;
  const WholeElement element(
    this->GetParam(), 2, sphere(glm::dvec3(0.22, 0.24, 0.23), radius).field);
  double area = 0.0;
  for (const SurfaceBox& box : findSurfaceBoxes(element.mesh, 0.0, 0.03, {}))
  {
    area += areaOf(trianglesOf(this->GetParam(), box));
  }
  const double exact = 4.0 * std::acos(-1.0) * radius * radius;
  EXPECT_NEAR(area, exact, 0.01 * exact);
  EXPECT_LT(area, exact) << "chords are shorter than arcs";
}

} // namespace
} // namespace hop::testing
