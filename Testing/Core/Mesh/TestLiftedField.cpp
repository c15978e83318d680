#include "Mesh/LiftedField.h"

#include "Fast/FastDistribution.h"
#include "Mesh/ConstrainedEdges.h"
#include "Mesh/SurfaceMesh.h"
#include "MeshMeasures.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hop::testing
{
namespace
{

constexpr double Height = 1e-3;

/// Eight cells a side of a cube 2 wide, with the distance from its middle at their nodes less what some of them have.
ElementMesh ballThroughNodes()
{
  MeshRecipe recipe;
  recipe.domain = Domain::Tetrahedron;
  recipe.degrees = { 1, 1, 1 };
  recipe.cells = 8;
  recipe.field = [](const glm::dvec3& x) { return 0.5 - glm::length(x); };
  return makeMesh(recipe);
}

TEST(LiftedField, IsThereOnlyWhereCoefficientsAreNearTheIsovalue)
{
  const ElementMesh mesh = ballThroughNodes();
  EXPECT_FALSE(liftedMesh(mesh, 0.01, LiftedValues::Near, Height));
  EXPECT_FALSE(liftedMesh(mesh, 1e-6, LiftedValues::Isovalue, Height));
  EXPECT_TRUE(liftedMesh(mesh, 0.0, LiftedValues::Isovalue, Height));
  for (const double isovalue : { 0.0, 1e-6, -1e-6 })
  {
    const std::optional<ElementMesh> lifted =
      liftedMesh(mesh, isovalue, LiftedValues::Near, Height);
    ASSERT_TRUE(lifted);
    int changed = 0;
    for (std::size_t i = 0; i < mesh.coefficients.size(); ++i)
    {
      const double before = mesh.coefficients[i].w - isovalue;
      const double after = lifted->coefficients[i].w - isovalue;
      EXPECT_EQ(before != after, std::abs(before) < 1e-4);
      EXPECT_GT(std::abs(after), 9e-4);
      EXPECT_EQ(before >= 0.0, after > 0.0) << "the isovalue counts as above";
      changed += before != after ? 1 : 0;
    }
    EXPECT_GT(changed, 0);
  }
}

TEST(LiftedField, IsLiftedByTheWeightOfRationalElements)
{
  ElementMesh mesh = ballThroughNodes();
  mesh.weights.assign(mesh.coefficients.size(), 0.5);
  for (Coefficient& coefficient : mesh.coefficients)
  {
    coefficient *= 0.5;
    coefficient.w += 0.5; // of the field plus 1
  }
  const std::optional<ElementMesh> lifted = liftedMesh(mesh, 1.0, LiftedValues::Near, Height);
  ASSERT_TRUE(lifted);
  for (std::size_t i = 0; i < mesh.coefficients.size(); ++i)
  {
    EXPECT_EQ(lifted->coefficients[i].w > mesh.coefficients[i].w, mesh.coefficients[i].w == 0.5);
  }
}

TEST(LiftedField, ClosesASurfaceThroughNodesAndPutsItBack)
{
  const ElementMesh mesh = ballThroughNodes();
  const std::optional<ElementMesh> lifted = liftedMesh(mesh, 0.0, LiftedValues::Near, Height);
  ASSERT_TRUE(lifted);
  DistributionParameters parameters;
  parameters.sizing = { 0.04, 0.0 };
  parameters.onCreases = true;
  const Isosurface own{ &*lifted, 0.0, 1e-10 };
  Distribution distribution = distributeFast(own, parameters, {}, {});
  const SurfaceMesh triangles =
    meshSurface(own, ConstrainedEdges(distribution), distribution, {}, {});
  EXPECT_EQ(triangles.openLoops, 0);
  EXPECT_EQ(triangles.unusedParticles, 0);

  const Buffer<Particle> before = distribution.particles;
  const Isosurface surface{ &mesh, 0.0, 1e-10 };
  EXPECT_TRUE(putBack(surface, distribution, {}));
  SurfaceWalker walker(surface);
  int moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    const Particle& particle = distribution.particles[i];
    const FieldPoint point = walker.evaluate(particle.location).point;
    EXPECT_LE(std::abs(point.value), 1e-10 * length(point.gradient));
    EXPECT_LE(particle.residual, 1e-10);
    EXPECT_LT(length(point.map.position - particle.position), 0.3 * particle.spacing);
    const double step = length(particle.position - before[i].position);
    EXPECT_LT(step, particle.spacing);
    moved += step > 1e-6 ? 1 : 0;
  }
  EXPECT_GT(moved, 100);
  for (const auto& [a, b] : distribution.edges.coincident)
  {
    EXPECT_EQ(distribution.particles[a].position.xyz, distribution.particles[b].position.xyz);
  }
}

/// The surface of a saddle of revolution x^2 + y^2 - z^2 at a value, which is a cone at 0: in one element a side of 2.
Distribution onHyperboloid(ElementMesh& mesh, double value)
{
  MeshRecipe recipe;
  recipe.domain = Domain::Hexahedron;
  recipe.degrees = { 2, 2, 2 };
  recipe.cells = 1;
  recipe.field = [](const glm::dvec3& x) { return x.x * x.x + x.y * x.y - x.z * x.z; };
  mesh = makeMesh(recipe);
  DistributionParameters parameters;
  parameters.sizing = { 0.04, 1.0 };
  return distributeFast({ &mesh, value, 1e-10 }, parameters, {}, {});
}

TEST(LiftedField, PutsTheTipsOfAHyperboloidBesideTheTipOfTheCone)
{
  ElementMesh mesh;
  Distribution distribution = onHyperboloid(mesh, -1e-4);
  const Isosurface surface{ &mesh, 0.0, 1e-10 };
  ASSERT_TRUE(putBack(surface, distribution, {}));
  int above = 0;
  int below = 0;
  for (const Particle& particle : distribution.particles)
  {
    const glm::dvec3& x = particle.position.xyz;
    EXPECT_NEAR(std::hypot(x.x, x.y), std::abs(x.z), 1e-9);
    EXPECT_GT(std::abs(x.z), 1e-6);
    // Each on the side on which it was: normals point to low values, into the cone.
    EXPECT_GT(particle.normal.xyz.z * x.z, 0.0);
    above += x.z > 0.0 ? 1 : 0;
    below += x.z < 0.0 ? 1 : 0;
  }
  EXPECT_GT(above, 100);
  EXPECT_GT(below, 100);
}

/// The upper face of a hexahedron is drawn together to the apex of a pyramid, at which the map stands still, and the surface
/// is a plane that leads there.
TEST(LiftedField, PutsParticlesThatComeToTheApexOfAPyramidBesideIt)
{
  const glm::dvec3 apex(0.0, 0.0, 1.0);
  MeshRecipe recipe;
  recipe.degrees = { 1, 1, 1 };
  recipe.cells = 1;
  recipe.map = [](const glm::dvec3& x)
  { return glm::dvec3(0.5 * (1.0 - x.z) * x.x, 0.5 * (1.0 - x.z) * x.y, x.z); };
  recipe.field = [&apex](const glm::dvec3& x) { return x.x - x.y + 0.3 * (x.z - apex.z); };
  const ElementMesh mesh = makeMesh(recipe);
  const Isosurface surface{ &mesh, 0.0, 1e-10 };
  SurfaceWalker walker(surface);
  Distribution distribution;
  for (const double below : { 1e-3, 1e-4 })
  {
    // On the edge x = y of the pyramid.
    const Evaluated at = walker.evaluateCurved({ 0, { { 0.0, 0.0, 1.0 - below } } });
    distribution.particles.push_back(
      particleAt(at.location, at.point, curvature(at.point.gradient, at.hessian), 0.01));
  }
  ASSERT_TRUE(putBack(surface, distribution, {}));
  for (const Particle& particle : distribution.particles)
  {
    EXPECT_LT(glm::distance(particle.position.xyz, apex), 1e-9);
    EXPECT_GT(glm::distance(particle.position.xyz, apex), 0.0);
    EXPECT_LE(particle.residual, 1e-10);
    EXPECT_NEAR(length(particle.normal), 1.0, 1e-12);
  }
}

TEST(LiftedField, CoversNothingBeyondASpacing)
{
  ElementMesh mesh;
  const Distribution distribution = onHyperboloid(mesh, -1e-4);
  const Buffer<Particle>& particles = distribution.particles;
  std::vector<int> all;
  std::vector<int> above;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    all.push_back(static_cast<int>(i));
    if (particles[i].position.xyz.z > 0.0)
    {
      above.push_back(static_cast<int>(i));
    }
  }
  EXPECT_TRUE(isCoveredBy(particles, all, particles, all));
  EXPECT_TRUE(isCoveredBy(particles, above, particles, all));
  EXPECT_FALSE(isCoveredBy(particles, all, particles, above));
}

} // namespace
} // namespace hop::testing
