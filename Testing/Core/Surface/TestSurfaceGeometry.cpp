#include "Surface/SurfaceGeometry.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "Surface/SurfaceWalker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

constexpr int pointsPerElement = 20;

/// A quadratic bend, so that a quadratic field of x becomes a polynomial of degree four of u.
glm::dvec3 quadraticBend(const glm::dvec3& x)
{
  return { x.x + 0.12 * x.y * x.y - 0.08 * x.x * x.z, x.y - 0.1 * x.z * x.z + 0.07 * x.x * x.y,
    x.z + 0.09 * x.x * x.x + 0.05 * x.y * x.z };
}

glm::dvec3 mirror(const glm::dvec3& x)
{
  return { -x.x, x.y, x.z };
}

/// One bent element that holds a field exactly.
ElementMesh bentElement(Domain domain, int degree, const Field& field, bool leftHanded = false)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.field = field;
  recipe.map = [leftHanded](const glm::dvec3& x)
  { return leftHanded ? mirror(quadraticBend(x)) : quadraticBend(x); };
  ElementMesh mesh;
  std::vector<glm::dvec3> corners;
  std::vector<std::int64_t> numbers;
  for (const ReferencePoint& corner : facts(domain).corners)
  {
    corners.push_back(1.3 * corner.xyz - 0.4);
    numbers.push_back(static_cast<std::int64_t>(numbers.size()));
  }
  appendElement(mesh, recipe, corners, numbers);
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

struct AtPoint
{
  FieldPoint point;
  glm::dmat3 hessian{ 0.0 };
};

AtPoint evaluateAt(const ElementMesh& mesh, const ReferencePoint& u, double isovalue = 0.0)
{
  const Jet jet = evaluateHessian(mesh.form(0), u);
  AtPoint at{ fieldPoint(jet, isovalue) };
  at.hessian = worldHessian(jet, at.point);
  return at;
}

double largestEntry(const glm::dmat3& m)
{
  double largest = 0.0;
  for (int i = 0; i < 9; ++i)
  {
    largest = std::max(largest, std::abs(m[i / 3][i % 3]));
  }
  return largest;
}

void expectCurvature(const Curvature& actual, const Curvature& expected, double tolerance)
{
  EXPECT_NEAR(actual.mean, expected.mean, tolerance);
  EXPECT_NEAR(actual.gauss, expected.gauss, tolerance);
  EXPECT_NEAR(actual.magnitude, expected.magnitude, tolerance);
}

/// Every domain, right- and left-handed.
class UnderABend : public ::testing::TestWithParam<std::tuple<Domain, bool>>
{
protected:
  Domain domain() const { return std::get<0>(this->GetParam()); }
  bool leftHanded() const { return std::get<1>(this->GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(SurfaceGeometry, UnderABend,
  ::testing::Combine(::testing::ValuesIn(allDomains), ::testing::Bool()),
  [](const auto& which)
  {
    return ::testing::PrintToString(std::get<0>(which.param)) +
      (std::get<1>(which.param) ? "LeftHanded" : "RightHanded");
  });

TEST_P(UnderABend, GradientAndHessianOfAQuadraticAreExact)
{
  // f = g.x + x.A.x / 2 + 3
  const glm::dvec3 g(0.7, -1.1, 0.4);
  const glm::dmat3 a{ 1.2, 0.3, -0.5, 0.3, -0.8, 0.6, -0.5, 0.6, 2.1 };
  const ElementMesh mesh = bentElement(
    this->domain(), 4,
    [&](const glm::dvec3& x) { return glm::dot(g, x) + 0.5 * glm::dot(x, a * x) + 3.0; },
    this->leftHanded());
  Random random(1);
  for (int n = 0; n < pointsPerElement; ++n)
  {
    const AtPoint at = evaluateAt(mesh, randomPoint(this->domain(), random), 2.0);
    const glm::dvec3 x = at.point.map.position.xyz;
    EXPECT_NEAR(at.point.value, glm::dot(g, x) + 0.5 * glm::dot(x, a * x) + 1.0, 1e-12);
    EXPECT_LE(glm::distance(at.point.gradient.xyz, g + a * x), 1e-10);
    EXPECT_LE(largestEntry(at.hessian - a), 1e-9);
    EXPECT_EQ(glm::determinant(at.point.map.jacobian) < 0.0, this->leftHanded());
  }
}

/// Against differences of the gradient over a small step either way.
TEST_P(UnderABend, TheHessianOfAFaceIsTheDerivativeOfItsGradient)
{
  constexpr double step = 1e-4;
  const ElementMesh mesh = bentElement(
    this->domain(), 4, [](const glm::dvec3& x) { return x.x; }, this->leftHanded());
  Random random(2);
  for (const Face& face : facts(this->domain()).faces)
  {
    const auto gradientAt = [&](const ReferencePoint& u)
    { return glm::transpose(evaluateAt(mesh, u).point.map.inverse) * face.inward.xyz; };
    const ReferencePoint u = randomPoint(this->domain(), random);
    const Jet jet = evaluateHessian(mesh.form(0), u);
    const LocalMap map = fieldPoint(jet, 0.0).map;
    const glm::dmat3 hessian = faceLevels(jet, map, face).hessian;
    for (int axis = 0; axis < 3; ++axis)
    {
      const ReferenceVector du = step * ReferenceVector{ map.inverse[axis] };
      const glm::dvec3 difference = gradientAt(u + du) - gradientAt(u + (-1.0) * du);
      EXPECT_LE(glm::distance(hessian[axis], difference / (2.0 * step)), 1e-6);
    }
  }
}

TEST(SurfaceGeometry, CrossingsOfSpheresAndPlanesBendAsCirclesDo)
{
  // Of radius 2 around the origin, cut by planes through (1, 0.5, z) whatever their slopes and lengths.
  const glm::dvec3 x(1.0, 0.5, std::sqrt(4.0 - 1.25));
  const LevelSet sphere{ { 2.0 * x }, glm::dmat3(2.0) };
  for (const glm::dvec3& normal :
    { glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -3), glm::dvec3(1, 2, 0.5) })
  {
    const glm::dvec3 middle = glm::dot(x, normal) / glm::dot(normal, normal) * normal;
    const glm::dvec3 inward = middle - x;
    const glm::dvec3 expected = inward / glm::dot(inward, inward);
    const WorldVector bend = curvatureOfCrossing(sphere, { { normal }, glm::dmat3(0.0) });
    EXPECT_LE(glm::distance(bend.xyz, expected), 1e-12);
  }
  EXPECT_EQ(length(curvatureOfCrossing(sphere, sphere)), 0.0);
}

TEST_P(UnderABend, SpheresHaveTheirCurvature)
{
  const glm::dvec3 center(0.2, -0.1, 0.3);
  const ElementMesh mesh =
    bentElement(this->domain(), 4, sphere(center, 1.0).field, this->leftHanded());
  Random random(2);
  for (int n = 0; n < pointsPerElement; ++n)
  {
    // Each level set is a sphere: through the point at distance r its curvature is 1/r.
    const AtPoint at = evaluateAt(mesh, randomPoint(this->domain(), random));
    const double r = glm::distance(at.point.map.position.xyz, center);
    if (r > 0.1)
    {
      expectCurvature(curvature(at.point.gradient, at.hessian),
        { 1.0 / r, 1.0 / (r * r), std::sqrt(2.0) / r }, 1e-8 / (r * r));
      const glm::dvec3 outward = (at.point.map.position.xyz - center) / r;
      EXPECT_LE(glm::distance(surfaceNormal(at.point.gradient).xyz, outward), 1e-10);
      // dn/dx of n = x/r: tangents turn by 1/r of their length, the normal's own direction by nothing.
      const glm::dmat3 turn = (glm::dmat3(1.0) - glm::outerProduct(outward, outward)) / r;
      EXPECT_LE(
        largestEntry(curvature(at.point.gradient, at.hessian).shape - turn), 1e-8 / (r * r));
    }
  }
}

TEST_P(UnderABend, CylindersHaveTheirCurvature)
{
  const ElementMesh mesh = bentElement(this->domain(), 4, cylinder(0.5).field, this->leftHanded());
  Random random(3);
  for (int n = 0; n < pointsPerElement; ++n)
  {
    const AtPoint at = evaluateAt(mesh, randomPoint(this->domain(), random));
    const double r = std::hypot(at.point.map.position.xyz.x, at.point.map.position.xyz.y);
    if (r > 0.1)
    {
      expectCurvature(
        curvature(at.point.gradient, at.hessian), { 0.5 / r, 0.0, 1.0 / r }, 1e-8 / (r * r));
      const glm::dvec3 x = at.point.map.position.xyz;
      const glm::dvec3 around(-x.y / r, x.x / r, 0.0);
      const glm::dmat3 turn = glm::outerProduct(around, around) / r;
      EXPECT_LE(
        largestEntry(curvature(at.point.gradient, at.hessian).shape - turn), 1e-8 / (r * r));
    }
  }
}

TEST_P(UnderABend, TheTorusHasItsCurvatureAllAround)
{
  const KnownSurface known = torus(0.5, 0.2);
  // Degree 4 in x, 2 x 4 in u.
  const ElementMesh mesh = bentElement(this->domain(), 8, known.field, this->leftHanded());
  SurfaceWalker walker({ &mesh, 0.0, 1e-12 });
  Random random(4);
  double lowest = 0.0, highest = 0.0;
  for (int n = 0; n < 20 * pointsPerElement; ++n)
  {
    Evaluated on;
    if (walker.project({ 0, randomPoint(this->domain(), random) }, 0.3, on))
    {
      const AtPoint at = evaluateAt(mesh, on.location.u);
      const glm::dvec3 x = at.point.map.position.xyz;
      const Curvature expected = known.curvature(x);
      expectCurvature(curvature(at.point.gradient, at.hessian), expected, 1e-4);
      EXPECT_LE(glm::distance(surfaceNormal(at.point.gradient).xyz, known.normal(x)), 1e-6);
      lowest = std::min(lowest, expected.gauss);
      highest = std::max(highest, expected.gauss);
    }
  }
  // The saddle-shaped inside and the outside were both met.
  EXPECT_LT(lowest, -2.0);
  EXPECT_GT(highest, 2.0);
}

TEST(SurfaceGeometry, TheEllipsoidHasItsCurvature)
{
  const KnownSurface known = prolateEllipsoid(0.8, 0.3);
  const ElementMesh mesh = bentElement(Domain::Hexahedron, 4, known.field);
  SurfaceWalker walker({ &mesh, 0.0, 1e-12 });
  Random random(5);
  int met = 0;
  for (int n = 0; n < 100; ++n)
  {
    Evaluated on;
    if (walker.project({ 0, randomPoint(Domain::Hexahedron, random) }, 0.5, on))
    {
      const AtPoint at = evaluateAt(mesh, on.location.u);
      expectCurvature(
        curvature(at.point.gradient, at.hessian), known.curvature(at.point.map.position.xyz), 1e-8);
      ++met;
    }
  }
  EXPECT_GT(met, 20);
}

TEST(SurfaceGeometry, WorldHessianAgreesWithFiniteDifferencesInWorldSpace)
{
  Random random(6);
  for (const Domain domain : allDomains)
  {
    SCOPED_TRACE(::testing::PrintToString(domain));
    // No polynomial of x: what counts is the element's own field, whatever it approximates.
    const ElementMesh mesh = bentElement(domain, 5, gyroid(0.4));
    /// The world gradient a small world vector away from u, by inverting the map.
    const auto gradientNear = [&](const ReferencePoint& u, const WorldPoint& x)
    {
      ReferencePoint v = u;
      for (int step = 0; step < 8; ++step)
      {
        const LocalMap map = evaluateAt(mesh, v).point.map;
        v = v + map.pull(x - map.position);
      }
      return evaluateAt(mesh, v).point.gradient;
    };
    for (int n = 0; n < pointsPerElement; ++n)
    {
      const ReferencePoint u = randomPoint(domain, random);
      const AtPoint at = evaluateAt(mesh, u);
      glm::dmat3 expected(0.0);
      for (int axis = 0; axis < 3; ++axis)
      {
        constexpr double h = 1e-4;
        WorldVector step;
        step.xyz[axis] = h;
        expected[axis] = (gradientNear(u, at.point.map.position + step).xyz -
                           gradientNear(u, at.point.map.position + -step).xyz) /
          (2.0 * h);
      }
      EXPECT_LE(largestEntry(at.hessian - expected), 1e-5);
      EXPECT_LE(largestEntry(at.hessian - glm::transpose(at.hessian)), 1e-10);
    }
  }
}

TEST(SurfaceGeometry, InterpolatedCurvatureConvergesWithTheDegree)
{
  const glm::dvec3 center(0.1, 0.2, -0.1);
  double before = 1.0;
  for (const int degree : { 2, 4, 6, 8 })
  {
    MeshRecipe recipe;
    recipe.degrees = { degree, degree, degree };
    recipe.cells = 1;
    recipe.map = wavyMap(0.15);
    recipe.field = sphere(center, 0.6).field;
    const ElementMesh mesh = makeMesh(recipe);
    SurfaceWalker walker({ &mesh, 0.0, 1e-12 });
    Random random(7);
    double error = 0.0;
    for (int n = 0; n < 50; ++n)
    {
      Evaluated on;
      if (walker.project({ 0, randomPoint(Domain::Hexahedron, random) }, 1.0, on))
      {
        const Evaluated curved = walker.evaluateCurved(on.location);
        const double mean = curvature(curved.point.gradient, curved.hessian).mean;
        error = std::max(error, std::abs(mean * 0.6 - 1.0));
      }
    }
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 0.5 * before) << "degree " << degree;
    before = error;
  }
  EXPECT_LT(before, 1e-3);
}

TEST(SurfaceGeometry, MeanCurvatureChangesItsSignWithTheField)
{
  // Low values inside: the normal -grad F points inwards, the surface bends towards it.
  const KnownSurface known = sphere({ 0, 0, 0 }, 0.5);
  const ElementMesh mesh =
    bentElement(Domain::Hexahedron, 4, [&](const glm::dvec3& x) { return -known.field(x); });
  const AtPoint at = evaluateAt(mesh, { { 0.8, 0.7, 0.6 } });
  const double r = glm::length(at.point.map.position.xyz);
  expectCurvature(curvature(at.point.gradient, at.hessian),
    { -1.0 / r, 1.0 / (r * r), std::sqrt(2.0) / r }, 1e-9);
}

TEST(SurfaceGeometry, PlanesAreFlat)
{
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 2, -1));
  const ElementMesh mesh = bentElement(Domain::Wedge, 3, plane(normal, 0.1).field);
  const AtPoint at = evaluateAt(mesh, { { 0.2, 0.3, 0.4 } });
  expectCurvature(curvature(at.point.gradient, at.hessian), {}, 1e-11);
  EXPECT_LE(glm::distance(surfaceNormal(at.point.gradient).xyz, normal), 1e-13);
}

TEST(SurfaceGeometry, AVanishingGradientHasNoNormalAndNoCurvature)
{
  const Curvature none = curvature({}, glm::dmat3(1.0));
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_EQ(none.gauss, 0.0);
  EXPECT_EQ(none.magnitude, 0.0);
  EXPECT_EQ(length(surfaceNormal({})), 0.0);
}

TEST(SurfaceGeometry, PushAndPullAreInverse)
{
  const ElementMesh mesh = bentElement(Domain::Tetrahedron, 3, plane({ 1, 0, 0 }, 0.0).field);
  const LocalMap map = evaluateAt(mesh, { { 0.2, 0.3, 0.1 } }).point.map;
  const WorldVector v{ { 0.3, -0.2, 0.9 } };
  EXPECT_LE(length(map.push(map.pull(v)) - v), 1e-14);
}

TEST(SurfaceGeometry, FlatElementsAreSingularWhateverTheirSize)
{
  for (const double size : { 1e-9, 1.0, 1e9 })
  {
    for (const bool flat : { false, true })
    {
      MeshRecipe recipe;
      recipe.cells = 1;
      recipe.map = [=](const glm::dvec3& x)
      { return size * (flat ? glm::dvec3(x.x, x.y, x.x + x.y) : quadraticBend(x)); };
      const ElementMesh mesh = makeMesh(recipe);
      const AtPoint at = evaluateAt(mesh, { { 0.4, 0.3, 0.7 } });
      EXPECT_EQ(at.point.map.singular, flat) << size;
      EXPECT_TRUE(std::isfinite(length(at.point.gradient)));
    }
  }
}

TEST(SurfaceGeometry, NaNCoordinatesAreSingular)
{
  Jet jet;
  jet.first = { Coefficient(1, 0, 0, 1), Coefficient(0, std::nan(""), 0, 1),
    Coefficient(0, 0, 1, 1) };
  EXPECT_TRUE(fieldPoint(jet, 0.0).map.singular);
}

} // namespace
} // namespace hop::testing
