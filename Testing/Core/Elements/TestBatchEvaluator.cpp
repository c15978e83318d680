#include "Elements/BatchEvaluator.h"
#include "Kernel/InstructionSet.h"

#include "ElementCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace hop::testing
{
namespace
{

/// Large enough for several vectors and a tail of any length.
constexpr int mostPoints = 17;

/// An element with memory of its own, polynomial or rational.
struct SampleElement
{
  ElementCase which;
  std::vector<Coefficient> coefficients;
  std::vector<double> weights;

  SampleElement(const ElementCase& element, bool rational, Random& random)
    : which(element)
    , coefficients(randomCoefficients(element, random))
  {
    if (rational)
    {
      for (Coefficient& c : this->coefficients)
      {
        this->weights.push_back(1.0 + 0.5 * randomNumber(random));
        c *= this->weights.back();
      }
    }
  }

  BernsteinForm form() const
  {
    return { this->which.domain, this->which.degrees, this->coefficients.data(),
      this->weights.empty() ? nullptr : this->weights.data() };
  }
};

std::vector<ReferencePoint> randomPoints(Domain domain, int count, Random& random)
{
  std::vector<ReferencePoint> points;
  for (int n = 0; n < count; ++n)
  {
    points.push_back(randomPoint(domain, random));
  }
  return points;
}

/// Each derivative of a polynomial of degree p amplifies rounding by about p^2.
double toleranceOf(const ElementCase& which, int order)
{
  const double p = std::max({ which.degrees[0], which.degrees[1], which.degrees[2] });
  return 2e-15 * p * std::pow(4.0 * p * p, order) * 4.0;
}

double distance(const Coefficient& a, const Coefficient& b)
{
  return glm::length(a - b);
}

void expectNear(const Jet& actual, const Jet& expected, const ElementCase& which)
{
  EXPECT_LE(distance(actual.value, expected.value), toleranceOf(which, 0));
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_LE(distance(actual.first[a], expected.first[a]), toleranceOf(which, 1));
  }
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_LE(distance(actual.second[i], expected.second[i]), toleranceOf(which, 2));
  }
}

bool sameBits(const Jet& a, const Jet& b)
{
  return std::memcmp(&a, &b, sizeof(Jet)) == 0;
}

/// A polynomial by its control net, evaluated as a sum over the basis. Its derivative along a
/// coordinate is one too, with the coefficients p (c_(next) - c) on the lattice one degree lower.
struct Differentiated
{
  Domain domain;
  Degrees degrees;
  std::vector<Coefficient> coefficients;

  Coefficient value(const ReferencePoint& u) const
  {
    std::vector<double> basis(this->coefficients.size());
    evaluateBasis(this->domain, this->degrees, u, basis.data());
    Coefficient sum(0.0);
    for (std::size_t i = 0; i < basis.size(); ++i)
    {
      sum += basis[i] * this->coefficients[i];
    }
    return sum;
  }

  Differentiated along(int axis) const
  {
    Degrees lower = this->degrees;
    const bool inSimplex =
      this->domain == Domain::Tetrahedron || (this->domain == Domain::Wedge && axis < 2);
    for (int other = 0; other < 3; ++other)
    {
      const bool sharesDegree = inSimplex && (this->domain == Domain::Tetrahedron || other < 2);
      lower[other] -= other == axis || sharesDegree ? 1 : 0;
    }
    Differentiated result{ this->domain, lower, {} };
    for (const LatticePoint& at : latticePoints(this->domain, lower))
    {
      const LatticePoint next{ at.i + (axis == 0), at.j + (axis == 1), at.k + (axis == 2) };
      result.coefficients.push_back(static_cast<double>(this->degrees[axis]) *
        (this->coefficients[coefficientIndex(this->domain, this->degrees, next)] -
          this->coefficients[coefficientIndex(this->domain, this->degrees, at)]));
    }
    return result;
  }
};

/// The jet of a polynomial element by differentiated control nets.
Jet referenceJet(const SampleElement& element, const ReferencePoint& u)
{
  const Differentiated f{ element.which.domain, element.which.degrees, element.coefficients };
  Jet jet;
  jet.value = f.value(u);
  for (int a = 0, i = 0; a < 3; ++a)
  {
    const Differentiated slope = f.along(a);
    jet.first[a] = slope.value(u);
    for (int b = a; b < 3; ++b, ++i)
    {
      jet.second[i] = slope.degrees[b] > 0 ? slope.along(b).value(u) : Coefficient(0.0);
    }
  }
  return jet;
}

class BatchEvaluator : public ::testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }
};

TEST_P(BatchEvaluator, AgreesWithDifferentiatedControlNets)
{
  Random random(21);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    const SampleElement element(which, false, random);
    const auto points = randomPoints(which.domain, 3, random);
    JetBatch jets;
    evaluateHessians(element.form(), points.data(), 3, jets);
    for (int n = 0; n < 3; ++n)
    {
      const Jet expected = referenceJet(element, points[n]);
      expectNear(jets.jet(n), expected, which);
      expectNear(evaluateHessian(element.form(), points[n]), expected, which);
    }
  }
}

TEST_P(BatchEvaluator, AgreesWithSinglePointsForEveryBatchSize)
{
  Random random(22);
  JetBatch jets;
  for (const ElementCase& which : allElementCases())
  {
    for (const bool rational : { false, true })
    {
      SCOPED_TRACE(::testing::Message() << which << (rational ? ", rational" : ""));
      const SampleElement element(which, rational, random);
      const auto points = randomPoints(which.domain, mostPoints, random);
      for (int count = 1; count <= mostPoints; ++count)
      {
        const int last = count - 1;
        evaluateHessians(element.form(), points.data(), count, jets);
        ASSERT_EQ(jets.size(), count);
        ASSERT_TRUE(jets.hasHessians());
        expectNear(jets.jet(last), evaluateHessian(element.form(), points[last]), which);
        evaluateGradients(element.form(), points.data(), count, jets);
        ASSERT_FALSE(jets.hasHessians());
        expectNear(jets.jet(last), evaluateGradient(element.form(), points[last]), which);
      }
    }
  }
}

TEST_P(BatchEvaluator, NeitherSizeNorPlaceChangesABit)
{
  Random random(23);
  JetBatch together, alone;
  for (const ElementCase& which : allElementCases())
  {
    for (const bool rational : { false, true })
    {
      SCOPED_TRACE(::testing::Message() << which << (rational ? ", rational" : ""));
      const SampleElement element(which, rational, random);
      const auto points = randomPoints(which.domain, mostPoints, random);
      for (const auto evaluate : { evaluateGradients, evaluateHessians })
      {
        evaluate(element.form(), points.data(), mostPoints, together);
        for (int first = 0; first < mostPoints; ++first)
        {
          const int count = std::min(1 + first % 5, mostPoints - first);
          evaluate(element.form(), points.data() + first, count, alone);
          for (int n = 0; n < count; ++n)
          {
            ASSERT_TRUE(sameBits(alone.jet(n), together.jet(first + n)))
              << "point " << first + n << " as number " << n << " of " << count;
          }
        }
      }
    }
  }
}

TEST_P(BatchEvaluator, RationalElementWithEqualWeightsIsThePolynomial)
{
  Random random(24);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(which);
    SampleElement element(which, false, random);
    const ReferencePoint u = randomPoint(which.domain, random);
    const Jet expected = evaluateHessian(element.form(), u);
    for (Coefficient& c : element.coefficients)
    {
      c *= 3.0;
    }
    element.weights.assign(element.coefficients.size(), 3.0);
    JetBatch jets;
    evaluateHessians(element.form(), &u, 1, jets);
    expectNear(jets.jet(0), expected, which);
    expectNear(evaluateHessian(element.form(), u), expected, which);
  }
}

TEST_P(BatchEvaluator, AQuarterOfACircleHasRadiusOneAndIsFollowedByItsDerivatives)
{
  // The quarter circle in u as a rational quadratic, moved along v and w.
  const ElementCase which{ Domain::Hexahedron, { 2, 1, 1 } };
  const glm::dvec2 corners[3] = { { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
  std::vector<Coefficient> coefficients;
  std::vector<double> weights;
  for (const auto& at : latticePoints(which.domain, which.degrees))
  {
    weights.push_back(at.i == 1 ? std::sqrt(0.5) : 1.0);
    coefficients.push_back(weights.back() * Coefficient(corners[at.i], at.j, at.k));
  }
  const BernsteinForm form{ which.domain, which.degrees, coefficients.data(), weights.data() };
  Random random(25);
  const auto points = randomPoints(which.domain, mostPoints, random);
  JetBatch jets;
  evaluateHessians(form, points.data(), mostPoints, jets);
  for (int n = 0; n < mostPoints; ++n)
  {
    const Jet jet = jets.jet(n);
    const glm::dvec2 x(jet.value), dx(jet.first[0]), ddx(jet.second[0]);
    EXPECT_NEAR(glm::dot(x, x), 1.0, 1e-14);
    EXPECT_NEAR(glm::dot(x, dx), 0.0, 1e-14);
    EXPECT_NEAR(glm::dot(dx, dx) + glm::dot(x, ddx), 0.0, 1e-13);
    EXPECT_NEAR(jet.value.z, points[n].xyz.y, 1e-15);
    EXPECT_NEAR(jet.value.w, points[n].xyz.z, 1e-15);
  }
}

TEST_P(BatchEvaluator, RowsAreAlignedAndAnEmptyBatchIsEmpty)
{
  Random random(26);
  const SampleElement element({ Domain::Wedge, { 3, 3, 3 } }, false, random);
  const auto points = randomPoints(Domain::Wedge, mostPoints, random);
  JetBatch jets;
  evaluateHessians(element.form(), points.data(), 0, jets);
  EXPECT_EQ(jets.size(), 0);
  evaluateHessians(element.form(), points.data(), mostPoints, jets);
  for (int quantity = 0; quantity < 10; ++quantity)
  {
    for (int component = 0; component < 4; ++component)
    {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(jets.row(quantity, component)) % 64, 0u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BatchEvaluator, ::testing::ValuesIn(availableInstructionSets()),
  [](const ::testing::TestParamInfo<InstructionSet>& which)
  {
    std::string name = nameOf(which.param);
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

TEST(InstructionSets, TheLastOneIsUsedAndTheBaselineIsThere)
{
  const auto sets = availableInstructionSets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.front(), InstructionSet::Baseline);
  EXPECT_EQ(instructionSet(), sets.back());
}

} // namespace
} // namespace hop::testing
