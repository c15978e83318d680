#include "Elements/ExpressionTerm.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

/// x = (2, 3, 5), a scalar 7 with the gradient (1, 2, 3), and a vector (1, 2, 4) with gradients (0, -1, 0), (1, 0, 0) and
/// (0, 0, 2).
FieldPoint somePoint()
{
  FieldPoint at;
  at.x = { 2.0, 3.0, 5.0 };
  at.values = { 7.0, 1.0, 2.0, 4.0 };
  at.gradients = { { 1.0, 2.0, 3.0 }, { 0.0, -1.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 2.0 } };
  return at;
}

void expectTerm(const ExpressionTerm& term, const std::vector<double>& expected)
{
  ASSERT_EQ(term.size, static_cast<int>(expected.size()));
  const ExpressionTerm::Value value = term.at(somePoint());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_DOUBLE_EQ(value[i], expected[i]) << i;
  }
}

TEST(ExpressionTerm, ReadsNumbersCoordinatesAndArrays)
{
  expectTerm(constantTerm(1.5), { 1.5 });
  expectTerm(coordinateTerm(1), { 3.0 });
  expectTerm(coordinatesTerm(), { 2.0, 3.0, 5.0 });
  expectTerm(valueTerm(0, 1), { 7.0 });
  expectTerm(valueTerm(1, 3), { 1.0, 2.0, 4.0 });
}

TEST(ExpressionTerm, ReadsDerivatives)
{
  expectTerm(gradientTerm(0, 1), { 1.0, 2.0, 3.0 });
  expectTerm(gradientTerm(1, 3), { 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 2.0 });
  expectTerm(curlTerm(1), { 0.0, 0.0, 2.0 });
  expectTerm(quantityTerm(Quantity::Divergence, 1), { 2.0 });
  expectTerm(quantityTerm(Quantity::QCriterion, 1), { 1.0 - 2.0 });
}

TEST(ExpressionTerm, CombinesScalarsWithEveryNumber)
{
  const auto difference = Operation::Difference;
  expectTerm(combined(difference, valueTerm(1, 3), constantTerm(1.0)), { 0.0, 1.0, 3.0 });
  expectTerm(combined(difference, constantTerm(1.0), valueTerm(1, 3)), { 0.0, -1.0, -3.0 });
  expectTerm(combined(difference, coordinatesTerm(), valueTerm(1, 3)), { 1.0, 1.0, 1.0 });
  expectTerm(combined(Operation::Sum, valueTerm(0, 1), constantTerm(1.0)), { 8.0 });
  expectTerm(
    combined(Operation::Product, valueTerm(0, 1), coordinatesTerm()), { 14.0, 21.0, 35.0 });
  expectTerm(combined(Operation::Quotient, valueTerm(0, 1), constantTerm(2.0)), { 3.5 });
  expectTerm(combined(Operation::Power, valueTerm(0, 1), constantTerm(2.0)), { 49.0 });
  expectTerm(combined(Operation::Least, valueTerm(0, 1), constantTerm(2.0)), { 2.0 });
  expectTerm(combined(Operation::Greatest, valueTerm(0, 1), constantTerm(2.0)), { 7.0 });
}

TEST(ExpressionTerm, MultipliesVectors)
{
  expectTerm(dotOf(coordinatesTerm(), valueTerm(1, 3)), { 28.0 });
  expectTerm(crossOf(coordinatesTerm(), valueTerm(1, 3)), { 2.0, -3.0, 1.0 });
  expectTerm(lengthOf(gradientTerm(1, 3)), { std::sqrt(6.0) });
}

TEST(ExpressionTerm, KnowsFunctionsOfScalars)
{
  EXPECT_EQ(scalarFunctionNames().size(), 18u);
  expectTerm(functionTerm("log10", constantTerm(100.0)), { 2.0 });
  expectTerm(functionTerm("ln", constantTerm(std::exp(2.0))), { 2.0 });
  expectTerm(functionTerm("sign", constantTerm(-3.0)), { -1.0 });
}

} // namespace
} // namespace hop::testing
