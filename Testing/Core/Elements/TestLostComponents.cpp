#include "Elements/LostComponents.h"

#include "ElementCases.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double isovalue = 2.0;
constexpr int degree = 8;

using Field = std::function<double(const glm::dvec3&)>;

/// Compares a field with a linear polynomial.
bool loses(Domain domain, const Field& field, const Field& linear)
{
  const SamplingLattice& lattice = samplingLattice(domain, degree);
  const auto at = [&](const std::vector<ReferencePoint>& points)
  {
    std::vector<double> values;
    for (const ReferencePoint& u : points)
    {
      EXPECT_GT(insideMargin(domain, u), -1e-12);
      values.push_back(field(u.xyz));
    }
    return values;
  };
  const Degrees one{ 1, 1, 1 };
  std::vector<Coefficient> coefficients;
  for (const LatticePoint& point : latticePoints(domain, one))
  {
    coefficients.emplace_back(0.0, 0.0, 0.0, linear(latticePosition(one, point).xyz));
  }
  const BernsteinForm polynomial{ domain, one, coefficients.data(), nullptr };
  const std::vector<double> atNodes = at(lattice.nodes);
  return losesComponents({ domain, lattice, atNodes, polynomial, at }, { isovalue });
}

/// A third of the way from one node to the next and the one above it, not far from the middle of all domains.
const glm::dvec3 peak = glm::dvec3(2.33, 2.0, 2.33) / double(degree);

/// Of one side only at the far side of the domain.
double falling(const glm::dvec3& u)
{
  return isovalue + 0.6 - u.x - u.y;
}

/// Above the isovalue in a ball of a tenth of the distance of nodes.
double cone(const glm::dvec3& u)
{
  return isovalue + 0.1 / degree - glm::distance(u, peak);
}

/// Above the isovalue around a short piece of a ridge that runs askew to the axes.
double ridge(const glm::dvec3& u)
{
  const glm::dvec3 from = u - peak;
  const double along = glm::dot(from, glm::normalize(glm::dvec3(1.0, 0.6, -0.3)));
  const double across = std::sqrt(std::max(0.0, glm::dot(from, from) - along * along));
  return isovalue + 0.1 / degree - across - 0.1 * std::abs(along);
}

class LostComponents : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(Domains, LostComponents,
  ::testing::Values(Domain::Hexahedron, Domain::Tetrahedron, Domain::Wedge));

/// Above the isovalue at no node.
TEST_P(LostComponents, ArePeaksBetweenNodes)
{
  for (const Field& field : { Field(cone), Field(ridge) })
  {
    for (const ReferencePoint& node : samplingLattice(this->GetParam(), degree).nodes)
    {
      ASSERT_LT(field(node.xyz), isovalue);
    }
    const Field below = [](const glm::dvec3&) { return isovalue - 1.0; };
    EXPECT_TRUE(loses(this->GetParam(), field, below));
    const Field mirrored = [&](const glm::dvec3& u) { return 2.0 * isovalue - field(u); };
    const Field above = [](const glm::dvec3&) { return isovalue + 1.0; };
    EXPECT_TRUE(loses(this->GetParam(), mirrored, above));
  }
}

TEST_P(LostComponents, AreNotPeaksThatThePolynomialHas)
{
  ASSERT_GT(falling(peak), isovalue);
  EXPECT_FALSE(loses(this->GetParam(), cone, falling));
  EXPECT_FALSE(loses(this->GetParam(), ridge, falling));
}

TEST_P(LostComponents, AreNotPeaksOnTheOtherSide)
{
  const Field below = [](const glm::dvec3&) { return isovalue - 1.0; };
  const Field lower = [](const glm::dvec3& u) { return cone(u) - 0.101 / degree; };
  EXPECT_FALSE(loses(this->GetParam(), lower, below));
}

/// A polynomial that is above the isovalue on the peak, but far below the field, has it elsewhere or not for long.
TEST_P(LostComponents, ArePeaksThatThePolynomialHardlyHas)
{
  const Field hardly = [](const glm::dvec3& u)
  { return isovalue + 0.01 / degree + falling(u) - falling(peak); };
  EXPECT_TRUE(loses(this->GetParam(), cone, hardly));
}

} // namespace
} // namespace hop::testing
