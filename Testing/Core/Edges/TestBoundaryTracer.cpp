#include "Edges/BoundaryTracer.h"

#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

/// A surface that all but lies in the face z = -1 of a cube, and meets it in a slender ellipse.
struct Lens
{
  static constexpr double HalfLength = 0.6;
  static constexpr double HalfWidth = 0.01;
  static double squaredWidth(double x)
  {
    return HalfWidth * HalfWidth * (1.0 - x * x / (HalfLength * HalfLength));
  }
  static double halfWidth(double x) { return std::sqrt(std::max(0.0, squaredWidth(x))); }

  static ElementMesh mesh()
  {
    MeshRecipe recipe;
    recipe.cells = 1;
    recipe.field = [](const glm::dvec3& x)
    { return x.z + 1.0 + 0.5 * (x.y * x.y - squaredWidth(x.x)); };
    return makeMesh(recipe);
  }
};

int lowerFace(const ElementMesh& mesh)
{
  const auto& faces = facts(mesh.elements[0].domain).faces;
  return static_cast<int>(
    std::find_if(faces.begin(), faces.end(), [](const Face& f) { return f.inward.xyz.z > 0.0; }) -
    faces.begin());
}

/// Where tracing a lens begins.
BoundaryPoint startOn(BoundaryTracer& tracer, const ElementMesh& mesh, double spacing)
{
  const double x = -0.2;
  const glm::dvec3 start(x, Lens::halfWidth(x), -1.0);
  const auto point = tracer.project({ 0, { 0.5 * (start + 1.0) } }, lowerFace(mesh), spacing);
  EXPECT_TRUE(point);
  return *point;
}

/// At the tip the two sides of the curve are much closer to each other than chords are long, and the surface's normals are
/// nearly the same there.
TEST(BoundaryTracer, GoesAroundSlenderTips)
{
  const ElementMesh mesh = Lens::mesh();
  for (const double spacing : { 0.07, 0.13, 0.27 })
  {
    const Isosurface surface{ &mesh, 0.0, 1e-6 };
    BoundaryTracer tracer(surface, BoundaryTracer::Points::Rough);
    tracer.followEnds(false);
    const BoundaryTrace trace =
      tracer.trace(startOn(tracer, mesh, spacing), [=](const BoundaryPoint&) { return spacing; });
    EXPECT_TRUE(trace.closed) << spacing;
    glm::dvec2 least(0.0);
    glm::dvec2 most(0.0);
    for (const BoundaryVertex& vertex : trace.vertices)
    {
      const glm::dvec3 place = vertex.position();
      EXPECT_NEAR(place.y * place.y, Lens::squaredWidth(place.x), 1e-5);
      least = glm::min(least, glm::dvec2(place));
      most = glm::max(most, glm::dvec2(place));
    }
    EXPECT_NEAR(most.x - least.x, 2.0 * Lens::HalfLength, 0.1 * spacing);
    EXPECT_NEAR(most.y - least.y, 2.0 * Lens::HalfWidth, 0.1 * Lens::HalfWidth);
  }
}

/// Around a singular point spacings are many times smaller than a little farther off, and curves begin there as well as
/// anywhere else.
TEST(BoundaryTracer, ChordsGrowWithTheSpacingAlongTheCurve)
{
  const ElementMesh mesh = Lens::mesh();
  const Isosurface surface{ &mesh, 0.0, 1e-6 };
  BoundaryTracer tracer(surface, BoundaryTracer::Points::Rough);
  tracer.followEnds(false);
  const double least = 1e-4;
  const BoundaryPoint start = startOn(tracer, mesh, least);
  const auto spacingAt = [&](const BoundaryPoint& point)
  {
    const double away =
      glm::distance(point.at.point.map.position.xyz, start.at.point.map.position.xyz);
    return std::clamp(0.5 * away, least, 0.1);
  };
  const BoundaryTrace trace = tracer.trace(start, spacingAt);
  EXPECT_TRUE(trace.closed);
  // As many chords of the least length as 5 % of the curve has.
  EXPECT_LT(static_cast<double>(trace.vertices.size()), 0.05 * 4.0 * Lens::HalfLength / least);
  for (std::size_t v = 1; v < trace.vertices.size(); ++v)
  {
    const BoundaryVertex& before = trace.vertices[v - 1];
    EXPECT_EQ(before.spacing, spacingAt(before.leaving));
    EXPECT_LE(glm::distance(before.position(), trace.vertices[v].position()), before.spacing);
  }
}

} // namespace
} // namespace hop::testing
