#include "Isolation/PieceBoundaryTest.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

constexpr double slack = 1e-14;

/// Coefficients of a polynomial of u that the element of these degrees holds exactly.
std::vector<double> coefficientsOf(Domain domain, const Degrees& degrees, const Field& f)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = degrees;
  recipe.field = f;
  std::vector<glm::dvec3> corners;
  for (const ReferencePoint& corner : facts(domain).corners)
  {
    corners.push_back(corner.xyz);
  }
  ElementMesh mesh;
  appendElement(mesh, recipe, corners, {});
  std::vector<double> values;
  for (const Coefficient& c : mesh.coefficients)
  {
    values.push_back(c.w);
  }
  return values;
}

bool isCrossedOnce(Domain domain, const Degrees& degrees, const Field& f)
{
  return PieceBoundaryTest(domain, degrees)
    .isCrossedOnce(coefficientsOf(domain, degrees, f), slack);
}

TEST(PieceBoundaryTest, APlaneCrossesOnce)
{
  Random random(1);
  for (const ElementCase& which : allElementCases())
  {
    // Higher degrees: interpolation rounds the edges' slopes.
    if (*std::max_element(which.degrees.begin(), which.degrees.end()) > 4)
    {
      continue;
    }
    for (int n = 0; n < 20; ++n)
    {
      const glm::dvec3 normal = randomVector(random);
      const glm::dvec3 through = randomPoint(which.domain, random).xyz;
      EXPECT_TRUE(isCrossedOnce(which.domain, which.degrees,
        [&](const glm::dvec3& u) { return glm::dot(normal, u - through); }))
        << which;
    }
  }
}

TEST(PieceBoundaryTest, NothingCrossesWhereThereIsNoZero)
{
  for (const Domain domain : allDomains)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      EXPECT_TRUE(isCrossedOnce(
        domain, { 3, 3, 3 }, [sign](const glm::dvec3& u) { return sign * (1.0 + u.x); }));
    }
  }
}

TEST(PieceBoundaryTest, TwoClippedCornersAreTwoPieces)
{
  // f = z + const - (height of a saddle in x and y): it rises along z all over the cube, and cuts off
  // two opposite corners of its floor.
  const Field saddle = [](const glm::dvec3& u)
  { return u.z + 0.9 * (u.x + u.y - 2.0 * u.x * u.y) - 0.3; };
  EXPECT_TRUE(MonotoneTest(Domain::Hexahedron, { 2, 2, 2 })
                .rises(coefficientsOf(Domain::Hexahedron, { 2, 2, 2 }, saddle)));
  EXPECT_FALSE(isCrossedOnce(Domain::Hexahedron, { 2, 2, 2 }, saddle));
}

TEST(PieceBoundaryTest, AClosedCurveInsideAFaceIsSeen)
{
  // A bowl that dips through the floor only, far from its edges.
  for (const Domain domain : allDomains)
  {
    const Field bowl = [](const glm::dvec3& u)
    {
      const glm::dvec2 d = glm::dvec2(u) - 0.3;
      return u.z + glm::dot(d, d) - 0.01;
    };
    EXPECT_FALSE(isCrossedOnce(domain, { 2, 2, 2 }, bowl)) << domain;
  }
}

TEST(PieceBoundaryTest, TwoZerosOnAnEdgeAreSeen)
{
  for (const Domain domain : allDomains)
  {
    const Field twice = [](const glm::dvec3& u) { return (u.x - 0.4) * (u.x - 0.6) + u.y + u.z; };
    EXPECT_FALSE(isCrossedOnce(domain, { 2, 2, 2 }, twice)) << domain;
  }
}

TEST(PieceBoundaryTest, AFieldThatIsZeroOnAFaceIsCrossedOnceAtMost)
{
  for (const Domain domain : allDomains)
  {
    EXPECT_TRUE(isCrossedOnce(domain, { 2, 2, 2 }, [](const glm::dvec3& u) { return u.z; }))
      << domain;
    EXPECT_TRUE(isCrossedOnce(domain, { 2, 2, 2 }, [](const glm::dvec3& u) { return -u.z; }))
      << domain;
  }
}

} // namespace
} // namespace hop::testing
