#include "Topology/ElementCube.h"

#include "ElementCases.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

/// A mesh of one element.
ElementMesh meshOf(const ElementCase& which, const std::vector<Coefficient>& coefficients)
{
  ElementMesh mesh;
  Element element;
  element.domain = which.domain;
  element.degrees = which.degrees;
  for (int c = 0; c < MaximumCorners; ++c)
  {
    element.corners[c] = c;
  }
  mesh.elements.push_back(element);
  mesh.coefficients = coefficients;
  return mesh;
}

TEST(ElementCube, HoldsTheFieldOfItsElement)
{
  Random random(5);
  for (const ElementCase& which : allElementCases())
  {
    SCOPED_TRACE(::testing::Message() << which);
    constexpr double isovalue = 0.3;
    const ElementMesh mesh = meshOf(which, randomCoefficients(which, random));
    const ElementCube cube = elementCube(mesh, 0, isovalue);
    std::vector<Coefficient> values;
    for (const double value : cube.values)
    {
      values.emplace_back(0.0, 0.0, 0.0, value);
    }
    const BernsteinForm form{ Domain::Hexahedron, cube.degrees, values.data(), nullptr };
    for (int n = 0; n < 5; ++n)
    {
      const glm::dvec3 t = 0.5 + 0.5 * randomVector(random);
      const ReferencePoint u = cube.shape.inElement(t);
      EXPECT_GE(insideMargin(which.domain, u), -1e-12);
      EXPECT_NEAR(evaluateGradient(form, { t }).value.w,
        evaluateGradient(mesh.form(0), u).value.w - isovalue, 1e-12);
      EXPECT_LT(glm::distance(cube.shape.inCube(u), t), 1e-7);
    }
  }
}

TEST(ElementCube, KnowsItsCornersAndFaces)
{
  Random random(6);
  for (const Domain domain : { Domain::Hexahedron, Domain::Tetrahedron, Domain::Wedge })
  {
    const ElementCase which{ domain, { 2, 2, 2 } };
    const CubeShape shape =
      elementCube(meshOf(which, randomCoefficients(which, random)), 0, 0.0).shape;
    for (int c = 0; c < 8; ++c)
    {
      const glm::dvec3 t(c & 1, c >> 1 & 1, c >> 2);
      EXPECT_EQ(shape.inElement(t).xyz, facts(domain).corners[shape.corners[c]].xyz);
    }
    int faces = 0;
    for (int f = 0; f < 6; ++f)
    {
      glm::dvec3 t(0.3, 0.4, 0.6);
      t[f / 2] = f % 2;
      if (shape.faces[f] >= 0)
      {
        ++faces;
        EXPECT_NEAR(
          faceMargin(facts(domain).faces[shape.faces[f]], shape.inElement(t)), 0.0, 1e-12);
      }
    }
    EXPECT_EQ(faces, static_cast<int>(facts(domain).faces.size()));
  }
}

} // namespace
} // namespace hop::testing
