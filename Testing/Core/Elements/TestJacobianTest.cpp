#include "Elements/JacobianTest.h"

#include "ElementCases.h"
#include "Surface/SurfaceGeometry.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace hop::testing
{
namespace
{

JacobianSign signOf(const BernsteinForm& form)
{
  return JacobianTest(form.domain, form.degrees).sign(form);
}

double determinantAt(const BernsteinForm& form, const ReferencePoint& u)
{
  return glm::determinant(fieldPoint(evaluateGradient(form, u), 0.0).map.jacobian);
}

/// One element that is the image of its reference domain.
ElementMesh bentDomain(const ElementCase& which, const Map& map)
{
  MeshRecipe recipe;
  recipe.domain = which.domain;
  recipe.degrees = which.degrees;
  recipe.map = map;
  std::vector<glm::dvec3> corners;
  std::vector<std::int64_t> numbers;
  for (const ReferencePoint& corner : facts(which.domain).corners)
  {
    numbers.push_back(static_cast<std::int64_t>(corners.size()));
    corners.push_back(corner.xyz);
  }
  ElementMesh mesh;
  appendElement(mesh, recipe, corners, numbers);
  return mesh;
}

glm::dvec3 mirrored(const glm::dvec3& x)
{
  return { -x.x, x.y, x.z };
}

/// A map whose Jacobian determinant is |x - (0.2, 0.2, 0.2)|^2 - r, by integration along x.
Map dented(double r)
{
  return [r](const glm::dvec3& x)
  {
    const glm::dvec3 d = x - 0.2;
    return glm::dvec3(d.x * (d.x * d.x / 3.0 + d.y * d.y + d.z * d.z - r), x.y, x.z);
  };
}

std::vector<double> randomWeights(std::size_t count, Random& random)
{
  std::vector<double> weights(count);
  for (double& w : weights)
  {
    w = 0.5 + random.uniform();
  }
  return weights;
}

/// Straight, with control points moved at random by up to `amount` of a lattice step; weighted ones
/// are homogeneous.
std::vector<Coefficient> disturbedElement(
  const ElementCase& which, double amount, const std::vector<double>& weights, Random& random)
{
  std::vector<Coefficient> coefficients;
  for (const LatticePoint& point : latticePoints(which.domain, which.degrees))
  {
    const int degree = *std::max_element(which.degrees.begin(), which.degrees.end());
    const glm::dvec3 x =
      latticePosition(which.degrees, point).xyz + amount / degree * randomVector(random);
    coefficients.push_back(weights[coefficients.size()] * Coefficient(x, 0.0));
  }
  return coefficients;
}

TEST(JacobianTest, MultipliesOutTheDeterminant)
{
  Random random(1);
  for (const ElementCase& which : allElementCases())
  {
    const std::size_t count = coefficientCount(which.domain, which.degrees);
    for (const bool rational : { false, true })
    {
      if (rational && *std::max_element(which.degrees.begin(), which.degrees.end()) > 6)
      {
        continue; // for the time it takes
      }
      SCOPED_TRACE(::testing::Message() << which << (rational ? ", rational" : ""));
      const std::vector<double> weights =
        rational ? randomWeights(count, random) : std::vector<double>(count, 1.0);
      const auto coefficients = disturbedElement(which, 0.5, weights, random);
      const BernsteinForm form{ which.domain, which.degrees, coefficients.data(),
        rational ? weights.data() : nullptr };
      const ScaledPolynomial product = JacobianTest(which.domain, which.degrees).determinant(form);
      const std::vector<double> values = unscaled(product);
      std::vector<double> basis(values.size()), ownBasis(count);
      for (int n = 0; n < 3; ++n)
      {
        const ReferencePoint u = randomPoint(which.domain, random);
        evaluateBasis(which.domain, product.degrees, u, basis.data());
        evaluateBasis(which.domain, which.degrees, u, ownBasis.data());
        const double w = std::inner_product(weights.begin(), weights.end(), ownBasis.begin(), 0.0);
        EXPECT_NEAR(std::inner_product(values.begin(), values.end(), basis.begin(), 0.0),
          std::pow(w, rational ? 4 : 0) * determinantAt(form, u), 1e-10);
      }
    }
  }
}

TEST(JacobianTest, BentElementsOfEveryKindAreValidAndTheirMirrorImagesInverted)
{
  for (const ElementCase& which : allElementCases())
  {
    const Map bend = wavyMap(0.2);
    EXPECT_EQ(signOf(bentDomain(which, bend).form(0)), JacobianSign::Positive) << which;
    EXPECT_EQ(
      signOf(bentDomain(which, [&](const glm::dvec3& x) { return mirrored(bend(x)); }).form(0)),
      JacobianSign::Negative)
      << which;
  }
}

/// Size and place do not matter.
TEST(JacobianTest, SmallAndFarElementsAreJudgedAlike)
{
  for (const ElementCase& which : allElementCases())
  {
    for (const double size : { 1e-12, 1e-3, 1e9 })
    {
      const auto moved = [&](const Map& map)
      { return [&map, size](const glm::dvec3& x) { return size * (map(x) + 1e3); }; };
      EXPECT_EQ(signOf(bentDomain(which, moved(wavyMap(0.2))).form(0)), JacobianSign::Positive)
        << which << size;
    }
  }
}

/// The part that is inverted is a ball of radius 0.01, too small for any regular set of samples.
TEST(JacobianTest, FindsASmallInvertedPart)
{
  for (const Domain domain : allDomains)
  {
    for (int p = 3; p <= 8; ++p)
    {
      const ElementCase which{ domain, { p, p, p } };
      const ElementMesh mesh = bentDomain(which, dented(1e-4));
      constexpr Degrees places{ 8, 8, 8 };
      for (const LatticePoint& place : latticePoints(domain, places))
      {
        EXPECT_GT(determinantAt(mesh.form(0), latticePosition(places, place)), 0.0);
      }
      EXPECT_EQ(signOf(mesh.form(0)), JacobianSign::Mixed) << which;
      EXPECT_EQ(signOf(bentDomain(which, dented(-1e-4)).form(0)), JacobianSign::Positive) << which;
    }
  }
}

/// A zero that is touched counts as the sign around it.
TEST(JacobianTest, AnIsolatedZeroIsNoInversion)
{
  for (const Domain domain : allDomains)
  {
    const ElementCase which{ domain, { 3, 3, 3 } };
    EXPECT_EQ(signOf(bentDomain(which, dented(0.0)).form(0)), JacobianSign::Positive) << which;
  }
}

TEST(JacobianTest, AgreesWithManySamples)
{
  Random random(5);
  int mixed = 0;
  int valid = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    const Domain domain = allDomains[trial % 3];
    const int p = 1 + trial / 3 % 3;
    const ElementCase which{ domain, { p, p, p } };
    const std::size_t count = coefficientCount(domain, which.degrees);
    const bool rational = trial % 2 == 1;
    const std::vector<double> weights =
      rational ? randomWeights(count, random) : std::vector<double>(count, 1.0);
    const auto coefficients = disturbedElement(which, random.uniform(), weights, random);
    const BernsteinForm form{ domain, which.degrees, coefficients.data(),
      rational ? weights.data() : nullptr };
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    constexpr Degrees places{ 24, 24, 24 };
    for (const LatticePoint& place : latticePoints(domain, places))
    {
      const double value = determinantAt(form, latticePosition(places, place));
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    const JacobianSign sign = signOf(form);
    // A mixed element may show one sign at the samples, then with values near zero among them.
    const double largest = std::max(highest, -lowest);
    const JacobianSign seen = lowest > 0.0 ? JacobianSign::Positive
      : highest < 0.0                      ? JacobianSign::Negative
                                           : JacobianSign::Mixed;
    const bool tooSmallToSee =
      sign == JacobianSign::Mixed && std::min(std::abs(lowest), std::abs(highest)) < 1e-2 * largest;
    EXPECT_TRUE(sign == seen || tooSmallToSee) << which << ", trial " << trial;
    mixed += sign == JacobianSign::Mixed;
    valid += sign == JacobianSign::Positive;
  }
  EXPECT_GT(mixed, 50);
  EXPECT_GT(valid, 50);
}

/// The homogeneous coordinate along u is linear, while the element folds back where one weight is small.
TEST(JacobianTest, SmallWeightsFoldAnElement)
{
  constexpr Degrees degrees{ 3, 3, 3 };
  constexpr std::array<double, 4> weightsAlong{ 1.0, 0.2, 1.0, 1.0 };
  std::vector<double> weights;
  std::vector<Coefficient> coefficients;
  for (const LatticePoint& point : latticePoints(Domain::Hexahedron, degrees))
  {
    const double w = weightsAlong[point.i];
    const glm::dvec3 u = latticePosition(degrees, point).xyz;
    weights.push_back(w);
    coefficients.emplace_back(u.x - 0.5, w * (u.y - 0.5), w * (u.z - 0.5), 0.0);
  }
  const BernsteinForm form{ Domain::Hexahedron, degrees, coefficients.data(), weights.data() };
  EXPECT_LT(determinantAt(form, ReferencePoint{ { 0.0, 0.5, 0.5 } }), 0.0);
  EXPECT_GT(determinantAt(form, ReferencePoint{ { 1.0, 0.5, 0.5 } }), 0.0);
  EXPECT_EQ(signOf(form), JacobianSign::Mixed);
}

TEST(JacobianTest, ElementsWithoutVolumeAreZero)
{
  const Map flat = [](const glm::dvec3& x) { return glm::dvec3(x.x, x.y + x.z, 0.3); };
  const Map line = [](const glm::dvec3& x) { return glm::dvec3(x.x + x.y * x.z, 2.0, 0.3); };
  const Map point = [](const glm::dvec3&) { return glm::dvec3(1.0, 2.0, 0.3); };
  const Map tilted = [](const glm::dvec3& x)
  { return glm::dvec3(x.x, x.y + x.z, 0.3 * x.x + 7.1 * (x.y + x.z) + 11.3); };
  for (const ElementCase& which : allElementCases())
  {
    if (*std::max_element(which.degrees.begin(), which.degrees.end()) > 4)
    {
      continue; // the conversion of equispaced nodes leaves them some volume
    }
    for (const Map& map : { flat, line, point, tilted })
    {
      EXPECT_EQ(signOf(bentDomain(which, map).form(0)), JacobianSign::Zero) << which;
    }
  }
}

TEST(JacobianTest, CollapsedCornersEdgesAndFacesAreValid)
{
  // A hexahedron whose upper face is a point (a pyramid), an edge (a wedge), and one with one edge only.
  const Map pyramid = [](const glm::dvec3& x)
  { return glm::dvec3((1.0 - x.z) * x.x, (1.0 - x.z) * x.y, x.z); };
  const Map wedge = [](const glm::dvec3& x) { return glm::dvec3((1.0 - x.z) * x.x, x.y, x.z); };
  const Map edge = [](const glm::dvec3& x)
  { return glm::dvec3(x.x, x.y * (1.0 - x.x * x.z), x.z); };
  for (int p = 1; p <= 6; ++p)
  {
    for (const Map& map : { pyramid, wedge, edge })
    {
      const ElementMesh mesh = bentDomain({ Domain::Hexahedron, { p, p, p } }, map);
      const JacobianTest test(Domain::Hexahedron, { p, p, p });
      // Nodes carry rounding errors that the conversion enlarges.
      EXPECT_EQ(test.sign(mesh.form(0), 1e-10), JacobianSign::Positive) << p;
    }
  }
}

TEST(JacobianTest, NamesWhatIsNotFinite)
{
  for (const Domain domain : allDomains)
  {
    for (const double poison :
      { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
    {
      for (int component = 0; component < 4; ++component)
      {
        ElementMesh mesh = bentDomain({ domain, { 2, 2, 2 } }, wavyMap(0.1));
        mesh.coefficients[4][component] = poison;
        EXPECT_EQ(signOf(mesh.form(0)), JacobianSign::NotFinite);
      }
    }
  }
}

} // namespace
} // namespace hop::testing
