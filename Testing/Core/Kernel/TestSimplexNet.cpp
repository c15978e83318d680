#include "AvailableParts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hop::testing
{
namespace
{

/// Exponents (i, j, k) of basis functions and net points; the fourth, of the first corner, makes them sum to the
/// degree.
using Exponents = std::array<int, 3>;

/// Of a triangle (dimension 2) or tetrahedron, i fastest.
std::vector<Exponents> lattice(int dimension, int degree)
{
  std::vector<Exponents> points;
  for (int k = 0; k <= (dimension == 3 ? degree : 0); ++k)
  {
    for (int j = 0; j <= degree - k; ++j)
    {
      for (int i = 0; i <= degree - k - j; ++i)
      {
        points.push_back({ i, j, k });
      }
    }
  }
  return points;
}

int indexOf(const std::vector<Exponents>& points, const Exponents& which)
{
  return static_cast<int>(std::find(points.begin(), points.end(), which) - points.begin());
}

double factorial(int n)
{
  return std::tgamma(n + 1.0);
}

/// p!/(i! j! k! l!) u^i v^j w^k b^l with b = 1 - u - v - w.
double bernstein(int degree, const Exponents& e, const std::array<double, 3>& u)
{
  const int l = degree - e[0] - e[1] - e[2];
  double value = factorial(degree) / factorial(l) * std::pow(1.0 - u[0] - u[1] - u[2], l);
  for (int axis = 0; axis < 3; ++axis)
  {
    value *= std::pow(u[axis], e[axis]) / factorial(e[axis]);
  }
  return value;
}

/// Different places for all lanes, inside the simplex.
std::vector<double> places(int dimension, int lanes)
{
  std::vector<double> u(dimension * lanes);
  for (int lane = 0; lane < lanes; ++lane)
  {
    u[lane] = 0.1 + 0.02 * lane;
    u[lanes + lane] = 0.35 - 0.03 * lane;
    if (dimension == 3)
    {
      u[2 * lanes + lane] = 0.25 + 0.01 * lane;
    }
  }
  return u;
}

std::array<double, 3> placeOf(int dimension, int lanes, const std::vector<double>& u, int lane)
{
  return { u[lane], u[lanes + lane], dimension == 3 ? u[2 * lanes + lane] : 0.0 };
}

/// x, y, z, f of coefficients without any regularity.
std::vector<double> irregularCoefficients(std::size_t count)
{
  std::vector<double> numbers(4 * count);
  for (std::size_t n = 0; n < numbers.size(); ++n)
  {
    numbers[n] = std::sin(1.7 * static_cast<double>(n * n % 101));
  }
  return numbers;
}

class SimplexNet : public ::testing::TestWithParam<CompiledParts>
{
};

TEST_P(SimplexNet, BasisIsThatOfItsDefinitionAndSumsToOne)
{
  const KernelParts& parts = GetParam().parts;
  for (const int dimension : { 2, 3 })
  {
    const auto evaluate = dimension == 2 ? parts.triangleBasis : parts.tetrahedronBasis;
    const std::vector<double> u = places(dimension, parts.lanes);
    for (int degree = 0; degree <= 8; ++degree)
    {
      const std::vector<Exponents> functions = lattice(dimension, degree);
      std::vector<double> basis(functions.size() * parts.lanes);
      evaluate(degree, u.data(), basis.data());
      for (int lane = 0; lane < parts.lanes; ++lane)
      {
        double sum = 0.0;
        for (std::size_t n = 0; n < functions.size(); ++n)
        {
          const double value = basis[n * parts.lanes + lane];
          EXPECT_NEAR(value,
            bernstein(degree, functions[n], placeOf(dimension, parts.lanes, u, lane)), 1e-14);
          sum += value;
        }
        EXPECT_NEAR(sum, 1.0, 1e-14) << "dimension " << dimension << ", degree " << degree;
      }
    }
  }
}

/// The net's definition: net_m = sum over |a| = p - Order of B_a c_(a + m).
double netPoint(int dimension, int degree, int order, const Exponents& m,
  const std::array<double, 3>& u, const std::vector<double>& coefficients, int component)
{
  const std::vector<Exponents> all = lattice(dimension, degree);
  double sum = 0.0;
  for (const Exponents& a : lattice(dimension, degree - order))
  {
    const int index = indexOf(all, { a[0] + m[0], a[1] + m[1], a[2] + m[2] });
    sum += bernstein(degree - order, a, u) * coefficients[4 * index + component];
  }
  return sum;
}

TEST_P(SimplexNet, IsTheSumThatDefinesItInBothLayouts)
{
  const KernelParts& parts = GetParam().parts;
  for (const int dimension : { 2, 3 })
  {
    const KernelParts::Net& evaluate = dimension == 2 ? parts.triangleNet : parts.tetrahedronNet;
    const std::vector<double> u = places(dimension, parts.lanes);
    const std::array<double, 3> first = placeOf(dimension, parts.lanes, u, 0);
    for (int order = 1; order <= 2; ++order)
    {
      const std::vector<Exponents> points = lattice(dimension, order);
      for (int degree = order; degree <= 5; ++degree)
      {
        const std::vector<double> coefficients =
          irregularCoefficients(lattice(dimension, degree).size());
        std::vector<double> inLanes(points.size() * 4 * parts.lanes), single(points.size() * 4);
        evaluate.points(degree, order, u.data(), coefficients.data(), inLanes.data());
        evaluate.single(degree, order, first.data(), coefficients.data(), single.data());
        for (std::size_t m = 0; m < points.size(); ++m)
        {
          SCOPED_TRACE(::testing::Message()
            << dimension << "D, order " << order << ", degree " << degree << ", " << m);
          for (int c = 0; c < 4; ++c)
          {
            EXPECT_NEAR(single[4 * m + c],
              netPoint(dimension, degree, order, points[m], first, coefficients, c), 1e-14);
            for (int lane = 0; lane < parts.lanes; ++lane)
            {
              const auto place = placeOf(dimension, parts.lanes, u, lane);
              EXPECT_NEAR(inLanes[(4 * m + c) * parts.lanes + lane],
                netPoint(dimension, degree, order, points[m], place, coefficients, c), 1e-14);
            }
          }
        }
      }
    }
  }
}

TEST_P(SimplexNet, OfALinearFunctionHasItsValuesAtPartsOfTheWay)
{
  // c_a = a/p is the coordinate itself; then net_m = (p - Order)/p u + m/p.
  const KernelParts& parts = GetParam().parts;
  constexpr int degree = 4, order = 2;
  std::vector<double> coefficients;
  for (const Exponents& a : lattice(3, degree))
  {
    coefficients.insert(coefficients.end(),
      { a[0] / double(degree), a[1] / double(degree), a[2] / double(degree), 1.0 });
  }
  const std::array<double, 3> u{ 0.3, 0.2, 0.4 };
  const std::vector<Exponents> points = lattice(3, order);
  std::vector<double> net(points.size() * 4);
  parts.tetrahedronNet.single(degree, order, u.data(), coefficients.data(), net.data());
  for (std::size_t m = 0; m < points.size(); ++m)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(net[4 * m + axis],
        (degree - order) / double(degree) * u[axis] + points[m][axis] / double(degree), 1e-15);
    }
    EXPECT_NEAR(net[4 * m + 3], 1.0, 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SimplexNet, ::testing::ValuesIn(availableParts()), nameOfParts);

} // namespace
} // namespace hop::testing
