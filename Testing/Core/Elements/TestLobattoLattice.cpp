#include "Elements/LobattoLattice.h"

#include "ElementCases.h"
#include "Elements/BatchEvaluator.h"
#include "Elements/NodalBasis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

ReferencePoint pointOf(const LobattoLattice& lattice, const LatticePoint& point)
{
  return { { lattice.line()[point.i], lattice.line()[point.j], lattice.line()[point.k] } };
}

/// Values and slopes axis by axis are those at the points, whose degrees differ from those of the polynomial.
TEST(LobattoLattice, EvaluatesAxisByAxis)
{
  Random random(1);
  const Degrees degrees{ 3, 4, 2 };
  std::vector<Coefficient> coefficients(coefficientCount(Domain::Hexahedron, degrees));
  for (Coefficient& c : coefficients)
  {
    c = { randomNumber(random), randomNumber(random), randomNumber(random), randomNumber(random) };
  }
  const LobattoLattice lattice(5);
  std::array<LineMatrix, 3> values;
  std::array<LineMatrix, 3> slopes;
  for (int axis = 0; axis < 3; ++axis)
  {
    values[axis] = bernsteinValues(degrees[axis], lattice.line());
    slopes[axis] = bernsteinSlopes(degrees[axis], lattice.line());
  }
  const std::vector<double> numbers(
    &coefficients[0].x, &coefficients[0].x + 4 * coefficients.size());
  for (int quantity = 0; quantity < quantity::countOfGradients; ++quantity)
  {
    const auto matrix = [&](int axis)
    { return quantity == quantity::first + axis ? &slopes[axis] : &values[axis]; };
    const std::vector<double> result = alongAxes({ matrix(0), matrix(1), matrix(2) }, numbers);
    std::size_t n = 0;
    for (const LatticePoint& point : latticePoints(Domain::Hexahedron, { 5, 5, 5 }))
    {
      const Jet jet = evaluateGradient(
        { Domain::Hexahedron, degrees, coefficients.data(), nullptr }, pointOf(lattice, point));
      const Coefficient& expected = quantity == 0 ? jet.value : jet.first[quantity - 1];
      for (int c = 0; c < 4; ++c)
      {
        EXPECT_NEAR(result[n++], expected[c], 1e-13) << quantity << ", " << c;
      }
    }
  }
}

/// Gradients of several components, one after the other, are those of each axis by axis.
TEST(LobattoLattice, SharesTheWayToGradients)
{
  Random random(3);
  const Degrees degrees{ 2, 4, 3 };
  const int count = coefficientCount(Domain::Hexahedron, degrees);
  std::vector<double> numbers(5 * count);
  for (double& number : numbers)
  {
    number = randomNumber(random);
  }
  const LobattoLattice lattice(6);
  const int points = 7 * 7 * 7;
  std::array<LineMatrix, 3> values;
  std::array<LineMatrix, 3> slopes;
  for (int axis = 0; axis < 3; ++axis)
  {
    values[axis] = bernsteinValues(degrees[axis], lattice.line());
    slopes[axis] = bernsteinSlopes(degrees[axis], lattice.line());
  }
  const auto gradients = gradientsAlongAxes(values, slopes, numbers);
  for (int quantity = 0; quantity < quantity::countOfGradients; ++quantity)
  {
    ASSERT_EQ(gradients[quantity].size(), 5u * points);
    const auto matrix = [&](int axis)
    { return quantity == quantity::first + axis ? &slopes[axis] : &values[axis]; };
    for (int c = 0; c < 5; ++c)
    {
      const std::vector<double> expected = alongAxes({ matrix(0), matrix(1), matrix(2) },
        { numbers.begin() + c * count, numbers.begin() + (c + 1) * count });
      for (int n = 0; n < points; ++n)
      {
        EXPECT_NEAR(gradients[quantity][c * points + n], expected[n], 1e-13);
      }
    }
  }
}

/// In doubles, as well as the other way does in extended precision.
TEST(LobattoLattice, HoldsSmoothFieldsOfAllDegrees)
{
  const auto field = [](const glm::dvec3& u) { return std::sin(2.0 * u.x + u.y) * std::exp(u.z); };
  for (int degree = 1; degree <= 15; ++degree)
  {
    const LobattoLattice lattice(degree);
    const Degrees degrees{ degree, degree, degree };
    std::vector<double> nodal;
    for (const LatticePoint& point : latticePoints(Domain::Hexahedron, degrees))
    {
      nodal.push_back(field(pointOf(lattice, point).xyz));
    }
    const std::vector<double> coefficients = lattice.toBernstein(nodal);
    std::vector<double> expected(coefficients.size());
    const NodalBasis basis = NodalBasis::lagrange(Domain::Hexahedron, degrees,
      latticePoints(Domain::Hexahedron, degrees), NodeSpacing::GaussLobattoLegendre);
    basis.toBernstein(nodal.data(), 1, expected.data());
    const double rounding = 1e-16 * basis.conversionNorm();
    const LineMatrix back = bernsteinValues(degree, lattice.line());
    const std::vector<double> again = alongAxes({ &back, &back, &back }, coefficients);
    for (std::size_t i = 0; i < nodal.size(); ++i)
    {
      EXPECT_NEAR(again[i], nodal[i], 2e-14) << degree;
      EXPECT_NEAR(coefficients[i], expected[i], 1e-13 + rounding) << degree;
    }
  }
}

/// Of a polynomial of the lattice's own degree, whose coefficients are random.
TEST(LobattoLattice, ReproducesPolynomials)
{
  Random random(2);
  for (int degree = 1; degree <= 14; ++degree)
  {
    const LobattoLattice lattice(degree);
    std::vector<double> coefficients(
      coefficientCount(Domain::Hexahedron, { degree, degree, degree }));
    for (double& c : coefficients)
    {
      c = randomNumber(random);
    }
    const LineMatrix values = bernsteinValues(degree, lattice.line());
    const std::vector<double> nodal = alongAxes({ &values, &values, &values }, coefficients);
    const std::vector<double> again =
      alongAxes({ &values, &values, &values }, lattice.toBernstein(nodal));
    for (std::size_t i = 0; i < nodal.size(); ++i)
    {
      EXPECT_NEAR(again[i], nodal[i], 1e-13) << degree;
    }
  }
}

} // namespace
} // namespace hop::testing
