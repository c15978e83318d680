// Particles where the mesh does not join elements that meet: beside refined elements, between cells of
// different shape, and where the field jumps on part of a face.

#include "Classic/ClassicDistribution.h"
#include "Fast/FastDistribution.h"

#include "AnalyticFields.h"
#include "DistributionMeasures.h"
#include "ElementCases.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

constexpr double tolerance = 1e-9;

DistributionParameters withSpacing(double spacing, double angularDensity = 0.0)
{
  DistributionParameters parameters;
  parameters.sizing = { spacing, angularDensity };
  return parameters;
}

Distribution distribute(
  const ElementMesh& mesh, double spacing, const ParallelFor& parallelFor = {})
{
  return distributeFast({ &mesh, 0.0, tolerance }, withSpacing(spacing), {}, parallelFor);
}

MeshRecipe recipeOf(Domain domain, const Field& field, int degree = 2)
{
  MeshRecipe recipe;
  recipe.domain = domain;
  recipe.degrees = { degree, degree, degree };
  recipe.field = field;
  return recipe;
}

double leastSpacing(const Buffer<Particle>& particles)
{
  const std::vector<double> nearest = nearestSpacings(particles);
  return *std::min_element(nearest.begin(), nearest.end());
}

bool onCube(const glm::dvec3& x)
{
  return std::max({ std::abs(x.x), std::abs(x.y), std::abs(x.z) }) > 1.0 - 1e-11;
}

std::ptrdiff_t countAtInterface(const Buffer<Particle>& particles)
{
  return std::count_if(particles.begin(), particles.end(),
    [](const Particle& p)
    { return std::abs(p.position.xyz.x) < 1e-11 && !onCube(p.position.xyz); });
}

/// What meets at x = 0: one box of the first kind, and 2 x 2 of the second.
struct Meeting
{
  Domain left = Domain::Hexahedron;
  Domain right = Domain::Hexahedron;
  int leftDegree = 2;
  int rightDegree = 2;
};

std::ostream& operator<<(std::ostream& out, const Meeting& meeting)
{
  return out << meeting.left << meeting.leftDegree << "And" << meeting.right << meeting.rightDegree;
}

class SurfaceThroughHangingNodes : public ::testing::TestWithParam<Meeting>
{
protected:
  ElementMesh mesh(const Field& left, const Field& right) const
  {
    const Meeting& which = this->GetParam();
    return hangingMesh(recipeOf(which.left, left, which.leftDegree),
      recipeOf(which.right, right, which.rightDegree));
  }
  ElementMesh mesh(const Field& field) const { return this->mesh(field, field); }
};

INSTANTIATE_TEST_SUITE_P(UnmatchedFaces, SurfaceThroughHangingNodes,
  ::testing::Values(Meeting{}, Meeting{ Domain::Hexahedron, Domain::Tetrahedron },
    Meeting{ Domain::Tetrahedron, Domain::Wedge },
    Meeting{ Domain::Wedge, Domain::Hexahedron, 3, 2 },
    Meeting{ Domain::Tetrahedron, Domain::Tetrahedron, 2, 4 }),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

TEST_P(SurfaceThroughHangingNodes, IsAsEvenAsAnyClosedOne)
{
  const ElementMesh mesh = this->mesh(sphere({ 0.1, 0, 0 }, 0.6).field);
  const Distribution result = distribute(mesh, 0.04);
  const auto count = static_cast<double>(result.particles.size());
  EXPECT_NEAR(count, hexagonalCount(4.0 * Pi * 0.36, 0.04), 0.03 * count);
  EXPECT_LE(static_cast<double>(result.report.evaluations) / count, 8.0);
  const Evenness evenness = measureEvenness(result.particles);
  EXPECT_GE(evenness.minSpacing, 0.80);
  EXPECT_LE(evenness.variation, 0.035);
  EXPECT_GE(evenness.sixValentShare, 0.72);
  EXPECT_GE(evenness.worstMinAngle, 30.0);
  EXPECT_EQ(evenness.openStars, 0u);
  EXPECT_EQ(countAtInterface(result.particles), 0);
  for (const Particle& p : result.particles)
  {
    EXPECT_FALSE(p.clips[0].exists());
    EXPECT_EQ(p.jump, 0.0);
  }
}

TEST_P(SurfaceThroughHangingNodes, IsClosedForTheClassicMethodToo)
{
  const ElementMesh mesh = this->mesh(sphere({ 0.1, 0, 0 }, 0.6).field);
  const Distribution result =
    distributeClassic({ &mesh, 0.0, tolerance }, withSpacing(0.1), {}, {});
  const auto count = static_cast<double>(result.particles.size());
  EXPECT_NEAR(count, hexagonalCount(4.0 * Pi * 0.36, 0.1), 0.05 * count);
  const Evenness evenness = measureEvenness(result.particles);
  EXPECT_GE(evenness.minSpacing, 0.70);
  EXPECT_EQ(evenness.openStars, 0u);
}

TEST_P(SurfaceThroughHangingNodes, HasABoundaryCurveAtTheOuterBoundaryOnly)
{
  constexpr double spacing = 0.05;
  const ElementMesh mesh = this->mesh(plane(glm::normalize(glm::dvec3(0.2, 0.3, 1.0)), 0.1).field);
  const Distribution result = distribute(mesh, spacing);
  EXPECT_EQ(countAtInterface(result.particles), 0);
  EXPECT_GE(leastSpacing(result.particles), 0.75);
  for (const Particle& p : result.particles)
  {
    EXPECT_EQ(p.clips[0].exists() && p.clips[0].distance == 0.0, onCube(p.position.xyz));
  }
  // The boundary curve has no gap, not even at x = 0, where it passes from element to element.
  Buffer<Particle> onCurve;
  std::copy_if(result.particles.begin(), result.particles.end(), std::back_inserter(onCurve),
    [](const Particle& p) { return onCube(p.position.xyz); });
  for (const double distance : nearestSpacings(onCurve))
  {
    EXPECT_GE(distance, 0.85);
    EXPECT_LE(distance, 1.1);
  }
  const double length = 4.0 * (std::hypot(1.0, 0.2) + std::hypot(1.0, 0.3));
  EXPECT_NEAR(static_cast<double>(onCurve.size()) * spacing, length, 0.02 * length);
}

TEST_P(SurfaceThroughHangingNodes, DoesNotDependOnThreads)
{
  const ElementMesh mesh = this->mesh(sphere({ 0.1, 0, 0 }, 1.1).field);
  const Distribution serial = distribute(mesh, 0.06);
  for (const int threads : { 1, 2, 3, 8 })
  {
    const Distribution other = distribute(mesh, 0.06, threadedFor(threads));
    EXPECT_EQ(other.report.evaluations, serial.report.evaluations);
    ASSERT_EQ(other.particles.size(), serial.particles.size());
    for (std::size_t i = 0; i < serial.particles.size(); ++i)
    {
      ASSERT_EQ(other.particles[i].location.element, serial.particles[i].location.element);
      ASSERT_EQ(other.particles[i].position.xyz, serial.particles[i].position.xyz);
      ASSERT_EQ(other.particles[i].clips[0].normal.xyz, serial.particles[i].clips[0].normal.xyz);
    }
  }
}

TEST_P(SurfaceThroughHangingNodes, EndsOnBothSidesWhereTheFieldJumps)
{
  constexpr double spacing = 0.05;
  const ElementMesh mesh = this->mesh(plane({ 0, 0, 1 }, 0.1).field, plane({ 0, 0, 1 }, 0.3).field);
  const Distribution result = distribute(mesh, spacing);
  int onCurves[2] = {}; // of the right and of the left half
  for (const Particle& p : result.particles)
  {
    const glm::dvec3& x = p.position.xyz;
    if (std::abs(x.x) < 1e-11)
    {
      const bool left = std::abs(x.z - 0.1) < 1e-6;
      ++onCurves[left];
      // At the curve's ends a particle may belong to an element that has no face at x = 0.
      EXPECT_TRUE(onCube(x) || std::abs(p.jump - (left ? 0.2 : -0.2)) < 1e-6);
      EXPECT_TRUE(onCube(x) || std::abs(p.clips[0].normal.xyz.x) > 1.0 - 1e-6);
    }
  }
  EXPECT_NEAR(onCurves[0], 2.0 / spacing, 3);
  EXPECT_NEAR(onCurves[1], 2.0 / spacing, 3);
  EXPECT_GE(leastSpacing(result.particles), 0.75);
}

TEST(UnmatchedFaces, HaveABoundaryOnlyWhereNothingIsBehind)
{
  // On the right only y > 0 is there: the surface z = 0.1 ends at x = 0 where y < 0.
  constexpr double spacing = 0.05;
  const MeshRecipe recipe = recipeOf(Domain::Hexahedron, plane({ 0, 0, 1 }, 0.1).field);
  ElementMesh mesh;
  appendBox(mesh, recipe, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, recipe, { 0, 0, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  const Distribution result = distribute(mesh, spacing);
  int onBoundary = 0;
  for (const Particle& p : result.particles)
  {
    const glm::dvec3& x = p.position.xyz;
    EXPECT_FALSE(std::abs(x.x) < 1e-11 && x.y > 0.3 * spacing && x.y < 1.0 - 1e-11) << x.y;
    onBoundary += std::abs(x.x) < 1e-11 && x.y < 0.0;
  }
  EXPECT_NEAR(onBoundary, 1.0 / spacing, 2);
  EXPECT_GE(leastSpacing(result.particles), 0.70);
  const double wanted = hexagonalCount(3.0, spacing) + 0.5 * 8.0 / spacing;
  EXPECT_NEAR(static_cast<double>(result.particles.size()), wanted, 0.03 * wanted);
}

TEST(UnmatchedFaces, AcrossASlitTheSurfaceEndsOnBothSidesIfItIsWide)
{
  constexpr double spacing = 0.05;
  const MeshRecipe recipe = recipeOf(Domain::Hexahedron, plane({ 0, 0, 1 }, 0.1).field);
  for (const double slit : { 0.8 * spacing, 0.1 * spacing })
  {
    ElementMesh mesh;
    appendBox(mesh, recipe, { -1, -1, -1 }, { -slit, 1, 1 });
    appendBox(mesh, recipe, { 0, -1, -1 }, { 1, 1, 1 });
    findFaceNeighbors(mesh, 1e-9);
    const Distribution result = distribute(mesh, spacing);
    const auto onBoundary = std::count_if(result.particles.begin(), result.particles.end(),
      [&](const Particle& p)
      {
        const double x = p.position.xyz.x;
        return !onCube(p.position.xyz) && std::min(std::abs(x), std::abs(x + slit)) < 1e-9 &&
          p.clips[0].exists();
      });
    EXPECT_NEAR(
      static_cast<double>(onBoundary), slit > 0.4 * spacing ? 2.0 * 2.0 / spacing : 0.0, 4.0);
    // Boundary curves may be nearer to each other than particles are: this is what Fast promises in any case.
    EXPECT_GE(leastSpacing(result.particles), 0.59);
  }
}

/// The cube [-1,1]^3, with a field for x < 0 and one for x > 0.
ElementMesh twoFields(const Field& left, const Field& right)
{
  ElementMesh mesh;
  for (const double y : { -1.0, 0.0 })
  {
    appendBox(mesh, recipeOf(Domain::Hexahedron, left), { -1, y, -1 }, { 0, y + 1, 1 });
    appendBox(mesh, recipeOf(Domain::Hexahedron, right), { 0, y, -1 }, { 1, y + 1, 1 });
  }
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

TEST(FadingJump, HasBoundaryCurvesOnlyWhereItIsLarge)
{
  // z = 0 on the left and z = (y - 0.2)^2/8 on the right: 0.2 spacings apart at a distance of 0.28 from y = 0.2 to
  // either side, so that one face holds all of the place where both agree, and another face a part.
  constexpr double spacing = 0.05;
  const ElementMesh mesh = twoFields([](const glm::dvec3& x) { return x.z; },
    [](const glm::dvec3& x) { return x.z - 0.125 * (x.y - 0.2) * (x.y - 0.2); });
  const double agree = std::sqrt(8.0 * 0.2 * spacing);
  const Distribution result = distribute(mesh, spacing);
  int onCurves[2] = {};
  for (const Particle& p : result.particles)
  {
    const glm::dvec3& x = p.position.xyz;
    if (std::abs(x.x) < 1e-11 && !onCube(x))
    {
      EXPECT_GT(std::abs(x.y - 0.2), agree - 0.5 * spacing);
      // The particle may be off by the tolerance, 1e-9, itself.
      EXPECT_NEAR(std::abs(p.jump), 0.125 * (x.y - 0.2) * (x.y - 0.2), 2e-9);
      ++onCurves[std::abs(x.z) < 1e-9];
    }
  }
  const double length = 2.0 - 2.0 * agree;
  EXPECT_NEAR(onCurves[0], length / spacing, 3);
  EXPECT_NEAR(onCurves[1], length / spacing, 3);
  EXPECT_GE(leastSpacing(result.particles), 0.19); // of the two sides of the jump
  // Where both sides agree, particles stand as on a continuous surface.
  Buffer<Particle> seam;
  std::copy_if(result.particles.begin(), result.particles.end(), std::back_inserter(seam),
    [&](const Particle& p)
    { return std::abs(p.position.xyz.x) < 0.2 && std::abs(p.position.xyz.y - 0.2) < 0.6 * agree; });
  EXPECT_GE(leastSpacing(seam), 0.75);
  EXPECT_NEAR(static_cast<double>(seam.size()), hexagonalCount(0.4 * 1.2 * agree, spacing), 12.0);
}

} // namespace
} // namespace hop::testing
