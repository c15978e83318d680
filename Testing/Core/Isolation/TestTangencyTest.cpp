#include "Isolation/TangencyTest.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

/// The approach of a field over the reference domain, in an element of degree 4.
Approach approachOf(Domain domain, const Field& field, double sign = 1.0)
{
  const ElementMesh mesh = referenceMesh(domain, 4, field);
  return approachToZero(mesh.form(0), sign);
}

class Tangency : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(TangencyTest, Tangency, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(Tangency, OfSquares)
{
  const Domain domain = this->GetParam();
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1.0, -0.4, 0.3));
  const auto distance = [&](const glm::dvec3& x) { return glm::dot(normal, x) - 0.23; };
  const auto square = [&](const glm::dvec3& x) { return distance(x) * distance(x); };
  EXPECT_EQ(approachOf(domain, square), Approach::Tangent);
  EXPECT_EQ(approachOf(
              domain, [&](const glm::dvec3& x) { return -square(x); }, -1.0),
    Approach::Tangent);
  EXPECT_EQ(approachOf(domain, [&](const glm::dvec3& x) { return square(x) * square(x); }),
    Approach::Tangent);
  EXPECT_EQ(approachOf(domain,
              [&](const glm::dvec3& x) { return square(x) * (0.3 + x.x + 2.0 * x.y * x.z); }),
    Approach::Tangent);
}

TEST_P(Tangency, OfSquaresOnFacesEdgesAndCorners)
{
  const Domain domain = this->GetParam();
  EXPECT_EQ(approachOf(domain, [](const glm::dvec3& x) { return x.z * x.z; }), Approach::Tangent);
  EXPECT_EQ(approachOf(domain, [](const glm::dvec3& x) { return x.x * x.x + x.y * x.y; }),
    Approach::Tangent);
  EXPECT_EQ(
    approachOf(domain, [](const glm::dvec3& x) { return glm::dot(x, x); }), Approach::Tangent);
}

TEST_P(Tangency, IsNoneOfTwoSheets)
{
  for (const double apart : { 0.3, 0.1, 0.01 })
  {
    EXPECT_EQ(
      approachOf(this->GetParam(),
        [&](const glm::dvec3& x) { return (x.x - 0.23) * (x.x - 0.23) - 0.25 * apart * apart; }),
      Approach::Crosses)
      << apart;
  }
}

TEST_P(Tangency, IsNoneOfFieldsApartFromZero)
{
  const Domain domain = this->GetParam();
  EXPECT_EQ(
    approachOf(domain, [](const glm::dvec3& x) { return 0.01 + x.x * x.x; }), Approach::Apart);
  EXPECT_EQ(approachOf(domain, [](const glm::dvec3& x) { return 0.1 + x.x; }), Approach::Apart);
  EXPECT_EQ(approachOf(domain, [](const glm::dvec3&) { return 1.0; }), Approach::Apart);
  // A zero at a corner from which the field rises.
  EXPECT_EQ(
    approachOf(domain, [](const glm::dvec3& x) { return x.x + x.y + x.z; }), Approach::Apart);
}

} // namespace
} // namespace hop::testing
