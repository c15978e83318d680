#include "Elements/ExactField.h"

#include "Elements/SampledField.h"
#include "Elements/SymmetricEigenvalues.h"

#include "ElementCases.h"
#include "TestMeshes.h"
#include "VectorElements.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

glm::dvec3 bent(const glm::dvec3& u)
{
  return u + 0.08 * glm::dvec3(u.y * u.y, std::sin(2.0 * u.z), u.x * u.y);
}

double weightAt(const glm::dvec3& u)
{
  return 1.0 + 0.2 * std::sin(3.0 * u.x + u.y);
}

/// A bent element with a vector field.
struct BentElement : VectorElement
{
  /// \param field of the place
  template <class Field>
  BentElement(const ElementCase& which, bool isRational, const Field& field)
    : VectorElement(
        which, isRational, bent, [&](const glm::dvec3& u) { return field(bent(u)); }, weightAt)
  {
  }

  /// The quantity from the gradients of one component after the other.
  double at(Quantity quantity, const ReferencePoint& u) const
  {
    return functionOf(quantity)(vectorFieldAt(this->source(), u));
  }
};

constexpr Quantity quantities[] = { Quantity::GradientMagnitude, Quantity::Divergence,
  Quantity::VorticityMagnitude, Quantity::QCriterion, Quantity::Lambda2 };

Jet jetOf(const BentElement& some, const ExactSource& exact, const ReferencePoint& u)
{
  return exactHessian(some.element.domain, exact.field, exact.coefficients.data(), u);
}

ExactSource exactPart(const BentElement& some, Quantity quantity, const ReferencePart& part)
{
  ExactSource exact = exactSource(some.source(), quantity);
  exact.field.part = part;
  return exact;
}

ReferencePoint moved(ReferencePoint u, int axis, double step)
{
  u.xyz[axis] += step;
  return u;
}

const ElementCase cases[] = { { Domain::Hexahedron, { 3, 2, 4 } },
  { Domain::Tetrahedron, { 4, 4, 4 } }, { Domain::Wedge, { 3, 3, 2 } } };

TEST(ExactField, AgreesWithTheGradientPointByPoint)
{
  Random random(31);
  for (const ElementCase& which : cases)
  {
    for (const bool isRational : { false, true })
    {
      const BentElement some(which, isRational,
        [&](const glm::dvec3&)
        { return glm::dvec3(randomNumber(random), randomNumber(random), randomNumber(random)); });
      for (const Quantity quantity : quantities)
      {
        for (const ReferencePart& part : partsOf(which.domain, 1))
        {
          ExactSource exact = exactPart(some, quantity, part);
          EXPECT_EQ(exact.coefficients.size(), coefficientCount(which.domain, exact.field));
          exact.field.scale = 0.25;
          const ReferencePoint u =
            insidePoint(which.domain, { random.uniform(), random.uniform(), random.uniform() });
          const double expected = 0.25 * some.at(quantity, part.inWhole(u));
          EXPECT_NEAR(jetOf(some, exact, u).value.w, expected, 1e-9 * (1.0 + std::abs(expected)))
            << which << isRational << static_cast<int>(quantity);
        }
      }
    }
  }
}

TEST(ExactField, HasTheDerivativesOfDifferences)
{
  Random random(32);
  constexpr double step = 1e-4;
  for (const ElementCase& which : cases)
  {
    const BentElement some(which, which.domain == Domain::Wedge,
      [](const glm::dvec3& x) {
        return glm::dvec3(std::sin(3.0 * x.y), x.z * x.z + 2.0 * x.x, std::cos(2.0 * x.x) * x.y);
      });
    for (int n = 0; n < 50; ++n)
    {
      const ExactSource exact = exactPart(some, quantities[n % 5], partsOf(which.domain, 1)[4]);
      const ReferencePoint u =
        insidePoint(which.domain, { random.uniform(), random.uniform(), random.uniform() });
      const Jet here = jetOf(some, exact, u);
      for (int a = 0; a < 3; ++a)
      {
        const Jet after = jetOf(some, exact, moved(u, a, step));
        const Jet before = jetOf(some, exact, moved(u, a, -step));
        for (int c = 0; c < 4; ++c)
        {
          const glm::dmat3 hessian = hessianOf(here.second, c);
          const double scale = 1.0 + std::abs(hessian[a][a]);
          EXPECT_NEAR(
            here.first[a][c], (after.value[c] - before.value[c]) / (2.0 * step), 1e-5 * scale);
          for (int b = 0; b < 3; ++b)
          {
            const double second = (after.first[b][c] - before.first[b][c]) / (2.0 * step);
            EXPECT_NEAR(hessian[a][b], second, 1e-4 * scale) << which << n << " " << a << b << c;
          }
        }
      }
      const Jet gradient = exactGradient(which.domain, exact.field, exact.coefficients.data(), u);
      const double size = 1.0 + std::abs(here.value.w) + glm::length(gradientOf(here));
      EXPECT_LT(glm::distance(gradient.value, here.value), 1e-11 * size);
      for (int a = 0; a < 3; ++a)
      {
        EXPECT_LT(glm::distance(gradient.first[a], here.first[a]), 1e-11 * size);
      }
    }
  }
}

TEST(ExactField, HasThePlaceOfTheCell)
{
  Random random(33);
  for (const ElementCase& which : cases)
  {
    const BentElement some(which, true, [](const glm::dvec3& x) { return x; });
    const ExactSource exact = exactPart(some, Quantity::Divergence, {});
    const ReferencePoint u =
      insidePoint(which.domain, { random.uniform(), random.uniform(), random.uniform() });
    const FieldPoint expected = vectorFieldAt(some.source(), u);
    EXPECT_LT(glm::distance(glm::dvec3(jetOf(some, exact, u).value), expected.x), 1e-14) << which;
  }
}

TEST(ExactField, TakesTheGradientOfAScalar)
{
  const std::vector<double> weights;
  std::vector<double> control;
  for (const LatticePoint& point : latticePoints(Domain::Wedge, { 1, 1, 1 }))
  {
    const glm::dvec3 x = 2.0 * latticePosition({ 1, 1, 1 }, point).xyz;
    control.insert(control.end(), { x.x, x.y, x.z, 3.0 * x.x - 2.0 * x.y + x.z });
  }
  const SourceElement source{ Domain::Wedge, { 1, 1, 1 }, 4, control, weights };
  const ExactSource exact = exactSource(source, Quantity::GradientMagnitude);
  const Jet jet =
    exactHessian(Domain::Wedge, exact.field, exact.coefficients.data(), { { 0.2, 0.3, 0.4 } });
  EXPECT_NEAR(jet.value.w, 14.0, 1e-13); // squared
}

/// A vortex with strain: eigenvalues are equal in its axis, or everywhere.
TEST(ExactField, IsFiniteWhereEigenvaluesAreEqual)
{
  const ElementCase which{ Domain::Hexahedron, { 3, 3, 3 } };
  for (const double bend : { 0.0, 1.0 })
  {
    const BentElement some(which, false,
      [bend](const glm::dvec3& x)
      { return glm::dvec3(-x.y + bend * x.x * x.x, x.x, bend * x.z * x.y); });
    const ExactSource exact = exactPart(some, Quantity::Lambda2, {});
    for (const double t : { 0.0, 0.25, 0.5, 1.0 })
    {
      const Jet jet = jetOf(some, exact, { { t, t, t } });
      double sum = jet.value.w;
      for (const Coefficient& derivative : jet.first)
      {
        sum += derivative.w;
      }
      for (const Coefficient& derivative : jet.second)
      {
        sum += derivative.w;
      }
      EXPECT_TRUE(std::isfinite(sum)) << bend << " " << t;
    }
  }
}

TEST(Eigensystem, DiagonalizesAlsoEqualEigenvalues)
{
  Random random(33);
  for (int n = 0; n < 200; ++n)
  {
    glm::dvec3 values(randomNumber(random), randomNumber(random), randomNumber(random));
    values.y = n % 3 == 0 ? values.x : values.y;
    const glm::dvec3 a =
      glm::normalize(glm::dvec3(randomNumber(random), randomNumber(random), randomNumber(random)));
    const glm::dvec3 b = glm::normalize(glm::cross(a, glm::dvec3(0.3, 0.5, 0.8)));
    const glm::dmat3 q(a, b, glm::cross(a, b));
    const glm::dmat3 d(glm::dvec3(values.x, 0.0, 0.0), glm::dvec3(0.0, values.y, 0.0),
      glm::dvec3(0.0, 0.0, values.z));
    const glm::dmat3 matrix = q * d * glm::transpose(q);
    const Eigensystem system = eigensystemOf(0.5 * (matrix + glm::transpose(matrix)));
    EXPECT_LE(system.values[0], system.values[1]);
    EXPECT_LE(system.values[1], system.values[2]);
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec3& v = system.vectors[i];
      EXPECT_LT(glm::length(matrix * v - system.values[i] * v), 1e-14) << n;
    }
  }
  EXPECT_EQ(eigensystemOf(glm::dmat3(0.0)).values, glm::dvec3(0.0));
}

} // namespace
} // namespace hop::testing
