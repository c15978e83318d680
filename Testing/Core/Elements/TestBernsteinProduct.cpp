#include "Elements/BernsteinProduct.h"

#include "ElementCases.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

/// Control values of (x, y, z, v...) and weights, drawn at random.
struct VectorElement
{
  VectorElement(const ElementCase& element, int components, bool rational, Random& random)
    : which(element)
    , width(3 + components)
  {
    for (int i = 0; i < coefficientCount(element.domain, element.degrees); ++i)
    {
      this->weights.push_back(rational ? 0.5 + 1.5 * random.uniform() : 1.0);
      for (int c = 0; c < this->width; ++c)
      {
        this->control.push_back(this->weights.back() * randomNumber(random));
      }
    }
  }

  /// x, y, z and |v|^2 at a point, from the definition.
  Coefficient at(const ReferencePoint& u) const
  {
    std::vector<double> basis(this->weights.size());
    evaluateBasis(this->which.domain, this->which.degrees, u, basis.data());
    std::vector<double> sum(this->width, 0.0);
    double below = 0.0;
    for (std::size_t i = 0; i < basis.size(); ++i)
    {
      below += basis[i] * this->weights[i];
      for (int c = 0; c < this->width; ++c)
      {
        sum[c] += basis[i] * this->control[i * this->width + c];
      }
    }
    Coefficient result(sum[0] / below, sum[1] / below, sum[2] / below, 0.0);
    for (int c = 3; c < this->width; ++c)
    {
      result.w += sum[c] / below * (sum[c] / below);
    }
    return result;
  }

  ElementCase which;
  int width;
  std::vector<double> control;
  std::vector<double> weights;
};

struct Squared
{
  explicit Squared(const VectorElement& element)
    : which{ element.which.domain,
      { 2 * element.which.degrees[0], 2 * element.which.degrees[1], 2 * element.which.degrees[2] } }
    , coefficients(coefficientCount(which.domain, which.degrees))
    , weights(squareField(element.which.domain, element.which.degrees, element.width,
        element.control, element.weights, coefficients.data()))
  {
  }

  BernsteinForm form(bool rational) const
  {
    return { this->which.domain, this->which.degrees, this->coefficients.data(),
      rational ? this->weights.data() : nullptr };
  }

  ElementCase which;
  std::vector<Coefficient> coefficients;
  std::vector<double> weights;
};

TEST(BernsteinProduct, SquaresPointByPoint)
{
  Random random(1);
  for (const ElementCase& which : allElementCases())
  {
    for (const bool rational : { false, true })
    {
      SCOPED_TRACE(::testing::Message() << which << (rational ? ", rational" : ""));
      const int components = 1 + which.degrees[0] % 3;
      const VectorElement element(which, components, rational, random);
      const Squared squared(element);
      for (int n = 0; n < 5; ++n)
      {
        const ReferencePoint u = randomPoint(which.domain, random);
        const Coefficient difference =
          evaluateGradient(squared.form(rational), u).value - element.at(u);
        EXPECT_LE(glm::length(difference), 1e-13);
      }
    }
  }
}

TEST(BernsteinProduct, PolynomialElementsKeepWeightOne)
{
  Random random(2);
  for (const ElementCase& which : allElementCases())
  {
    for (const double weight : Squared(VectorElement(which, 3, false, random)).weights)
    {
      EXPECT_NEAR(weight, 1.0, 1e-13) << which;
    }
  }
}

TEST(BernsteinProduct, RationalWeightsStayPositive)
{
  Random random(3);
  for (const ElementCase& which : allElementCases())
  {
    for (const double weight : Squared(VectorElement(which, 1, true, random)).weights)
    {
      EXPECT_GT(weight, 0.0) << which;
    }
  }
}

TEST(BernsteinProduct, KnownSquareOfTheLine)
{
  // (1 - 2u)^2: coefficients 1, -1, 1.
  const ElementCase line{ Domain::Hexahedron, { 1, 1, 1 } };
  std::vector<double> control;
  for (const LatticePoint& point : latticePoints(line.domain, line.degrees))
  {
    control.insert(control.end(), { 0.0, 0.0, 0.0, 1.0 - 2.0 * point.i });
  }
  std::vector<Coefficient> result(27);
  squareField(line.domain, line.degrees, 4, control, std::vector<double>(8, 1.0), result.data());
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    EXPECT_NEAR(result[i].w, i % 3 == 1 ? -1.0 : 1.0, 1e-15);
  }
}

} // namespace
} // namespace hop::testing
