#include "Elements/ReferencePart.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <map>
#include <tuple>

namespace hop::testing
{
namespace
{

constexpr std::array<Domain, 3> allDomains{ Domain::Hexahedron, Domain::Tetrahedron,
  Domain::Wedge };

TEST(ReferencePart, FillTheDomain)
{
  for (const Domain domain : allDomains)
  {
    for (int halvings = 0; halvings < 3; ++halvings)
    {
      const std::vector<ReferencePart> parts = partsOf(domain, halvings);
      EXPECT_EQ(parts.size(), std::size_t(1) << (3 * halvings));
      double volume = 0.0;
      for (const ReferencePart& part : parts)
      {
        EXPECT_GT(glm::determinant(part.axes), 0.0);
        volume += glm::determinant(part.axes);
        for (const ReferencePoint& corner : facts(domain).corners)
        {
          EXPECT_GE(insideMargin(domain, part.inWhole(corner)), -1e-14);
        }
      }
      EXPECT_NEAR(volume, 1.0, 1e-14);
    }
  }
}

/// Every face of a part belongs to two parts, or lies in a face of the domain.
TEST(ReferencePart, MeetFaceToFace)
{
  for (const Domain domain : allDomains)
  {
    std::map<std::tuple<double, double, double>, int> middles;
    for (const ReferencePart& part : partsOf(domain, 2))
    {
      for (const Face& face : facts(domain).faces)
      {
        const glm::dvec3 m = part.inWhole(middleOf(facts(domain), face)).xyz;
        const auto rounded = [](double x) { return std::round(1e6 * x); };
        if (insideMargin(domain, { m }) > 1e-9)
        {
          ++middles[{ rounded(m.x), rounded(m.y), rounded(m.z) }];
        }
      }
    }
    EXPECT_FALSE(middles.empty());
    for (const auto& [middle, count] : middles)
    {
      EXPECT_EQ(count, 2);
    }
  }
}

} // namespace
} // namespace hop::testing
