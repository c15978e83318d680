#include "Elements/Bernstein.h"
#include "Elements/Bisection.h"

#include "ElementCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace hop::testing
{
namespace
{

constexpr int pointsPerElement = 5;

std::vector<double> basisAt(const ElementCase& which, const ReferencePoint& u)
{
  std::vector<double> basis(coefficientCount(which.domain, which.degrees));
  evaluateBasis(which.domain, which.degrees, u, basis.data());
  return basis;
}

double largest(const Coefficient& c)
{
  return std::max(std::max(std::abs(c.x), std::abs(c.y)), std::max(std::abs(c.z), std::abs(c.w)));
}

void expectNear(const Coefficient& actual, const Coefficient& expected, double tolerance)
{
  EXPECT_LE(largest(actual - expected), tolerance);
}

/// Fourth-order central difference along a coordinate.
Coefficient difference(
  const std::function<Coefficient(const ReferencePoint&)>& f, const ReferencePoint& u, int axis)
{
  constexpr double h = 1e-3;
  glm::dvec3 step(0.0);
  step[axis] = h;
  return (8.0 * (f({ u.xyz + step }) - f({ u.xyz - step })) -
           (f({ u.xyz + 2.0 * step }) - f({ u.xyz - 2.0 * step }))) /
    (12.0 * h);
}

TEST(Bernstein, BasisIsAPartitionOfUnity)
{
  Random random(1);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    for (int n = 0; n < pointsPerElement; ++n)
    {
      const std::vector<double> basis = basisAt(which, randomPoint(which.domain, random));
      EXPECT_NEAR(std::accumulate(basis.begin(), basis.end(), 0.0), 1.0, 1e-13);
      EXPECT_GE(*std::min_element(basis.begin(), basis.end()), -1e-15);
    }
  }
}

TEST(Bernstein, ControlPointsOnTheLatticeGiveTheIdentity)
{
  Random random(2);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const auto lattice = latticePoints(which.domain, which.degrees);
    for (int n = 0; n < pointsPerElement; ++n)
    {
      const ReferencePoint u = randomPoint(which.domain, random);
      const std::vector<double> basis = basisAt(which, u);
      glm::dvec3 sum(0.0);
      for (std::size_t i = 0; i < lattice.size(); ++i)
      {
        sum += basis[i] * latticePosition(which.degrees, lattice[i]).xyz;
      }
      EXPECT_LE(glm::distance(sum, u.xyz), 1e-14);
    }
  }
}

TEST(Bernstein, KnownValuesOfTheQuadraticLine)
{
  const std::vector<double> basis =
    basisAt({ Domain::Hexahedron, { 2, 1, 1 } }, { { 0.5, 0.0, 0.0 } });
  EXPECT_DOUBLE_EQ(basis[0], 0.25);
  EXPECT_DOUBLE_EQ(basis[1], 0.5);
  EXPECT_DOUBLE_EQ(basis[2], 0.25);
}

TEST(Bernstein, KnownValuesOfTheCubicTriangleAndTetrahedron)
{
  // 3!/(1!1!1!) (1/3)^3 at the middle of the triangle, its coefficient in the middle of the lattice.
  const ElementCase wedge{ Domain::Wedge, { 3, 3, 1 } };
  EXPECT_NEAR(
    basisAt(wedge,
      { { 1.0 / 3, 1.0 / 3, 0.0 } })[coefficientIndex(wedge.domain, wedge.degrees, { 1, 1, 0 })],
    6.0 / 27.0, 1e-15);
  const ElementCase tetrahedron{ Domain::Tetrahedron, { 3, 3, 3 } };
  EXPECT_NEAR(basisAt(tetrahedron,
                { { 0.25, 0.25,
                  0.25 } })[coefficientIndex(tetrahedron.domain, tetrahedron.degrees, { 1, 1, 1 })],
    6.0 / 64.0, 1e-15);
}

TEST(Bernstein, EvaluatorsAgreeWithTheBasis)
{
  Random random(3);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const std::vector<Coefficient> coefficients = randomCoefficients(which, random);
    for (int n = 0; n < pointsPerElement; ++n)
    {
      const ReferencePoint u = randomPoint(which.domain, random);
      const Coefficient expected = std::inner_product(
        coefficients.begin(), coefficients.end(), basisAt(which, u).begin(), Coefficient(0.0));
      const BernsteinForm form = formOf(which, coefficients);
      expectNear(evaluateGradient(form, u).value, expected, 1e-14);
      expectNear(evaluateHessian(form, u).value, expected, 1e-14);
    }
  }
}

TEST(Bernstein, CornersInterpolate)
{
  Random random(4);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const std::vector<Coefficient> coefficients = randomCoefficients(which, random);
    const auto& corners = facts(which.domain).corners;
    for (int c = 0; c < static_cast<int>(corners.size()); ++c)
    {
      const int index = coefficientIndex(
        which.domain, which.degrees, cornerLatticePoint(which.domain, which.degrees, c));
      expectNear(
        evaluateHessian(formOf(which, coefficients), corners[c]).value, coefficients[index], 1e-15);
    }
  }
}

TEST(Bernstein, GradientAgreesWithFiniteDifferencesOfTheValue)
{
  Random random(5);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const std::vector<Coefficient> coefficients = randomCoefficients(which, random);
    const BernsteinForm form = formOf(which, coefficients);
    for (int n = 0; n < pointsPerElement; ++n)
    {
      const ReferencePoint u = randomPoint(which.domain, random);
      const auto value = [&](const ReferencePoint& at) { return evaluateGradient(form, at).value; };
      for (int axis = 0; axis < 3; ++axis)
      {
        const Coefficient expected = difference(value, u, axis);
        expectNear(evaluateGradient(form, u).first[axis], expected, 1e-7);
        expectNear(evaluateHessian(form, u).first[axis], expected, 1e-7);
      }
    }
  }
}

TEST(Bernstein, HessianAgreesWithFiniteDifferencesOfTheGradient)
{
  constexpr int place[3][3] = { { 0, 1, 2 }, { 1, 3, 4 }, { 2, 4, 5 } };
  Random random(6);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const std::vector<Coefficient> coefficients = randomCoefficients(which, random);
    const BernsteinForm form = formOf(which, coefficients);
    for (int n = 0; n < pointsPerElement; ++n)
    {
      const ReferencePoint u = randomPoint(which.domain, random);
      const Jet jet = evaluateHessian(form, u);
      for (int a = 0; a < 3; ++a)
      {
        for (int b = 0; b < 3; ++b)
        {
          const auto slope = [&](const ReferencePoint& at)
          { return evaluateGradient(form, at).first[a]; };
          expectNear(jet.second[place[a][b]], difference(slope, u, b), 1e-5);
        }
      }
    }
  }
}

TEST(Bernstein, LinearElementsHaveNoPureSecondDerivatives)
{
  Random random(7);
  for (const Domain domain : { Domain::Hexahedron, Domain::Tetrahedron, Domain::Wedge })
  {
    const ElementCase which{ domain, { 1, 1, 1 } };
    const std::vector<Coefficient> coefficients = randomCoefficients(which, random);
    const Jet jet = evaluateHessian(formOf(which, coefficients), randomPoint(domain, random));
    for (const int pure : { 0, 3, 5 })
    {
      EXPECT_EQ(jet.second[pure], Coefficient(0.0)) << domain;
    }
  }
}

/// The map from a half of the domain, as a domain of its own, to the whole: the corner at the start
/// or the end of every bisected edge moves to the middle of the edge.
ReferencePoint fromHalf(
  Domain domain, const LatticePoint& direction, bool second, const ReferencePoint& u)
{
  constexpr Degrees linear{ 1, 1, 1 };
  const std::vector<double> basis = basisAt({ domain, linear }, u);
  const auto lattice = latticePoints(domain, linear);
  const glm::dvec3 d(direction.i, direction.j, direction.k);
  glm::dvec3 sum(0.0);
  for (std::size_t c = 0; c < lattice.size(); ++c)
  {
    const auto [i, j, k] = lattice[c];
    const bool starts =
      inLattice(domain, linear, { i + direction.i, j + direction.j, k + direction.k });
    const bool ends =
      inLattice(domain, linear, { i - direction.i, j - direction.j, k - direction.k });
    const double shift = second && starts ? 0.5 : !second && ends ? -0.5 : 0.0;
    sum += basis[c] * (latticePosition(linear, lattice[c]).xyz + shift * d);
  }
  return { sum };
}

TEST(Bernstein, BisectionKeepsThePolynomialOnBothHalves)
{
  Random random(8);
  for (const ElementCase& which : allElementCases())
  {
    const std::vector<Coefficient> whole = randomCoefficients(which, random);
    for (const LatticePoint& direction : facts(which.domain).edgeDirections)
    {
      SCOPED_TRACE(::testing::Message()
        << which << " along " << direction.i << ' ' << direction.j << ' ' << direction.k);
      std::vector<Coefficient> first = whole;
      std::vector<Coefficient> second;
      bisect(which.domain, which.degrees, direction, first, second);
      ASSERT_EQ(second.size(), whole.size());
      for (int n = 0; n < pointsPerElement; ++n)
      {
        const ReferencePoint u = randomPoint(which.domain, random);
        const auto valueOf = [&](const std::vector<Coefficient>& c, const ReferencePoint& at)
        { return evaluateGradient(formOf(which, c), at).value; };
        expectNear(
          valueOf(first, u), valueOf(whole, fromHalf(which.domain, direction, false, u)), 1e-13);
        expectNear(
          valueOf(second, u), valueOf(whole, fromHalf(which.domain, direction, true, u)), 1e-13);
      }
    }
  }
}

TEST(Bernstein, EveryEdgeOfTheDomainRunsAlongABisectionDirection)
{
  // Otherwise an element could stay long in one direction however often it is bisected.
  EXPECT_EQ(facts(Domain::Hexahedron).edgeDirections.size(), 3u);
  EXPECT_EQ(facts(Domain::Tetrahedron).edgeDirections.size(), 6u);
  EXPECT_EQ(facts(Domain::Wedge).edgeDirections.size(), 4u);
}

TEST(Bernstein, FieldRangeBoundsTheFieldAndTightensWithBisection)
{
  Random random(9);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    std::vector<Coefficient> coefficients = randomCoefficients(which, random);
    const Range range = fieldRange(formOf(which, coefficients));
    for (int n = 0; n < 50; ++n)
    {
      const double f =
        evaluateGradient(formOf(which, coefficients), randomPoint(which.domain, random)).value.w;
      EXPECT_GE(f, range.lower);
      EXPECT_LE(f, range.upper);
    }
    std::vector<Coefficient> second;
    bisect(
      which.domain, which.degrees, facts(which.domain).edgeDirections[0], coefficients, second);
    const Range half = fieldRange(formOf(which, coefficients));
    EXPECT_GE(half.lower, range.lower);
    EXPECT_LE(half.upper, range.upper);
  }
}

} // namespace
} // namespace hop::testing
