#include "Elements/DerivativeBounds.h"
#include "Elements/DerivedField.h"

#include "ElementCases.h"
#include "TestMeshes.h"
#include "VectorElements.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr std::array<Quantity, 4> allQuantities{ Quantity::GradientMagnitude, Quantity::Divergence,
  Quantity::VorticityMagnitude, Quantity::QCriterion };

/// What an element's map is.
enum class Shape
{
  Affine,
  Straight,
  Curved,
  Rational
};

constexpr std::array<Shape, 4> allShapes{ Shape::Affine, Shape::Straight, Shape::Curved,
  Shape::Rational };

/// An element with a vector field of random coefficients.
struct VectorElement
{
  VectorElement(const ElementCase& element, Shape shape, Random& random)
    : which(element)
    , isRational(shape == Shape::Rational)
  {
    // Thin, turned, and far from the origin.
    const glm::dmat3 stretch(2.0, 0.3, 0.1, -0.2, 0.05, 0.4, 0.3, 0.0, 1.5);
    const double bend = shape == Shape::Curved || shape == Shape::Rational ? 0.08 : 0.0;
    const double skew = shape == Shape::Affine ? 0.0 : 0.2;
    for (const LatticePoint& point : latticePoints(element.domain, element.degrees))
    {
      const glm::dvec3 u = latticePosition(element.degrees, point).xyz;
      const glm::dvec3 straight = u + skew * glm::dvec3(u.y * u.z, u.x * u.z, u.x * u.y);
      const glm::dvec3 random3(randomNumber(random), randomNumber(random), randomNumber(random));
      const glm::dvec3 x = stretch * (straight + bend / element.degrees[0] * random3) + 3.0;
      this->weights.push_back(this->isRational ? 1.0 + 0.1 * randomNumber(random) : 1.0);
      for (int c = 0; c < 6; ++c)
      {
        this->control.push_back(this->weights.back() * (c < 3 ? x[c] : randomNumber(random)));
      }
    }
  }

  SourceElement source() const
  {
    return { this->which.domain, this->which.degrees, 6, this->control, this->weights,
      this->isRational, 1e-15 };
  }

  /// The element with one component of the vector as its field.
  Jet jet(int component, const ReferencePoint& u) const
  {
    std::vector<Coefficient> coefficients;
    for (std::size_t i = 0; i < this->control.size(); i += 6)
    {
      const double* row = &this->control[i];
      coefficients.emplace_back(row[0], row[1], row[2], row[3 + component]);
    }
    return evaluateGradient({ this->which.domain, this->which.degrees, coefficients.data(),
                              this->isRational ? this->weights.data() : nullptr },
      u);
  }

  /// G[i][j] = du_i/dx_j.
  std::array<glm::dvec3, 3> gradient(const ReferencePoint& u) const
  {
    std::array<glm::dvec3, 3> result;
    for (int i = 0; i < 3; ++i)
    {
      const Jet jet = this->jet(i, u);
      const glm::dmat3 jacobian{ glm::dvec3(jet.first[0]), glm::dvec3(jet.first[1]),
        glm::dvec3(jet.first[2]) };
      result[i] = gradientOf(jet) * glm::inverse(jacobian);
    }
    return result;
  }

  ElementCase which;
  bool isRational;
  std::vector<double> control;
  std::vector<double> weights;
};

/// The quantity, or its square where that is derived, from the definition.
double valueOf(Quantity quantity, const std::array<glm::dvec3, 3>& g)
{
  const glm::dvec3 curl(g[2].y - g[1].z, g[0].z - g[2].x, g[1].x - g[0].y);
  double trace2 = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      trace2 += g[i][j] * g[j][i];
    }
  }
  switch (quantity)
  {
    case Quantity::GradientMagnitude:
      return glm::dot(g[0], g[0]) + glm::dot(g[1], g[1]) + glm::dot(g[2], g[2]);
    case Quantity::Divergence:
      return g[0].x + g[1].y + g[2].z;
    case Quantity::VorticityMagnitude:
      return glm::dot(curl, curl);
    case Quantity::QCriterion:
      return -0.5 * trace2;
    default: // no polynomials
      break;
  }
  return 0.0;
}

BernsteinForm formOf(const ElementCase& which, const DerivedElement& derived)
{
  return { which.domain, derived.degrees, derived.coefficients.data(),
    derived.weights.empty() ? nullptr : derived.weights.data() };
}

std::vector<ElementCase> cases()
{
  return { { Domain::Hexahedron, { 2, 2, 2 } }, { Domain::Hexahedron, { 3, 1, 2 } },
    { Domain::Tetrahedron, { 2, 2, 2 } }, { Domain::Tetrahedron, { 3, 3, 3 } },
    { Domain::Wedge, { 2, 2, 2 } }, { Domain::Wedge, { 3, 3, 1 } } };
}

TEST(DerivedField, AgreesWithDerivativesPointByPoint)
{
  Random random(11);
  for (const ElementCase& which : cases())
  {
    for (const Shape shape : allShapes)
    {
      if (shape == Shape::Rational && which.degrees[0] > 2)
      {
        continue; // its degree would be too high
      }
      for (const Quantity quantity : allQuantities)
      {
        const VectorElement element(which, shape, random);
        const Derivation derivation(element.source(), quantity);
        const DerivedElement derived = derivation.element();
        ASSERT_EQ(derived.state, DerivedElement::State::Sound);
        const DerivativeBounds bounds(element.source());
        const Range range = bounds.of(quantity);
        for (int n = 0; n < 20; ++n)
        {
          const ReferencePoint u =
            insidePoint(which.domain, { random.uniform(), random.uniform(), random.uniform() });
          const Jet jet = evaluateGradient(formOf(which, derived), u);
          const double expected = valueOf(quantity, element.gradient(u));
          EXPECT_NEAR(jet.value.w, expected, 1e3 * bounds.rounding(quantity))
            << which << " shape " << int(shape) << " quantity " << int(quantity);
          EXPECT_LT(
            glm::distance(glm::dvec3(jet.value), glm::dvec3(element.jet(0, u).value)), 1e-12);
          EXPECT_TRUE(range.lower <= expected && expected <= range.upper);
        }
      }
    }
  }
}

/// Bounds of lambda 2 hold, and where the gradient hardly changes they are narrow.
TEST(DerivedField, BoundsLambda2)
{
  Random random(16);
  const FieldFunction lambda2 = functionOf(Quantity::Lambda2);
  for (const ElementCase& which : cases())
  {
    for (const Shape shape : allShapes)
    {
      VectorElement element(which, shape, random);
      for (std::size_t i = 0; i < element.control.size(); i += 6)
      {
        double* row = &element.control[i];
        const glm::dvec3 linear(row[1] - 2.0 * row[0], row[2], row[0] + row[2]);
        for (int c = 0; c < 3; ++c)
        {
          row[3 + c] = linear[c] + 1e-4 * row[3 + c];
        }
      }
      const Range range = DerivativeBounds(element.source()).of(Quantity::Lambda2);
      for (int n = 0; n < 20; ++n)
      {
        const ReferencePoint u =
          insidePoint(which.domain, { random.uniform(), random.uniform(), random.uniform() });
        const double value = lambda2(vectorFieldAt(element.source(), u));
        EXPECT_LT(range.lower, value);
        EXPECT_GT(range.upper, value);
      }
      // The squares of the gradient's entries, by which it could be bounded, too, sum up to 8.
      EXPECT_TRUE(shape != Shape::Affine || range.upper - range.lower < 1.0) << which;
    }
  }
}

TEST(DerivedField, IsPolynomialOnAffineElements)
{
  Random random(12);
  for (const ElementCase& which : cases())
  {
    const VectorElement affine(which, Shape::Affine, random);
    const DerivedElement derived = Derivation(affine.source(), Quantity::QCriterion).element();
    ASSERT_EQ(derived.state, DerivedElement::State::Sound);
    EXPECT_TRUE(derived.weights.empty()) << which;
    for (int a = 0; a < 3; ++a)
    {
      EXPECT_LE(derived.degrees[a], 2 * which.degrees[a]);
    }
  }
}

TEST(DerivedField, TakesNodesThatAreRoundedForStraight)
{
  Random random(13);
  VectorElement element({ Domain::Tetrahedron, { 3, 3, 3 } }, Shape::Affine, random);
  for (std::size_t i = 0; i < element.control.size(); ++i)
  {
    element.control[i] = i % 6 < 3 ? static_cast<float>(element.control[i]) : element.control[i];
  }
  SourceElement source = element.source();
  EXPECT_FALSE(Derivation(source, Quantity::QCriterion).element().weights.empty());
  source.coordinateError = 4e-7;
  EXPECT_TRUE(Derivation(source, Quantity::QCriterion).element().weights.empty());
}

TEST(DerivedField, RefusesHighDegreesOfCurvedElements)
{
  Random random(14);
  const ElementCase high{ Domain::Hexahedron, { 7, 7, 7 } };
  const VectorElement curved(high, Shape::Curved, random);
  EXPECT_EQ(Derivation(curved.source(), Quantity::QCriterion).element().state,
    DerivedElement::State::DegreeTooHigh);
  const VectorElement affine(high, Shape::Affine, random);
  EXPECT_EQ(Derivation(affine.source(), Quantity::QCriterion).element().state,
    DerivedElement::State::Sound);
}

/// A hexahedron whose upper face is one point: u = (x y, y z, z x) has a finite gradient in its apex.
TEST(DerivedField, IsFiniteInAnApex)
{
  const Degrees degrees{ 2, 2, 2 };
  std::vector<double> control;
  for (const LatticePoint& point : latticePoints(Domain::Hexahedron, degrees))
  {
    // x = (1 - w) (2u - 1), y = (1 - w) (2v - 1), z = w, and products of them, by their Bernstein coefficients.
    const double x = (point.i - 1.0) * (1.0 - 0.5 * point.k);
    const double y = (point.j - 1.0) * (1.0 - 0.5 * point.k);
    const double z = 0.5 * point.k;
    // (1 - w)^2 has the coefficients 1, 0, 0; (1 - w) w has 0, 1/2, 0.
    const double both = point.k == 0 ? 1.0 : 0.0;
    const double mixed = point.k == 1 ? 0.5 : 0.0;
    control.insert(control.end(),
      { x, y, z, both * (point.i - 1.0) * (point.j - 1.0), mixed * (point.j - 1.0),
        mixed * (point.i - 1.0) });
  }
  const std::vector<double> weights;
  const SourceElement source{ Domain::Hexahedron, degrees, 6, control, weights, false, 1e-15 };
  const Derivation derivation(source, Quantity::GradientMagnitude);
  const DerivedElement derived = derivation.element();
  ASSERT_EQ(derived.state, DerivedElement::State::Sound);
  for (const double w : { 0.0, 0.3, 0.9, 1.0 })
  {
    const Jet jet = evaluateGradient(
      formOf({ Domain::Hexahedron, degrees }, derived), ReferencePoint{ { 0.3, 0.6, w } });
    const glm::dvec3 x(jet.value);
    EXPECT_NEAR(jet.value.w, 2.0 * glm::dot(x, x), 1e-10); // |grad(xy)|^2 + |grad(yz)|^2 + ...
  }
}

/// Where the determinant changes its sign the gradient is infinite.
TEST(DerivedField, RefusesFoldedElements)
{
  Random random(15);
  VectorElement element({ Domain::Hexahedron, { 2, 2, 2 } }, Shape::Affine, random);
  for (int c = 0; c < 3; ++c)
  {
    element.control[c] = 4.0 - 2.0 * (element.control[c] - 3.0);
  }
  element.control[0] += 3.0;
  EXPECT_EQ(Derivation(element.source(), Quantity::Divergence).element().state,
    DerivedElement::State::Singular);
}

} // namespace
} // namespace hop::testing
