#include "Elements/NodalBasis.h"
#include "Elements/SampledField.h"
#include "Elements/SymmetricEigenvalues.h"

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

/// A bent element with a smooth vector field, or one of random coefficients.
struct Bent
{
  Bent(const ElementCase& which, bool isSmooth, Random& random)
    : element(which)
  {
    for (const LatticePoint& point : latticePoints(which.domain, which.degrees))
    {
      const glm::dvec3 u = latticePosition(which.degrees, point).xyz;
      const glm::dvec3 x = u + 0.08 * glm::dvec3(u.y * u.y, std::sin(2.0 * u.z), u.x * u.y);
      const glm::dvec3 field = isSmooth
        ? glm::dvec3(std::sin(2.0 * u.y + u.x), std::cos(u.z) * u.x, std::exp(u.x * u.y))
        : glm::dvec3(randomNumber(random), randomNumber(random), randomNumber(random));
      this->control.insert(this->control.end(), { x.x, x.y, x.z, field.x, field.y, field.z });
    }
  }

  SourceElement source() const
  {
    return { this->element.domain, this->element.degrees, 6, this->control, this->weights, false,
      1e-15 };
  }

  /// By differences of nothing: gradients of one component after the other.
  FieldPoint at(const ReferencePoint& u) const { return vectorFieldAt(this->source(), u); }

  ElementCase element;
  std::vector<double> control;
  std::vector<double> weights;
};

const auto everything = [](const Range&) { return true; };

/// Compares parts with the field at random points.
void expectAgreement(const Bent& bent, Quantity quantity, int halvings, Random& random)
{
  const FieldFunction function = functionOf(quantity);
  const SourceElement source = bent.source();
  FieldSampler sampler(source, quantity, function, 0.0);
  for (const ReferencePart& part : partsOf(bent.element.domain, halvings))
  {
    const SampledPart sampled = sampler.sample(part, everything);
    ASSERT_EQ(sampled.element.state, DerivedElement::State::Sound);
    EXPECT_TRUE(sampled.isResolved) << bent.element;
    const BernsteinForm form{ bent.element.domain, sampled.element.degrees,
      sampled.element.coefficients.data(), nullptr };
    for (int n = 0; n < 20; ++n)
    {
      const ReferencePoint v =
        insidePoint(bent.element.domain, { random.uniform(), random.uniform(), random.uniform() });
      const Coefficient value = evaluateGradient(form, v).value;
      const FieldPoint expected = bent.at(part.inWhole(v));
      const Range range = fieldRange(form);
      EXPECT_NEAR(value.w, function(expected), 1e-8 * range.magnitude()) << bent.element;
      EXPECT_LT(glm::distance(glm::dvec3(value), expected.x), 1e-11);
    }
  }
}

TEST(SampledField, HoldsQuantitiesOfBentElementsOfHighDegree)
{
  Random random(21);
  for (const ElementCase& which : { ElementCase{ Domain::Hexahedron, { 6, 6, 6 } },
         ElementCase{ Domain::Hexahedron, { 9, 9, 9 } }, ElementCase{ Domain::Wedge, { 6, 6, 6 } },
         ElementCase{ Domain::Tetrahedron, { 6, 6, 6 } } })
  {
    const Bent bent(which, true, random);
    for (const Quantity quantity : { Quantity::GradientMagnitude, Quantity::Divergence,
           Quantity::VorticityMagnitude, Quantity::QCriterion })
    {
      expectAgreement(bent, quantity, 1, random);
    }
  }
}

TEST(SampledField, HoldsRandomPolynomialsOnSmallerParts)
{
  Random random(22);
  expectAgreement(
    Bent({ Domain::Hexahedron, { 4, 4, 4 } }, false, random), Quantity::QCriterion, 2, random);
}

/// A field with a fold is not resolved, and says so.
TEST(SampledField, TellsOfWhatItCannotHold)
{
  Random random(23);
  const Bent bent({ Domain::Hexahedron, { 2, 2, 2 } }, true, random);
  const FieldFunction folded = [](const FieldPoint& at) { return std::abs(at.x.x - 0.3); };
  const SourceElement source = bent.source();
  const SampledPart sampled =
    FieldSampler(source, Quantity::Expression, folded, 0.0).sample({}, everything);
  EXPECT_FALSE(sampled.isResolved);
  EXPECT_GT(sampled.error, 1e-4);
  const FieldFunction infinite = [](const FieldPoint& at) { return std::log(at.x.x - 0.3); };
  EXPECT_EQ(
    FieldSampler(source, Quantity::Expression, infinite, 0.0).sample({}, everything).element.state,
    DerivedElement::State::NotFinite);
}

/// Beside a crease higher degrees cost much and help little.
TEST(SampledField, GivesUpHigherDegreesOfProofsBesideACrease)
{
  Random random(25);
  const Bent bent({ Domain::Hexahedron, { 2, 2, 2 } }, true, random);
  const SourceElement source = bent.source();
  int points = 0;
  const FieldFunction folded = [&](const FieldPoint& at)
  {
    ++points;
    return std::abs(at.x.x - 0.3);
  };
  const SampledPart best =
    FieldSampler(source, Quantity::Expression, folded, 0.0).sample({}, everything);
  const int ofBest = points;
  points = 0;
  const SampledPart proof =
    FieldSampler(source, Quantity::Expression, folded, 0.0, StandIn::Proof).sample({}, everything);
  EXPECT_FALSE(proof.isResolved);
  EXPECT_LT(6 * points, ofBest);
  EXPECT_LT(proof.error, 4.0 * best.error);
}

/// What is smooth is not given up.
TEST(SampledField, HoldsSmoothFieldsOfProofs)
{
  Random random(26);
  const Bent bent({ Domain::Hexahedron, { 2, 2, 2 } }, true, random);
  const SourceElement source = bent.source();
  const FieldFunction smooth = [](const FieldPoint& at)
  { return std::sin(2.0 * at.x.x) * std::exp(at.x.y * at.x.z); };
  const SampledPart sampled =
    FieldSampler(source, Quantity::Expression, smooth, 0.0, StandIn::Proof).sample({}, everything);
  EXPECT_TRUE(sampled.isResolved);
}

/// A ball around a node of the lattice on which they are looked for, far above a field with a crease: lower degrees do not see it.
TEST(SampledField, TellsOfComponentsThatItLoses)
{
  Random random(27);
  for (const Domain domain : { Domain::Hexahedron, Domain::Tetrahedron, Domain::Wedge })
  {
    const Bent bent({ domain, { 2, 2, 2 } }, true, random);
    const SourceElement source = bent.source();
    const double onLine = double(gaussLobattoPoints(10)[3]);
    const glm::dvec3 node =
      domain == Domain::Hexahedron ? glm::dvec3(onLine) : glm::dvec3(0.4, 0.1, 0.1);
    const glm::dvec3 middle = bent.at({ node }).x;
    const FieldFunction ball = [&](const FieldPoint& at)
    { return std::max(0.02 - glm::distance(at.x, middle), -0.3 - std::abs(at.x.y - 0.3)); };
    FieldSampler sampler(source, Quantity::Expression, ball, 0.0, StandIn::Proof);
    const SampledPart inBall = sampler.sample({}, everything, { 0.0 });
    EXPECT_FALSE(inBall.isResolved);
    EXPECT_TRUE(inBall.losesComponents);
    EXPECT_FALSE(sampler.sample({}, everything, { 0.1 }).losesComponents);
    EXPECT_FALSE(sampler.sample({}, everything).losesComponents);
  }
}

/// In a vortex u = (-y, x, 0), S = 0 and W^2 = diag(-1, -1, 0): the middle eigenvalue is -1.
TEST(SampledField, Lambda2OfARotationIsNegative)
{
  FieldPoint at;
  at.gradients = { { 0.0, -1.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
  EXPECT_NEAR(functionOf(Quantity::Lambda2)(at), -1.0, 1e-7);
  at.gradients = { { 1.0, 0.0, 0.0 }, { 0.0, -2.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  EXPECT_NEAR(functionOf(Quantity::Lambda2)(at), 1.0, 1e-7); // strain: eigenvalues 1, 1, 4
}

} // namespace
} // namespace hop::testing
