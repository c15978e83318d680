#include "Edges/BoundaryThinning.h"
#include "Fast/FastDistribution.h"

#include "AnalyticFields.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.1;
constexpr double tolerance = 1e-6 * spacing;
const glm::dvec3 middle(0.1, -0.13, 0.07);
constexpr double radius = 1.3;
/// Of a second sphere, which the field of one half of a mesh belongs to.
constexpr double otherRadius = radius + 2.0 * spacing;

Buffer<Particle> distribute(const ElementMesh& mesh, double wanted = spacing)
{
  DistributionParameters parameters;
  parameters.sizing = { wanted, 0.0 };
  return distributeFast({ &mesh, 0.0, 1e-9 }, parameters, {}, {}).particles;
}

double distanceTo(const Buffer<Particle>& particles, const glm::dvec3& place)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Particle& p : particles)
  {
    least = std::min(least, glm::distance(p.position.xyz, place));
  }
  return least;
}

/// Where a sphere around the middle crosses a line along an axis, within [-1, 1].
std::vector<glm::dvec3> crossings(glm::dvec3 place, int axis, double r)
{
  place[axis] = middle[axis];
  const glm::dvec3 apart = place - middle;
  const double half = std::sqrt(std::max(0.0, r * r - glm::dot(apart, apart)));
  std::vector<glm::dvec3> found;
  for (const double end : { middle[axis] - half, middle[axis] + half })
  {
    if (half > 0.0 && std::abs(end) < 1.0)
    {
      place[axis] = end;
      found.push_back(place);
    }
  }
  return found;
}

/// Where the plane normal . x = offset crosses the edges of the cube from -1 to 1.
std::vector<glm::dvec3> planeCrossings(const glm::dvec3& normal, double offset)
{
  std::vector<glm::dvec3> found;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double a : { -1.0, 1.0 })
    {
      for (const double b : { -1.0, 1.0 })
      {
        glm::dvec3 place(0.0);
        place[(axis + 1) % 3] = a;
        place[(axis + 2) % 3] = b;
        place[axis] = (offset - glm::dot(normal, place)) / normal[axis];
        if (std::abs(place[axis]) < 1.0)
        {
          found.push_back(place);
        }
      }
    }
  }
  return found;
}

/// Whether no other place is near: of particles that are too near to each other one is dropped.
bool isAlone(const glm::dvec3& place, const std::vector<glm::dvec3>& all, double distance)
{
  return std::count_if(all.begin(), all.end(),
           [&](const glm::dvec3& other) { return glm::distance(place, other) < distance; }) == 1;
}

class BoundaryCorners : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(BoundaryCurves, BoundaryCorners, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(BoundaryCorners, HoldParticlesAtTheEdgesOfTheDomain)
{
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.field = sphere(middle, radius).field;
  const Buffer<Particle> particles = distribute(makeMesh(recipe));
  int corners = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double a : { -1.0, 1.0 })
    {
      for (const double b : { -1.0, 1.0 })
      {
        glm::dvec3 place(0.0);
        place[(axis + 1) % 3] = a;
        place[(axis + 2) % 3] = b;
        for (const glm::dvec3& corner : crossings(place, axis, radius))
        {
          ++corners;
          EXPECT_LE(distanceTo(particles, corner), tolerance);
        }
      }
    }
  }
  EXPECT_GE(corners, 6);
}

/// Wherever a boundary curve is first met: right behind a corner, too.
TEST_P(BoundaryCorners, HoldParticlesWhereverTheCurveBegins)
{
  constexpr double coarse = 0.4;
  for (int n = 0; n < 200; ++n)
  {
    // No curve comes to an edge of the cube in nearly the direction in which it goes on: that is no corner.
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1.5 + 0.5 * std::sin(1.0 * n),
      1.5 + 0.5 * std::sin(2.3 * n), (n % 2 ? 1.0 : -1.0) * (1.5 + 0.5 * std::cos(1.7 * n))));
    const double offset = 0.5 * std::sin(0.37 * n);
    MeshRecipe recipe;
    recipe.domain = this->GetParam();
    recipe.field = plane(normal, offset).field;
    const Buffer<Particle> particles = distribute(makeMesh(recipe), coarse);
    const std::vector<glm::dvec3> corners = planeCrossings(normal, offset);
    for (const glm::dvec3& corner : corners)
    {
      if (isAlone(corner, corners, coarse))
      {
        EXPECT_LE(distanceTo(particles, corner), tolerance) << n;
      }
    }
  }
}

TEST_P(BoundaryCorners, HoldParticlesWhereAJumpMeetsTheBoundary)
{
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  ElementMesh mesh;
  recipe.field = sphere(middle, radius).field;
  appendBox(mesh, recipe, { -1, -1, -1 }, { 0, 1, 1 });
  recipe.field = sphere(middle, otherRadius).field;
  appendBox(mesh, recipe, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  const Buffer<Particle> particles = distribute(mesh);
  int corners = 0;
  for (const double r : { radius, otherRadius })
  {
    for (const int axis : { 1, 2 })
    {
      for (const double side : { -1.0, 1.0 })
      {
        glm::dvec3 place(0.0);
        place[3 - axis] = side;
        for (const glm::dvec3& corner : crossings(place, axis, r))
        {
          ++corners;
          EXPECT_LE(distanceTo(particles, corner), tolerance) << r;
        }
      }
    }
  }
  EXPECT_GE(corners, 8);
}

/// Sides nearer than 0.02 spacings are closed. Where such a slit begins at the end of the domain, the surface still ends there.
TEST(BoundaryThinning, LeavesTheEndOfTheDomainAtCornersOfClosedSlits)
{
  BoundaryCurves curves;
  for (const int element : { 0, 1 })
  {
    BoundaryParticle corner;
    corner.particle.position = { { 0.01 * spacing * element, 0, 0 } };
    corner.particle.normal = { { 0, 0, 1 } };
    corner.particle.jump = 0.5f;
    corner.particle.location.element = element;
    corner.patch.position = corner.particle.position.xyz;
    corner.patch.spacing = spacing;
    corner.side = { 0, { { element == 0 ? 1.0 : -1.0, 0, 0 } }, 0.0 };
    corner.otherSide = { 1, { { 0, 1, 0 } }, 0.0 };
    curves.particles.push_back(corner);
  }
  thinOut(makeMesh({}), {}, {}, ThinnedCurves::OfSplats, curves, {});
  ASSERT_EQ(curves.particles.size(), 1u);
  EXPECT_EQ(curves.particles[0].side.outward.xyz, glm::dvec3(0, 1, 0));
  EXPECT_FALSE(curves.particles[0].otherSide.exists());
}

/// Curves along the end of the domain, side by side in two elements. Where the surface ends between these, each element has
/// its own.
TEST(BoundaryThinning, KeepsCurvesOnTwoSidesOfAnEnd)
{
  const ElementMesh mesh = makeMesh({ Domain::Hexahedron, { 1, 1, 1 }, 2 });
  const int behind = mesh.neighbor(0, 0).element >= 0 ? 0 : 1; // of two opposite faces
  const int other = mesh.neighbor(0, behind).element;
  for (const bool ends : { true, false })
  {
    BoundaryCurves curves;
    std::vector<float> tolerances(
      MaximumFaces * mesh.elements.size(), std::numeric_limits<float>::infinity());
    tolerances[faceSlot(0, behind)] = ends ? 0.0f : std::numeric_limits<float>::infinity();
    curves.pieces = SurfacePieces(mesh, tolerances);
    for (const int element : { 0, other })
    {
      BoundaryParticle end;
      end.particle.position = { { element == 0 ? 0.0 : 0.2 * spacing, 0, 0 } };
      end.particle.normal = { { 0, 0, 1 } };
      end.particle.location.element = element;
      end.patch.position = end.particle.position.xyz;
      end.patch.spacing = spacing;
      end.side = { 4, { { 0, 1, 0 } }, 0.0 };
      curves.particles.push_back(end);
    }
    thinOut(mesh, {}, {}, ThinnedCurves::OfPieces, curves, {});
    EXPECT_EQ(curves.particles.size(), ends ? 2u : 1u);
  }
}

} // namespace
} // namespace hop::testing
