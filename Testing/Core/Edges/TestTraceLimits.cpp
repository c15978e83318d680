#include "Edges/TraceLimits.h"

#include "Fast/FastDistribution.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace hop;
using namespace hop::testing;

constexpr double pi = 3.14159265358979323846;

/// The face of the unit cube on which z = 0.
int bottomOf(const ElementMesh& mesh)
{
  int face = 0;
  while (std::abs(faceMargin(mesh.face(0, face), { { 0.5, 0.5, 0.0 } })) > 1e-12)
  {
    ++face;
  }
  return face;
}

Location onCircle(double radius, double angle)
{
  return { 0, { { 0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle), 0.0 } } };
}

/// How often a trace may go round a circle on a face, 100 chords each time.
int roundsAdmitted(const ElementMesh& mesh, double radius)
{
  TraceLimits limits(mesh);
  const int face = bottomOf(mesh);
  constexpr int chords = 100;
  int n = 0;
  while (n < 100 * chords &&
    limits.admit(
      onCircle(radius, 2.0 * pi * n / chords), face, onCircle(radius, 2.0 * pi * (n + 1) / chords)))
  {
    ++n;
  }
  return n / chords;
}

TEST(TraceLimits, ACurveIsFollowedOnceButNotForEver)
{
  const ElementMesh mesh = referenceMesh(
    Domain::Hexahedron, 2, [](const glm::dvec3& x) { return glm::dot(x - 0.5, x - 0.5); });
  EXPECT_GE(roundsAdmitted(mesh, 0.49), 1);
  EXPECT_LE(roundsAdmitted(mesh, 0.49), 12);
}

TEST(TraceLimits, HigherDegreesHaveLongerCurves)
{
  const auto admitted = [](int degree)
  {
    return roundsAdmitted(referenceMesh(Domain::Hexahedron, degree, [](auto) { return 0.0; }), 0.4);
  };
  EXPECT_NEAR(admitted(8), 4 * admitted(2), 4);
}

TEST(TraceLimits, ATraceThatPassesToAndFroEnds)
{
  const ElementMesh mesh = referenceMesh(Domain::Wedge, 2, [](auto) { return 0.0; });
  TraceLimits limits(mesh);
  const Location here{ 0, { { 0.2, 0.2, 0.0 } } };
  int n = 0;
  while (n < 1000 && limits.admit(here, n % 2, here))
  {
    ++n;
  }
  EXPECT_GT(n, 8);
  EXPECT_LT(n, 200);
}

/// Spacings of this mesh are zero in single precision.
TEST(BoundaryTracer, EndsWhereChordsUnderflow)
{
  for (const Domain domain : allDomains)
  {
    MeshRecipe recipe;
    recipe.domain = domain;
    recipe.cells = 1;
    recipe.field = [](const glm::dvec3& x)
    { return std::sin(5.0 * x.x) * std::cos(4.0 * x.y) + x.z; };
    ElementMesh mesh = makeMesh(recipe);
    for (Coefficient& c : mesh.coefficients)
    {
      c = Coefficient(3e-100 * glm::dvec3(c), 1e-200 * c.w);
    }
    DistributionParameters parameters;
    parameters.particleCount = 50;
    const Distribution distribution = distributeFast({ &mesh, 0.0, 1e-110 }, parameters, {}, {});
    EXPECT_FALSE(distribution.report.aborted);
  }
}

} // namespace
