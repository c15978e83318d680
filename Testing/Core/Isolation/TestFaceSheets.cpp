#include "Isolation/FaceSheets.h"

#include "ElementCases.h"
#include "Fast/FastDistribution.h"
#include "Isolation/SurfaceProxy.h"
#include "Surface/FaceLocator.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.1;
/// Particles of the square [-1,1]^2.
const double packed = 4.0 * 2.0 / (std::sqrt(3.0) * spacing * spacing);

MeshRecipe recipeOf(Domain domain, const Field& field)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.field = field;
  return recipe;
}

/// Number of particles that the triangles want.
double wanted(const ElementMesh& mesh, double isovalue)
{
  const FaceLocator locator(mesh, isovalue, {});
  const Isosurface surface{ &mesh, isovalue, 1e-9, &locator };
  const SurfaceProxy proxy(
    surface, { spacing, 0.0 }, findSurfaceBoxes(mesh, isovalue, 3.0 * spacing, {}), {});
  return proxy.particleCount();
}

Buffer<Particle> particlesOf(const ElementMesh& mesh, double isovalue)
{
  DistributionParameters parameters;
  parameters.sizing = { spacing, 0.0 };
  return distributeFast({ &mesh, isovalue, 1e-9 }, parameters, {}, {}).particles;
}

/// Whether splats near the end of the square [-1,1]^2 at the place `end` (1 or -1) of an axis are cut off there.
::testing::AssertionResult areCutOff(const Buffer<Particle>& particles, int axis, double end)
{
  int nearCount = 0;
  for (const Particle& particle : particles)
  {
    const double depth = 1.0 - end * particle.position.xyz[axis];
    const auto isEnd = [&](const ClipPlane& plane) {
      return end * plane.normal.xyz[axis] > 0.99 &&
        std::abs(plane.distance - depth) < 0.1 * spacing;
    };
    nearCount += depth < 0.9 * spacing;
    if (depth < 0.9 * spacing && std::none_of(particle.clips.begin(), particle.clips.end(), isEnd))
    {
      return ::testing::AssertionFailure() << depth << " from " << end << " on axis " << axis;
    }
  }
  return nearCount > 0 ? ::testing::AssertionSuccess() : ::testing::AssertionFailure();
}

/// Rounding errors are shares of the field, in whatever unit it comes.
TEST(FaceSheets, DoNotDependOnTheUnitOfTheField)
{
  for (const double unit : { 1e-20, 1.0, 1e13 })
  {
    for (const double place : { -1.0, 0.0, 1.0 })
    {
      for (const double sign : { -1.0, 1.0 })
      {
        const double factor = sign * unit;
        MeshRecipe recipe = recipeOf(Domain::Hexahedron,
          [=](const glm::dvec3& x)
          { return factor * (0.7 + (x.z - place) * (1.1 + 0.3 * x.x + 0.2 * x.y * x.y)); });
        recipe.degrees = { 3, 3, 3 };
        EXPECT_NEAR(wanted(makeMesh(recipe), factor * 0.7), packed, 1e-3 * packed)
          << "unit " << factor << ", at " << place;
      }
    }
  }
}

class Sheets : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(FaceSheets, Sheets, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(Sheets, AreThereOnceForFAndMinusFInsideAndOnTheBoundary)
{
  for (const int axis : { 0, 1, 2 })
  {
    for (const double place : { -1.0, 0.0, 1.0 })
    {
      // In a face at the end of the domain, with no value above it in any tetrahedron, curves have no hints.
      const bool mayLackCurves = this->GetParam() == Domain::Tetrahedron && place == -1.0;
      std::array<std::size_t, 2> counts{};
      for (const int minus : { 0, 1 })
      {
        const double sign = minus ? -1.0 : 1.0;
        const ElementMesh mesh = makeMesh(
          recipeOf(this->GetParam(), [=](const glm::dvec3& x) { return sign * (x[axis] + 0.3); }));
        const double isovalue = sign * (place + 0.3);
        EXPECT_NEAR(wanted(mesh, isovalue), packed, 1e-3 * packed)
          << "axis " << axis << " at " << place << ", sign " << sign;
        const Buffer<Particle> particles = particlesOf(mesh, isovalue);
        counts[minus] = particles.size();
        for (const int other : { (axis + 1) % 3, (axis + 2) % 3 })
        {
          EXPECT_TRUE((mayLackCurves && minus) ||
            (areCutOff(particles, other, 1.0) && areCutOff(particles, other, -1.0)))
            << "axis " << axis << " at " << place << ", sign " << sign;
        }
      }
      EXPECT_NEAR(counts[0], counts[1], (mayLackCurves ? 0.1 : 0.03) * packed)
        << "axis " << axis << " at " << place;
    }
  }
}

TEST_P(Sheets, AreThereOnceInValleysAndOnRidges)
{
  for (const double sign : { 1.0, -1.0 })
  {
    const ElementMesh mesh = makeMesh(
      recipeOf(this->GetParam(), [=](const glm::dvec3& x) { return sign * std::abs(x.z); }));
    EXPECT_NEAR(wanted(mesh, 0.0), packed, 1e-3 * packed) << sign;
  }
}

TEST(FaceSheets, AreThereOnceBetweenFacesThatDoNotMatch)
{
  for (const Domain left : allDomains)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const Field field = [=](const glm::dvec3& x) { return sign * x.x; };
      const ElementMesh mesh =
        hangingMesh(recipeOf(left, field), recipeOf(Domain::Hexahedron, field));
      EXPECT_NEAR(wanted(mesh, 0.0), packed, 1e-3 * packed) << left << ' ' << sign;
    }
  }
}

TEST(FaceSheets, RoundedValuesMakeNoHoles)
{
  for (const double sign : { 1.0, -1.0 })
  {
    ElementMesh mesh = makeMesh(
      recipeOf(Domain::Hexahedron, [=](const glm::dvec3& x) { return sign * (x.z - 1.0); }));
    int n = 0;
    for (Coefficient& c : mesh.coefficients)
    {
      c.w += (++n % 3 - 1) * 1e-16;
    }
    EXPECT_NEAR(wanted(mesh, 0.0), packed, 1e-3 * packed) << sign;
  }
}

/// Some elements have the surface in the face, others a rounding error off it, on either side.
TEST_P(Sheets, AreThereOnceWhereElementsDisagreeByRounding)
{
  for (const double sign : { 1.0, -1.0 })
  {
    for (const double off : { 1e-16, 1e-15, 3e-15, 1e-14, 3e-14, 1e-12 })
    {
      for (const double tilt : { -1.0, 1.0 })
      {
        ElementMesh mesh = makeMesh(recipeOf(this->GetParam(),
          [=](const glm::dvec3& x) { return sign * x.z * (2.0 + 0.3 * std::sin(x.x)); }));
        for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        {
          const double shift = e % 3 == 0 ? 0.0 : tilt * off;
          const BernsteinForm form = mesh.form(static_cast<int>(e));
          const std::size_t first = form.coefficients - mesh.coefficients.data();
          const int count = coefficientCount(form.domain, form.degrees);
          for (int i = 0; i < count; ++i)
          {
            mesh.coefficients[first + i].w += shift;
          }
        }
        EXPECT_NEAR(wanted(mesh, 0.0), packed, 1e-3 * packed)
          << "sign " << sign << ", off " << tilt * off;
      }
    }
  }
}

TEST(FaceSheets, TipsOfPyramidsAreNone)
{
  ElementMesh mesh;
  std::vector<glm::dvec3> corners;
  for (const ReferencePoint& corner : facts(Domain::Hexahedron).corners)
  {
    corners.push_back(corner.xyz.z == 0.0 ? corner.xyz : glm::dvec3(0.5, 0.5, 1.0));
  }
  appendElement(mesh, recipeOf(Domain::Hexahedron, [](const glm::dvec3& x) { return x.z - 1.0; }),
    corners, { 0, 1, 2, 3, 4, 4, 4, 4 });
  findFaceNeighbors(mesh, 1e-9);
  const std::vector<SurfaceBox> boxes = findSurfaceBoxes(mesh, 0.0, spacing, {});
  ASSERT_FALSE(boxes.empty());
  const std::vector<SurfaceBox> same = assignFaceSheets({ &mesh, 0.0, 1e-9 }, boxes, {});
  ASSERT_EQ(same.size(), boxes.size());
  for (std::size_t b = 0; b < boxes.size(); ++b)
  {
    EXPECT_EQ(same[b].values, boxes[b].values);
  }
}

} // namespace
} // namespace hop::testing
