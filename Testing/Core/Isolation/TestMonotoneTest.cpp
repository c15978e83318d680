#include "Isolation/MonotoneTest.h"

#include "ElementCases.h"
#include "Elements/NodalBasis.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

/// Gradient of the field in reference space.
glm::dvec3 gradientAt(const BernsteinForm& form, const ReferencePoint& u)
{
  return gradientOf(evaluateGradient(form, u));
}

std::vector<double> fieldOf(const std::vector<Coefficient>& coefficients)
{
  std::vector<double> values;
  for (const Coefficient& c : coefficients)
  {
    values.push_back(c.w);
  }
  return values;
}

/// A linear field along a random direction plus noise of the given size.
std::vector<Coefficient> slopeWithNoise(const ElementCase& which, double noise, Random& random)
{
  const glm::dvec3 slope = glm::normalize(randomVector(random));
  std::vector<Coefficient> coefficients;
  for (const LatticePoint& point : latticePoints(which.domain, which.degrees))
  {
    const glm::dvec3 u = latticePosition(which.degrees, point).xyz;
    coefficients.emplace_back(u, glm::dot(slope, u) + noise * randomNumber(random));
  }
  return coefficients;
}

/// Bernstein coefficients of the gradient in the element's own degrees, by interpolation.
std::vector<glm::dvec3> gradientCoefficients(const ElementCase& which, const BernsteinForm& form)
{
  const auto lattice = latticePoints(which.domain, which.degrees);
  std::vector<glm::dvec3> nodal, result(lattice.size());
  for (const LatticePoint& point : lattice)
  {
    nodal.push_back(gradientAt(form, latticePosition(which.degrees, point)));
  }
  NodalBasis::lagrange(which.domain, which.degrees, lattice)
    .toBernstein(&nodal[0].x, 3, &result[0].x);
  return result;
}

/// The mean of Bernstein coefficients is the mean of the polynomial.
glm::dvec3 meanOf(const std::vector<glm::dvec3>& coefficients)
{
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& c : coefficients)
  {
    sum += c;
  }
  return sum / static_cast<double>(coefficients.size());
}

bool rises(const ElementCase& which, const std::vector<Coefficient>& coefficients)
{
  return MonotoneTest(which.domain, which.degrees).rises(fieldOf(coefficients));
}

TEST(MonotoneTest, WhatRisesHasAPositiveDerivativeEverywhere)
{
  Random random(1);
  int risen = 0, refused = 0;
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const double degree = *std::max_element(which.degrees.begin(), which.degrees.end());
    for (int trial = 0; trial < 40; ++trial)
    {
      const auto coefficients = slopeWithNoise(which, 1.5 * random.uniform() / degree, random);
      const BernsteinForm form = formOf(which, coefficients);
      if (!rises(which, coefficients))
      {
        ++refused;
        continue;
      }
      ++risen;
      const glm::dvec3 direction = meanOf(gradientCoefficients(which, form));
      for (int n = 0; n < 60; ++n)
      {
        EXPECT_GT(glm::dot(gradientAt(form, randomPoint(which.domain, random)), direction), 0.0);
      }
      for (const ReferencePoint& corner : facts(which.domain).corners)
      {
        EXPECT_GT(glm::dot(gradientAt(form, corner), direction), 0.0);
      }
    }
  }
  // Both answers were put to the test.
  EXPECT_GT(risen, 300);
  EXPECT_GT(refused, 100);
}

TEST(MonotoneTest, DecidesByTheSignsOfTheDerivativesCoefficients)
{
  // Interpolation loses too many digits beyond degree 6 to tell signs.
  Random random(2);
  for (const ElementCase& which : allElementCases())
  {
    const double degree = *std::max_element(which.degrees.begin(), which.degrees.end());
    for (int trial = 0; degree <= 6 && trial < 40; ++trial)
    {
      const auto coefficients = slopeWithNoise(which, 1.5 * random.uniform() / degree, random);
      const auto gradients = gradientCoefficients(which, formOf(which, coefficients));
      const glm::dvec3 direction = meanOf(gradients);
      double smallest = 1.0;
      for (const glm::dvec3& g : gradients)
      {
        smallest = std::min(smallest, glm::dot(g, direction));
      }
      if (std::abs(smallest) > 1e-9)
      {
        EXPECT_EQ(rises(which, coefficients), smallest > 0.0) << which;
      }
    }
  }
}

TEST(MonotoneTest, TellsDerivatives)
{
  Random random(4);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const auto coefficients = slopeWithNoise(which, 1.0, random);
    const glm::dvec3 direction = randomVector(random);
    const std::vector<double> derivative =
      MonotoneTest(which.domain, which.degrees).derivative(fieldOf(coefficients), direction);
    std::vector<Coefficient> asField;
    for (const double value : derivative)
    {
      asField.emplace_back(0.0, 0.0, 0.0, value);
    }
    for (int n = 0; n < 10; ++n)
    {
      const ReferencePoint u = randomPoint(which.domain, random);
      EXPECT_NEAR(evaluateGradient(formOf(which, asField), u).value.w,
        glm::dot(gradientAt(formOf(which, coefficients), u), direction), 1e-10);
    }
  }
}

TEST(MonotoneTest, LinearFieldsRise)
{
  Random random(3);
  for (const ElementCase& which : allElementCases())
  {
    for (int trial = 0; trial < 5; ++trial)
    {
      EXPECT_TRUE(rises(which, slopeWithNoise(which, 0.0, random))) << which;
    }
  }
}

TEST(MonotoneTest, ExtremaAndConstantsDoNotRise)
{
  for (const ElementCase& which : allElementCases())
  {
    std::vector<double> constant, bowl;
    for (const LatticePoint& point : latticePoints(which.domain, which.degrees))
    {
      // Squared distances of the control points from a place inside every domain.
      const glm::dvec3 d = latticePosition(which.degrees, point).xyz - 0.25;
      constant.push_back(3.0);
      bowl.push_back(glm::dot(d, d));
    }
    const MonotoneTest test(which.domain, which.degrees);
    EXPECT_FALSE(test.rises(constant)) << which;
    if (*std::min_element(which.degrees.begin(), which.degrees.end()) > 2)
    {
      EXPECT_FALSE(test.rises(bowl)) << which;
    }
  }
}

TEST(MonotoneTest, NoiseOfTheSizeOfRoundingIsNoSlope)
{
  Random random(4);
  for (const ElementCase& which : allElementCases())
  {
    std::vector<Coefficient> coefficients = slopeWithNoise(which, 0.0, random);
    for (Coefficient& c : coefficients)
    {
      c.w = 1.0 + 1e-16 * c.w;
    }
    EXPECT_FALSE(rises(which, coefficients)) << which;
  }
}

/// The square of a speed that grows with the distance from a wall at u = 0, less a constant.
std::vector<double> squareOfSpeed(double constant)
{
  const Degrees degrees{ 2, 1, 1 };
  std::vector<double> values;
  for (const LatticePoint& point : latticePoints(Domain::Hexahedron, degrees))
  {
    values.push_back((point.i == 2 ? 1.0 : 0.0) - constant);
  }
  return values;
}

TEST(MonotoneTest, MayStandStillWhereItIsNotZero)
{
  const MonotoneTest test(Domain::Hexahedron, { 2, 1, 1 });
  EXPECT_EQ(test.monotony(squareOfSpeed(1e-4)), Monotony::Weak);
  EXPECT_EQ(test.monotony(squareOfSpeed(-1e-4)), Monotony::Weak);
  EXPECT_EQ(test.monotony(squareOfSpeed(0.0)), Monotony::None);
  std::vector<double> falling = squareOfSpeed(1e-4);
  falling[coefficientIndex(Domain::Hexahedron, { 2, 1, 1 }, { 1, 0, 0 })] -= 1e-3;
  EXPECT_EQ(test.monotony(falling), Monotony::None);
}

} // namespace
} // namespace hop::testing
