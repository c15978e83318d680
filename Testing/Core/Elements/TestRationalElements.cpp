#include "Elements/Bernstein.h"
#include "Elements/Bisection.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace hop::testing
{
namespace
{

/// A rational element with its homogeneous coefficients.
struct RationalElement
{
  ElementCase which;
  std::vector<Coefficient> coefficients;
  std::vector<double> weights;

  BernsteinForm form() const
  {
    return { this->which.domain, this->which.degrees, this->coefficients.data(),
      this->weights.data() };
  }

  void add(const Coefficient& controlPoint, double weight)
  {
    this->coefficients.push_back(weight * controlPoint);
    this->weights.push_back(weight);
  }
};

/// No symmetry, weights from 1/2 to 2.
RationalElement randomRational(const ElementCase& which, Random& random)
{
  RationalElement element{ which, {}, {} };
  for (const Coefficient& c : randomCoefficients(which, random))
  {
    element.add(c, 0.5 + 1.5 * random.uniform());
  }
  return element;
}

std::vector<ElementCase> lowAndHighCases()
{
  std::vector<ElementCase> cases{ { Domain::Hexahedron, { 4, 2, 3 } },
    { Domain::Wedge, { 4, 4, 1 } } };
  for (const Domain domain : allDomains)
  {
    for (const int p : { 1, 2, 3, 6, 10 })
    {
      cases.push_back({ domain, { p, p, p } });
    }
  }
  return cases;
}

double largest(const Coefficient& c)
{
  return std::max(std::max(std::abs(c.x), std::abs(c.y)), std::max(std::abs(c.z), std::abs(c.w)));
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

/// A quarter circle as every CAD text gives it: weights 1, 1/sqrt(2), 1.
const std::array<glm::dvec2, 3> quarterCircle{ { { 1, 0 }, { 1, 1 }, { 0, 1 } } };
const std::array<double, 3> quarterWeights{ 1.0, std::sqrt(0.5), 1.0 };

TEST(RationalElements, AQuarterPipeIsExactlyRound)
{
  // Radius 1 to 2 along the first coordinate, the angle along the second; the field is the radius.
  RationalElement pipe{ { Domain::Hexahedron, { 1, 2, 1 } }, {}, {} };
  for (const auto& [i, j, k] : latticePoints(pipe.which.domain, pipe.which.degrees))
  {
    const double radius = 1.0 + i;
    pipe.add(Coefficient(radius * quarterCircle[j], k, radius), quarterWeights[j]);
  }
  Random random(1);
  for (int n = 0; n < 50; ++n)
  {
    const ReferencePoint u = randomPoint(Domain::Hexahedron, random);
    const Coefficient value = evaluateGradient(pipe.form(), u).value;
    EXPECT_NEAR(std::hypot(value.x, value.y), 1.0 + u.xyz.x, 1e-15 * 4);
    EXPECT_NEAR(value.w, 1.0 + u.xyz.x, 1e-15 * 4);
    EXPECT_NEAR(value.z, u.xyz.z, 1e-15);
  }
}

TEST(RationalElements, AnOctantIsExactlyASphere)
{
  // The quarter circle of meridians, revolved by the quarter circle of parallels.
  RationalElement octant{ { Domain::Hexahedron, { 1, 2, 2 } }, {}, {} };
  for (const auto& [i, j, k] : latticePoints(octant.which.domain, octant.which.degrees))
  {
    const double radius = 1.0 + i;
    octant.add(Coefficient(radius * quarterCircle[k].x * quarterCircle[j],
                 radius * quarterCircle[k].y, radius),
      quarterWeights[j] * quarterWeights[k]);
  }
  Random random(2);
  for (int n = 0; n < 50; ++n)
  {
    const ReferencePoint u = randomPoint(Domain::Hexahedron, random);
    const Coefficient value = evaluateGradient(octant.form(), u).value;
    EXPECT_NEAR(glm::length(glm::dvec3(value)), 1.0 + u.xyz.x, 1e-14);
    EXPECT_NEAR(value.w, 1.0 + u.xyz.x, 1e-14);
  }
}

TEST(RationalElements, AWedgeRevolvesItsTriangleExactly)
{
  // A triangle in the plane of radius and height, revolved by a quarter: {1, 1} along it, 2 around.
  const std::array<glm::dvec2, 3> triangle{ { { 1.0, 0.0 }, { 2.0, 0.3 }, { 1.5, 1.0 } } };
  RationalElement ring{ { Domain::Wedge, { 1, 1, 2 } }, {}, {} };
  for (const auto& [i, j, k] : latticePoints(ring.which.domain, ring.which.degrees))
  {
    const glm::dvec2 corner = triangle[i + 2 * j];
    ring.add(Coefficient(corner.x * quarterCircle[k], corner.y, corner.x), quarterWeights[k]);
  }
  Random random(3);
  for (int n = 0; n < 50; ++n)
  {
    const ReferencePoint u = randomPoint(Domain::Wedge, random);
    const glm::dvec2 expected =
      triangle[0] + u.xyz.x * (triangle[1] - triangle[0]) + u.xyz.y * (triangle[2] - triangle[0]);
    const Coefficient value = evaluateGradient(ring.form(), u).value;
    EXPECT_NEAR(std::hypot(value.x, value.y), expected.x, 1e-14);
    EXPECT_NEAR(value.z, expected.y, 1e-14);
    EXPECT_NEAR(value.w, expected.x, 1e-14);
  }
}

TEST(RationalElements, EqualWeightsChangeNothing)
{
  Random random(4);
  for (const ElementCase& which : lowAndHighCases())
  {
    SCOPED_TRACE(which);
    const std::vector<Coefficient> plain = randomCoefficients(which, random);
    RationalElement scaled{ which, {}, {} };
    for (const Coefficient& c : plain)
    {
      scaled.add(c, 0.7);
    }
    const ReferencePoint u = randomPoint(which.domain, random);
    const Jet expected = evaluateHessian(formOf(which, plain), u);
    const Jet actual = evaluateHessian(scaled.form(), u);
    const double tolerance = 1e-12 * which.degrees[0] * which.degrees[0];
    EXPECT_LE(largest(actual.value - expected.value), tolerance);
    for (int a = 0; a < 3; ++a)
    {
      EXPECT_LE(largest(actual.first[a] - expected.first[a]), tolerance);
    }
    for (int ab = 0; ab < 6; ++ab)
    {
      EXPECT_LE(largest(actual.second[ab] - expected.second[ab]), tolerance);
    }
  }
}

TEST(RationalElements, ValueIsTheQuotientOfTheBasisSums)
{
  Random random(5);
  for (const ElementCase& which : lowAndHighCases())
  {
    SCOPED_TRACE(which);
    const RationalElement element = randomRational(which, random);
    const ReferencePoint u = randomPoint(which.domain, random);
    std::vector<double> basis(element.weights.size());
    evaluateBasis(which.domain, which.degrees, u, basis.data());
    Coefficient above(0.0);
    double below = 0.0;
    for (std::size_t i = 0; i < basis.size(); ++i)
    {
      above += basis[i] * element.coefficients[i];
      below += basis[i] * element.weights[i];
    }
    EXPECT_LE(largest(evaluateGradient(element.form(), u).value - above / below), 1e-14);
    EXPECT_LE(largest(evaluateHessian(element.form(), u).value - above / below), 1e-14);
  }
}

TEST(RationalElements, DerivativesAgreeWithFiniteDifferences)
{
  constexpr int place[3][3] = { { 0, 1, 2 }, { 1, 3, 4 }, { 2, 4, 5 } };
  Random random(6);
  for (const ElementCase& which : lowAndHighCases())
  {
    SCOPED_TRACE(which);
    const RationalElement element = randomRational(which, random);
    const BernsteinForm form = element.form();
    const ReferencePoint u = randomPoint(which.domain, random);
    const Jet jet = evaluateHessian(form, u);
    const auto value = [&](const ReferencePoint& at) { return evaluateGradient(form, at).value; };
    for (int a = 0; a < 3; ++a)
    {
      const auto slope = [&](const ReferencePoint& at)
      { return evaluateGradient(form, at).first[a]; };
      EXPECT_LE(largest(jet.first[a] - difference(value, u, a)), 1e-7);
      EXPECT_LE(largest(slope(u) - jet.first[a]), 1e-12);
      for (int b = 0; b < 3; ++b)
      {
        EXPECT_LE(largest(jet.second[place[a][b]] - difference(slope, u, b)), 1e-5);
      }
    }
  }
}

TEST(RationalElements, TheRangeOfTheControlValuesBoundsTheField)
{
  Random random(7);
  for (const ElementCase& which : lowAndHighCases())
  {
    SCOPED_TRACE(which);
    const RationalElement element = randomRational(which, random);
    const Range range = fieldRange(element.form());
    // Control values lie in [-1, 1]; homogeneous ones would reach 2.
    EXPECT_GE(range.lower, -1.0);
    EXPECT_LE(range.upper, 1.0);
    for (int n = 0; n < 50; ++n)
    {
      const double f = evaluateGradient(element.form(), randomPoint(which.domain, random)).value.w;
      EXPECT_GE(f, range.lower);
      EXPECT_LE(f, range.upper);
    }
  }
}

TEST(RationalElements, BisectionKeepsTheElement)
{
  constexpr Degrees linear{ 1, 1, 1 };
  Random random(8);
  for (const ElementCase& which : lowAndHighCases())
  {
    for (const LatticePoint& direction : facts(which.domain).edgeDirections)
    {
      SCOPED_TRACE(which);
      const RationalElement whole = randomRational(which, random);
      std::vector<glm::dvec3> corners, cornersOfSecond;
      for (const LatticePoint& point : latticePoints(which.domain, linear))
      {
        corners.push_back(latticePosition(linear, point).xyz);
      }
      RationalElement first = whole;
      RationalElement second{ which, {}, {} };
      bisect(which.domain, which.degrees, direction, first.coefficients, second.coefficients);
      bisect(which.domain, which.degrees, direction, first.weights, second.weights);
      bisect(which.domain, linear, direction, corners, cornersOfSecond);
      const auto expectPart = [&](const RationalElement& part, const std::vector<glm::dvec3>& where)
      {
        const ReferencePoint u = randomPoint(which.domain, random);
        std::vector<double> basis(where.size());
        evaluateBasis(which.domain, linear, u, basis.data());
        ReferencePoint inWhole;
        for (std::size_t c = 0; c < where.size(); ++c)
        {
          inWhole.xyz += basis[c] * where[c];
        }
        EXPECT_LE(largest(evaluateGradient(part.form(), u).value -
                    evaluateGradient(whole.form(), inWhole).value),
          1e-13);
      };
      expectPart(first, corners);
      expectPart(second, cornersOfSecond);
    }
  }
}

} // namespace
} // namespace hop::testing
