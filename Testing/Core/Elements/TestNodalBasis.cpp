#include "Elements/NodalBasis.h"

#include "ElementCases.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace hop::testing
{
namespace
{

/// A polynomial as a sum of shifted monomials, one for each point of the element's lattice: all
/// polynomials that the element can hold, evaluated without any Bernstein basis.
class MonomialSum
{
public:
  MonomialSum(const ElementCase& which, Random& random)
  {
    for (const LatticePoint& powers : latticePoints(which.domain, which.degrees))
    {
      this->Terms.push_back({ powers, randomNumber(random) });
    }
  }

  double operator()(const ReferencePoint& u) const
  {
    const glm::dvec3 t = 2.0 * u.xyz - 1.0;
    double sum = 0.0;
    for (const auto& [powers, factor] : this->Terms)
    {
      sum += factor * std::pow(t.x, powers.i) * std::pow(t.y, powers.j) * std::pow(t.z, powers.k);
    }
    return sum;
  }

private:
  std::vector<std::pair<LatticePoint, double>> Terms;
};

/// The lattice in an order of the kind that a mesh format could have.
std::vector<LatticePoint> shuffledLattice(const ElementCase& which, Random& random)
{
  std::vector<LatticePoint> order = latticePoints(which.domain, which.degrees);
  for (std::size_t i = order.size(); i > 1; --i)
  {
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.uniform() * i)]);
  }
  return order;
}

TEST(NodalBasis, ReproducesThePolynomialsOfTheElementExactly)
{
  Random random(1);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const NodalBasis basis =
      NodalBasis::lagrange(which.domain, which.degrees, latticePoints(which.domain, which.degrees));
    const MonomialSum f(which, random), g(which, random);
    std::vector<double> nodal;
    double size = 0.0;
    for (const LatticePoint& point : latticePoints(which.domain, which.degrees))
    {
      const ReferencePoint u = latticePosition(which.degrees, point);
      nodal.insert(nodal.end(), { f(u), g(u), 0.0, 1.0 });
      size = std::max({ size, std::abs(f(u)), std::abs(g(u)) });
    }
    std::vector<Coefficient> coefficients(basis.nodeCount());
    basis.toBernstein(nodal.data(), 4, &coefficients[0].x);

    const double tolerance =
      4.0 * std::numeric_limits<double>::epsilon() * basis.conversionNorm() * size;
    for (int n = 0; n < 10; ++n)
    {
      const ReferencePoint u = randomPoint(which.domain, random);
      const Coefficient value = evaluateGradient(formOf(which, coefficients), u).value;
      EXPECT_NEAR(value.x, f(u), tolerance);
      EXPECT_NEAR(value.y, g(u), tolerance);
      EXPECT_EQ(value.z, 0.0);
      EXPECT_NEAR(value.w, 1.0, tolerance);
    }
  }
}

TEST(NodalBasis, KnowsTheGaussLobattoPoints)
{
  const std::vector<std::vector<double>> known{ { 0.0, 1.0 }, { 0.0, 0.5, 1.0 },
    { 0.0, 0.5 - 0.5 / std::sqrt(5.0), 0.5 + 0.5 / std::sqrt(5.0), 1.0 },
    { 0.0, 0.5 - 0.5 * std::sqrt(3.0 / 7.0), 0.5, 0.5 + 0.5 * std::sqrt(3.0 / 7.0), 1.0 } };
  for (const auto& points : known)
  {
    const auto found = gaussLobattoPoints(static_cast<int>(points.size()) - 1);
    ASSERT_EQ(found.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_NEAR(static_cast<double>(found[i]), points[i], 1e-15);
    }
  }
}

TEST(NodalBasis, ReproducesPolynomialsFromGaussLobattoNodes)
{
  Random random(2);
  for (int p = 1; p <= MaximumInputDegree; ++p)
  {
    const ElementCase which{ Domain::Hexahedron, { p, p, p } };
    SCOPED_TRACE(which);
    const auto lattice = latticePoints(which.domain, which.degrees);
    const NodalBasis basis =
      NodalBasis::lagrange(which.domain, which.degrees, lattice, NodeSpacing::GaussLobattoLegendre);
    const auto line = gaussLobattoPoints(p);
    const auto at = [&line](int i) { return static_cast<double>(line[i]); };
    const MonomialSum f(which, random);
    std::vector<double> nodal;
    double size = 0.0;
    for (const LatticePoint& point : lattice)
    {
      const double value = f({ { at(point.i), at(point.j), at(point.k) } });
      nodal.insert(nodal.end(), { value, 0.0, 0.0, 1.0 });
      size = std::max(size, std::abs(value));
    }
    std::vector<Coefficient> coefficients(basis.coefficientCount());
    basis.toBernstein(nodal.data(), 4, &coefficients[0].x);
    const double tolerance =
      8.0 * std::numeric_limits<double>::epsilon() * basis.conversionNorm() * size;
    for (int n = 0; n < 10; ++n)
    {
      const ReferencePoint u = randomPoint(which.domain, random);
      EXPECT_NEAR(evaluateGradient(formOf(which, coefficients), u).value.x, f(u), tolerance);
    }
    // These nodes are why spectral codes go to high degrees.
    const NodalBasis uniform = NodalBasis::lagrange(which.domain, which.degrees, lattice);
    EXPECT_LE(basis.conversionNorm(), 1.0000001 * uniform.conversionNorm());
  }
}

TEST(NodalBasis, BezierValuesAreCoefficientsInTheirPlaces)
{
  Random random(3);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const auto order = shuffledLattice(which, random);
    const NodalBasis basis = NodalBasis::bezier(which.domain, which.degrees, order);
    EXPECT_EQ(basis.conversionNorm(), 1.0);
    std::vector<double> nodal(order.size());
    std::iota(nodal.begin(), nodal.end(), 0.0);
    std::vector<double> coefficients(order.size());
    basis.toBernstein(nodal.data(), 1, coefficients.data());
    for (std::size_t node = 0; node < order.size(); ++node)
    {
      EXPECT_EQ(
        coefficients[coefficientIndex(which.domain, which.degrees, order[node])], nodal[node]);
    }
  }
}

TEST(NodalBasis, SamplesShapeFunctionsOfFewerNodes)
{
  // Linear shape functions seen through the quadratic basis: 8 nodes, 27 coefficients.
  const ElementCase quadratic{ Domain::Hexahedron, { 2, 2, 2 } };
  const Degrees linear{ 1, 1, 1 };
  std::vector<double> samples;
  for (const LatticePoint& point : latticePoints(quadratic.domain, quadratic.degrees))
  {
    std::vector<double> shape(8);
    evaluateBasis(
      quadratic.domain, linear, latticePosition(quadratic.degrees, point), shape.data());
    samples.insert(samples.end(), shape.begin(), shape.end());
  }
  const NodalBasis basis = NodalBasis::sampled(quadratic.domain, quadratic.degrees, samples);
  ASSERT_EQ(basis.nodeCount(), 8);
  ASSERT_EQ(basis.coefficientCount(), 27);
  Random random(4);
  std::vector<double> nodal;
  for (int node = 0; node < 8; ++node)
  {
    nodal.insert(nodal.end(), { randomNumber(random), 0.0, 0.0, 0.0 });
  }
  std::vector<Coefficient> coefficients(27);
  basis.toBernstein(nodal.data(), 4, &coefficients[0].x);
  for (int n = 0; n < 20; ++n)
  {
    const ReferencePoint u = randomPoint(quadratic.domain, random);
    std::vector<double> shape(8);
    evaluateBasis(quadratic.domain, linear, u, shape.data());
    double expected = 0.0;
    for (int node = 0; node < 8; ++node)
    {
      expected += shape[node] * nodal[4 * node];
    }
    EXPECT_NEAR(evaluateGradient(formOf(quadratic, coefficients), u).value.x, expected, 1e-13);
  }
  samples.pop_back();
  EXPECT_THROW(
    NodalBasis::sampled(quadratic.domain, quadratic.degrees, samples), std::invalid_argument);
}

TEST(NodalBasis, TakesNodesInAnyOrder)
{
  Random random(2);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const auto lattice = latticePoints(which.domain, which.degrees);
    const auto order = shuffledLattice(which, random);
    const NodalBasis sorted = NodalBasis::lagrange(which.domain, which.degrees, lattice);
    const NodalBasis shuffled = NodalBasis::lagrange(which.domain, which.degrees, order);
    std::vector<double> inStorageOrder(lattice.size()), inMeshOrder(lattice.size());
    for (std::size_t node = 0; node < order.size(); ++node)
    {
      inMeshOrder[node] = randomNumber(random);
      inStorageOrder[coefficientIndex(which.domain, which.degrees, order[node])] =
        inMeshOrder[node];
    }
    std::vector<double> expected(lattice.size()), actual(lattice.size());
    sorted.toBernstein(inStorageOrder.data(), 1, expected.data());
    shuffled.toBernstein(inMeshOrder.data(), 1, actual.data());
    EXPECT_EQ(actual, expected);
  }
}

TEST(NodalBasis, LinearElementsAreTheirOwnBernsteinForm)
{
  for (const Domain domain : { Domain::Hexahedron, Domain::Tetrahedron, Domain::Wedge })
  {
    const Degrees linear{ 1, 1, 1 };
    EXPECT_EQ(
      NodalBasis::lagrange(domain, linear, latticePoints(domain, linear)).conversionNorm(), 1.0);
  }
}

TEST(NodalBasis, ConversionNormIsThatOfTheQuadraticLine)
{
  // The middle coefficient is 2 f(1/2) - (f(0) + f(1))/2: norm 3 for each axis.
  const Degrees degrees{ 2, 2, 2 };
  const NodalBasis basis =
    NodalBasis::lagrange(Domain::Hexahedron, degrees, latticePoints(Domain::Hexahedron, degrees));
  EXPECT_NEAR(basis.conversionNorm(), 27.0, 1e-12);
  EXPECT_NEAR(equispacedToBernstein(1, 2).rounded[3], -0.5, 1e-15);
  EXPECT_NEAR(equispacedToBernstein(1, 2).rounded[4], 2.0, 1e-15);
}

TEST(NodalBasis, RefusesNodesThatAreNoPermutationOfTheLattice)
{
  for (const Domain domain : { Domain::Hexahedron, Domain::Tetrahedron, Domain::Wedge })
  {
    SCOPED_TRACE(::testing::PrintToString(domain));
    const Degrees degrees{ 3, 3, 3 };
    const auto lattice = latticePoints(domain, degrees);
    const auto build = [&](const std::vector<LatticePoint>& order)
    { NodalBasis::lagrange(domain, degrees, order); };
    EXPECT_NO_THROW(build(lattice));

    auto tooFew = lattice;
    tooFew.pop_back();
    EXPECT_THROW(build(tooFew), std::invalid_argument);
    auto twice = lattice;
    twice.back() = twice.front();
    EXPECT_THROW(build(twice), std::invalid_argument);
    auto oneMore = lattice;
    oneMore.push_back(lattice.front());
    EXPECT_THROW(build(oneMore), std::invalid_argument);
    auto outside = lattice;
    outside.back() = { 4, 0, 0 };
    EXPECT_THROW(build(outside), std::invalid_argument);
    EXPECT_THROW(build({}), std::invalid_argument);
  }
}

/// The value of a Lagrange polynomial of equispaced nodes by its definition, in extended precision.
std::vector<long double> lagrangeBasis(int degree, long double t)
{
  std::vector<long double> basis(degree + 1, 1.0L);
  for (int i = 0; i <= degree; ++i)
  {
    for (int j = 0; j <= degree; ++j)
    {
      basis[i] *= j == i ? 1.0L : (degree * t - j) / (i - j);
    }
  }
  return basis;
}

/// Largest error of the converted polynomial, and its largest value.
std::array<double, 2> errorOfConversion(int degree, const Field& field, Random& random)
{
  const ElementCase which{ Domain::Hexahedron, { degree, degree, degree } };
  const auto lattice = latticePoints(which.domain, which.degrees);
  std::vector<double> nodal;
  for (const LatticePoint& point : lattice)
  {
    const double value = field(latticePosition(which.degrees, point).xyz);
    nodal.insert(nodal.end(), { value, 0.0, 0.0, value });
  }
  std::vector<Coefficient> coefficients(lattice.size());
  NodalBasis::lagrange(which.domain, which.degrees, lattice)
    .toBernstein(nodal.data(), 4, &coefficients[0].x);
  std::array<double, 2> result{};
  for (int n = 0; n < 200; ++n)
  {
    const ReferencePoint u = randomPoint(which.domain, random);
    const auto a = lagrangeBasis(degree, u.xyz.x);
    const auto b = lagrangeBasis(degree, u.xyz.y);
    const auto c = lagrangeBasis(degree, u.xyz.z);
    long double exact = 0.0L;
    for (std::size_t i = 0; i < lattice.size(); ++i)
    {
      exact += a[lattice[i].i] * b[lattice[i].j] * c[lattice[i].k] * nodal[4 * i];
    }
    const double value = evaluateGradient(formOf(which, coefficients), u).value.w;
    result[0] = std::max(result[0], static_cast<double>(std::abs(value - exact)));
    result[1] = std::max(result[1], static_cast<double>(std::abs(exact)));
  }
  return result;
}

/// Smooth coordinates and fields, and random values: the worst that a file can hold, because their coefficients grow
/// too large for doubles (1e14 times the values at degree 15).
TEST(NodalBasis, HighDegreesKeepTheirDigits)
{
  Random random(11);
  const Field coordinate = [](const glm::dvec3& x)
  { return x.x + 0.1 * std::sin(3.0 * x.y + x.z); };
  const Field smooth = [](const glm::dvec3& x)
  { return std::sin(6.0 * x.x) * std::cos(5.0 * x.y) * std::sin(4.0 * x.z + 1.0); };
  const Field noise = [&random](const glm::dvec3&) { return randomNumber(random); };
  for (int degree = 1; degree <= MaximumInputDegree; ++degree)
  {
    SCOPED_TRACE(degree);
    for (const Field& field : { coordinate, smooth })
    {
      const auto [error, largest] = errorOfConversion(degree, field, random);
      EXPECT_LT(error, 1e-10 * largest);
    }
    const auto [error, largest] = errorOfConversion(degree, noise, random);
    EXPECT_LT(error, (degree <= 12 ? 1e-9 : 1e-6) * largest);
  }
}

TEST(NodalBasis, RefusesDegreesThatTheEvaluatorsDoNotTake)
{
  const auto build = [](const Degrees& degrees) {
    NodalBasis::lagrange(Domain::Hexahedron, degrees, latticePoints(Domain::Hexahedron, degrees));
  };
  EXPECT_NO_THROW(build({ 1, MaximumInputDegree, 1 }));
  EXPECT_THROW(build({ 0, 1, 1 }), std::invalid_argument);
  EXPECT_THROW(build({ 1, 1, MaximumInputDegree + 1 }), std::invalid_argument);
  EXPECT_THROW(build({ 1, -1, 1 }), std::invalid_argument);
}

} // namespace
} // namespace hop::testing
