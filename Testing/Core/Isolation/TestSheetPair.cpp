#include "Isolation/SheetPair.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

std::optional<SheetPair> pairIn(Domain domain, int degree, const Field& field, double slack = 1e-14)
{
  const ElementMesh mesh = referenceMesh(domain, degree, field);
  const BernsteinForm form = mesh.form(0);
  return findSheetPair(form, MonotoneTest(domain, form.degrees), slack);
}

class PairIn : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(SheetPair, PairIn, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(PairIn, IsFoundWhateverItsDirectionAndSign)
{
  Random random(1);
  for (const double gap : { 0.1, 1e-2, 1e-4 })
  {
    for (int trial = 0; trial < 20; ++trial)
    {
      const glm::dvec3 normal = glm::normalize(randomVector(random));
      const double at = glm::dot(normal, randomPoint(this->GetParam(), random).xyz);
      const double sign = trial % 2 == 0 ? 1.0 : -1.0;
      const auto pair = pairIn(this->GetParam(), 2,
        [&](const glm::dvec3& x)
        {
          const double distance = glm::dot(normal, x) - at;
          return sign * (distance * distance - 0.25 * gap * gap);
        });
      ASSERT_TRUE(pair) << gap;
      EXPECT_EQ(pair->outside, sign);
      EXPECT_NEAR(glm::dot(normal, pair->between) - at, 0.0, 1e-9);
      double sides = 1.0;
      for (const SheetPair::Sheet& sheet : pair->sheets)
      {
        const double distance = glm::dot(normal, sheet.place) - at;
        EXPECT_NEAR(std::abs(distance), 0.5 * gap, 1e-9);
        const auto& corners = facts(this->GetParam()).corners;
        for (std::size_t c = 0; c < corners.size(); ++c)
        {
          const double ahead = glm::dot(normal, corners[c].xyz - sheet.place);
          const double wanted = 2.0 * sign * distance * ahead;
          EXPECT_NEAR(sheet.values[c], wanted, 0.2 * std::abs(wanted) + 1e-12);
        }
        EXPECT_NEAR(sheet.reach, 0.5 * gap * gap, 1e-9);
        sides *= distance;
      }
      EXPECT_LT(sides, 0.0) << "one on each side";
    }
  }
}

TEST_P(PairIn, IsNeitherASingleSheetNorATangencyNorNothing)
{
  const auto distance = [](const glm::dvec3& x) { return 0.3 * x.x + 0.2 * x.y + x.z - 0.4; };
  const auto square = [&](const glm::dvec3& x) { return distance(x) * distance(x); };
  const Domain domain = this->GetParam();
  EXPECT_FALSE(pairIn(domain, 2, distance));
  EXPECT_FALSE(pairIn(domain, 2, square));
  EXPECT_FALSE(pairIn(domain, 2, [&](const glm::dvec3& x) { return square(x) + 1e-5; }));
  EXPECT_FALSE(pairIn(
    domain, 2, [&](const glm::dvec3& x) { return square(x) - 1e-8; }, 1e-7));
  EXPECT_FALSE(pairIn(domain, 2, [](const glm::dvec3&) { return 0.0; }));
}

TEST_P(PairIn, IsNoneWhereTheTwoMeetOrThereAreThree)
{
  const Domain domain = this->GetParam();
  // A lens that ends within the element, and three sheets.
  EXPECT_FALSE(pairIn(domain, 2,
    [](const glm::dvec3& x)
    {
      const double z = x.z - 0.3;
      return z * z + 0.01 * (x.x * x.x + x.y * x.y) - 0.0016;
    }));
  EXPECT_FALSE(
    pairIn(domain, 3, [](const glm::dvec3& x) { return (x.z - 0.1) * (x.z - 0.2) * (x.z - 0.3); }));
}

TEST_P(PairIn, ItsSheetsMayBend)
{
  const auto height = [](const glm::dvec3& x)
  { return x.z - 0.3 - 0.02 * x.x * x.x + 0.03 * x.x * x.y; };
  const Field film = [&](const glm::dvec3& x) { return height(x) * height(x) - 1e-4; };
  const ElementMesh mesh = referenceMesh(this->GetParam(), 4, film);
  const BernsteinForm form = mesh.form(0);
  const auto pair = findSheetPair(form, MonotoneTest(form.domain, form.degrees), 1e-14);
  ASSERT_TRUE(pair);
  for (const SheetPair::Sheet& sheet : pair->sheets)
  {
    EXPECT_NEAR(film(sheet.place), 0.0, 1e-12);
  }
  EXPECT_LT(height(pair->sheets[0].place) * height(pair->sheets[1].place), 0.0);
}

} // namespace
} // namespace hop::testing
