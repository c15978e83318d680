#include "Mesh/LiftedField.h"

#include "Fast/FastDistribution.h"
#include "Mesh/ConstrainedEdges.h"
#include "Mesh/SurfaceMesh.h"
#include "MeshMeasures.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

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

} // namespace
} // namespace hop::testing
