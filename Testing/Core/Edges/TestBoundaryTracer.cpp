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

/// At the tip the two sides of the curve are much closer to each other than chords are long, and the surface's normals are
/// nearly the same there.
TEST(BoundaryTracer, GoesAroundSlenderTips)
{
  const ElementMesh mesh = Lens::mesh();
  for (const double step : { 0.05, 0.1, 0.2 })
  {
    const Isosurface surface{ &mesh, 0.0, 1e-6 };
    BoundaryTracer tracer(surface, BoundaryTracer::Points::Rough);
    tracer.followEnds(false);
    const double x = -0.2;
    const glm::dvec3 start(x, Lens::halfWidth(x), -1.0);
    const auto point = tracer.project({ 0, { 0.5 * (start + 1.0) } }, lowerFace(mesh), step);
    ASSERT_TRUE(point);
    const BoundaryTrace trace = tracer.trace(*point, step, {});
    EXPECT_TRUE(trace.closed) << step;
    glm::dvec2 least(0.0);
    glm::dvec2 most(0.0);
    for (const BoundaryVertex& vertex : trace.vertices)
    {
      const glm::dvec3 place = vertex.position();
      EXPECT_NEAR(place.y * place.y, Lens::squaredWidth(place.x), 1e-5);
      least = glm::min(least, glm::dvec2(place));
      most = glm::max(most, glm::dvec2(place));
    }
    EXPECT_NEAR(most.x - least.x, 2.0 * Lens::HalfLength, 0.1 * step);
    EXPECT_NEAR(most.y - least.y, 2.0 * Lens::HalfWidth, 0.1 * Lens::HalfWidth);
  }
}

} // namespace
} // namespace hop::testing
