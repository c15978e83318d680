#include "Elements/CollapsedFaces.h"

#include "Elements/ExactField.h"

#include "ElementCases.h"
#include "TestMeshes.h"
#include "VectorElements.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hop::testing
{
namespace
{

using Map = glm::dvec3 (*)(const glm::dvec3&);

/// What becomes of the face w = 1.
struct Collapse
{
  const char* name;
  Map map;
  /// Powers of 1 - w that the derivatives along u, v and w have.
  std::array<int, 3> powers;
};

const Collapse toPoint{ "point",
  [](const glm::dvec3& u) { return glm::dvec3((1.0 - u.z) * u.x, (1.0 - u.z) * u.y, u.z); },
  { 1, 1, 0 } };
const Collapse toEdge{ "edge",
  [](const glm::dvec3& u) { return glm::dvec3((1.0 - u.z) * u.x, u.y, u.z); }, { 1, 0, 0 } };
/// One of its edges is collapsed, but no face.
const Collapse ofEdge{ "no face",
  [](const glm::dvec3& u) { return glm::dvec3(u.x, u.y * (1.0 - u.x * u.z), u.z); }, { 0, 0, 0 } };
const Collapse none{ "nothing", [](const glm::dvec3& u) { return u; }, { 0, 0, 0 } };

/// A product: else the edge of an element that is collapsed to an edge would depend on u.
double weightAt(const glm::dvec3& u)
{
  return (1.0 + 0.2 * std::sin(3.0 * u.x)) * (1.0 + 0.2 * u.y + 0.3 * u.z);
}

glm::dvec3 bent(const glm::dvec3& s)
{
  return s + 0.08 * glm::dvec3(s.y * s.y, std::sin(2.0 * s.z), s.x * s.y);
}

/// Its first component is constant.
glm::dvec3 fieldAt(const glm::dvec3& s)
{
  return { 1.0 / 3.0, std::cos(5.0 * s.x + s.z), std::sin(4.0 * s.y) + s.x * s.z };
}

/// A bent element with a face that is collapsed, and a vector field.
VectorElement collapsedElement(const ElementCase& which, const Collapse& collapse, bool isRational)
{
  return { which, isRational, [&](const glm::dvec3& u) { return bent(collapse.map(u)); },
    [&](const glm::dvec3& u) { return fieldAt(collapse.map(u)); }, weightAt };
}

std::vector<VectorElement> elementsOf(const Collapse& collapse)
{
  std::vector<VectorElement> elements;
  for (const bool isRational : { false, true })
  {
    for (const int p : { 1, 2, 4 })
    {
      elements.push_back(
        collapsedElement(ElementCase{ Domain::Hexahedron, { p, p, p } }, collapse, isRational));
    }
    elements.push_back(
      collapsedElement(ElementCase{ Domain::Hexahedron, { 2, 3, 4 } }, collapse, isRational));
  }
  elements.push_back(collapsedElement(ElementCase{ Domain::Wedge, { 2, 2, 3 } }, collapse, false));
  return elements;
}

double valueAt(const ScaledPolynomial& polynomial, const ReferencePoint& u)
{
  Degrees degrees = polynomial.degrees;
  for (int& degree : degrees)
  {
    degree = std::max(degree, 1);
  }
  std::vector<Coefficient> coefficients;
  for (const double number : unscaled(elevated(polynomial, degrees)))
  {
    coefficients.emplace_back(0.0, 0.0, 0.0, number);
  }
  return evaluateGradient({ polynomial.domain, degrees, coefficients.data(), nullptr }, u).value.w;
}

/// U' X'^-1; a column a component.
glm::dmat3 gradientAt(const SourceElement& source, const ReferencePoint& u)
{
  const auto derivatives = homogeneousDerivatives(source);
  glm::dmat3 map;
  glm::dmat3 field;
  for (int k = 0; k < 3; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      map[k][c] = valueAt(derivatives[k][c], u);
      field[k][c] = valueAt(derivatives[k][3 + c], u);
    }
  }
  return glm::transpose(field * glm::inverse(map));
}

double difference(const glm::dmat3& a, const glm::dmat3& b)
{
  return glm::length(a[0] - b[0]) + glm::length(a[1] - b[1]) + glm::length(a[2] - b[2]);
}

class CollapsedFaces : public ::testing::TestWithParam<Collapse>
{
};

INSTANTIATE_TEST_SUITE_P(CollapsedFaces, CollapsedFaces,
  ::testing::Values(toPoint, toEdge, ofEdge, none),
  [](const auto& one)
  {
    std::string name = one.param.name;
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    return name;
  });

TEST_P(CollapsedFaces, LoseTheirFactorsAndNothingElse)
{
  for (const VectorElement& some : elementsOf(GetParam()))
  {
    const SourceElement source = some.source();
    // A wedge lacks the corner of the edge without a collapsed face.
    if (source.domain == Domain::Hexahedron)
    {
      EXPECT_EQ(hasCollapsedEdge(source), GetParam().map != none.map) << some.element;
    }
    const auto derivatives = homogeneousDerivatives(source);
    const int whole = source.isRational ? 2 * source.degrees[2] : source.degrees[2];
    for (int k = 0; k < 3; ++k)
    {
      for (const ScaledPolynomial& polynomial : derivatives[k])
      {
        EXPECT_EQ(polynomial.degrees[2], whole - (k == 2 ? 1 : GetParam().powers[k]))
          << some.element << k << source.isRational;
      }
    }
  }
}

TEST_P(CollapsedFaces, LeaveGradientsAsTheyAre)
{
  Random random(51);
  for (const VectorElement& some : elementsOf(GetParam()))
  {
    for (int n = 0; n < 20; ++n)
    {
      const ReferencePoint u = insidePoint(
        some.element.domain, { random.uniform(), random.uniform(), 0.95 * random.uniform() });
      const FieldPoint expected = vectorFieldAt(some.source(), u);
      const glm::dmat3 gradients(
        expected.gradients[0], expected.gradients[1], expected.gradients[2]);
      EXPECT_LT(difference(gradientAt(some.source(), u), gradients), 1e-10) << some.element;
    }
  }
}

/// In the face itself they are what they tend to.
TEST(CollapsedFacesToOne, HaveFiniteGradients)
{
  for (const Collapse& collapse : { toPoint, toEdge })
  {
    for (const VectorElement& some : elementsOf(collapse))
    {
      const ReferencePoint above = insidePoint(some.element.domain, { 0.4, 0.3, 1.0 });
      ReferencePoint below = above;
      below.xyz.z -= 1e-6;
      const FieldPoint near = vectorFieldAt(some.source(), below);
      const glm::dmat3 gradients(near.gradients[0], near.gradients[1], near.gradients[2]);
      EXPECT_LT(difference(gradientAt(some.source(), above), gradients), 1e-4) << some.element;
    }
  }
}

/// Fields of collapsed elements, with their second derivatives, are finite and exact as well.
TEST(CollapsedFacesToOne, HaveExactFields)
{
  constexpr double step = 1e-4;
  const VectorElement some = collapsedElement({ Domain::Hexahedron, { 3, 3, 3 } }, toPoint, false);
  for (const Quantity quantity : { Quantity::QCriterion, Quantity::Lambda2 })
  {
    const ExactSource exact = exactSource(some.source(), quantity);
    const auto jetAt = [&](const glm::dvec3& u)
    { return exactHessian(Domain::Hexahedron, exact.field, exact.coefficients.data(), { u }); };
    for (const double w : { 0.2, 0.9, 1.0 - step })
    {
      const glm::dvec3 u(0.3, 0.6, w);
      const Jet here = jetAt(u);
      for (int a = 0; a < 3; ++a)
      {
        glm::dvec3 along(0.0);
        along[a] = step;
        const Jet after = jetAt(u + along);
        const Jet before = jetAt(u - along);
        const double scale = 1.0 + std::abs(hessianOf(here.second, 3)[a][a]);
        EXPECT_NEAR(here.first[a].w, (after.value.w - before.value.w) / (2.0 * step), 1e-5 * scale);
        for (int b = 0; b < 3; ++b)
        {
          EXPECT_NEAR(hessianOf(here.second, 3)[a][b],
            (after.first[b].w - before.first[b].w) / (2.0 * step), 1e-4 * scale);
        }
      }
    }
  }
}

} // namespace
} // namespace hop::testing
