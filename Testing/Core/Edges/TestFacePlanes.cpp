#include "Edges/FacePlanes.h"

#include "Elements/BatchEvaluator.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.1;

/// A plane with a dihedral angle (pi: of a boundary curve), its distance in units of the spacing.
ClipPlane planeAt(const glm::dvec3& normal, double distance, double angle)
{
  return { { normal }, distance * spacing, 0.0, static_cast<float>(angle), angle < Pi ? 0 : -1 };
}

/// The planes of a particle that was offered some.
std::array<ClipPlane, 3> kept(const std::vector<ClipPlane>& planes)
{
  Particle particle;
  particle.spacing = spacing;
  for (const ClipPlane& plane : planes)
  {
    offerPlane(particle, plane);
  }
  return particle.clips;
}

bool isSame(const ClipPlane& a, const ClipPlane& b)
{
  return a.normal.xyz == b.normal.xyz && a.distance == b.distance;
}

const glm::dvec3 axisX(1, 0, 0);
const glm::dvec3 axisY(0, 1, 0);

/// Which of several planes of different edges are kept, the most important one first.
TEST(FacePlanes, BoundaryCurvesComeBeforeCreasesAndTheseBeforeSmallerAngles)
{
  const ClipPlane boundary = planeAt(axisX, 0.9, Pi);
  const ClipPlane crease = planeAt(axisY, 0.5, 0.5);
  const ClipPlane nearCrease = planeAt(-axisX, 0.2, 0.3);
  const ClipPlane almostSmooth = planeAt(-axisY, 0.0, 0.1);
  const ClipPlane farBoundary = planeAt({ 0, 0, 1 }, 1.2, Pi);
  const ClipPlane outOfReach = planeAt({ 0, 0, -1 }, 1.6, Pi);
  const std::vector<ClipPlane> ranked{ boundary, nearCrease, crease, farBoundary, almostSmooth };
  for (std::size_t first = 0; first + 1 < ranked.size(); ++first)
  {
    std::vector<ClipPlane> offered(
      ranked.begin() + static_cast<std::ptrdiff_t>(first), ranked.end());
    offered.push_back(outOfReach);
    std::vector<int> order(offered.size());
    std::iota(order.begin(), order.end(), 0);
    do
    {
      std::vector<ClipPlane> shuffled;
      for (const int n : order)
      {
        shuffled.push_back(offered[n]);
      }
      const auto clips = kept(shuffled);
      ASSERT_TRUE(isSame(clips[0], ranked[first])) << first;
      ASSERT_TRUE(isSame(clips[1], ranked[first + 1])) << first;
      ASSERT_TRUE(first + 2 == ranked.size() || isSame(clips[2], ranked[first + 2])) << first;
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(FacePlanes, BoundaryCurvesBeyondTheSplatAreRankedAsCreases)
{
  const ClipPlane boundary = planeAt(axisX, 1.2, Pi);
  const ClipPlane farther = planeAt(axisY, 1.3, 0.5);
  EXPECT_TRUE(isSame(kept({ farther, boundary })[0], boundary));
  const ClipPlane nearer = planeAt(axisY, 1.1, 0.5);
  EXPECT_TRUE(isSame(kept({ boundary, nearer })[0], nearer));
}

/// On a strip between a crease and a boundary curve another splat is seen.
TEST(FacePlanes, CreasesBeforeABoundaryCurveAlongThemAreKept)
{
  const ClipPlane boundary = planeAt(axisX, 0.9, Pi);
  const ClipPlane crease = planeAt(axisX, 0.5, 0.3);
  const auto both = kept({ crease, boundary });
  EXPECT_TRUE(isSame(both[0], boundary));
  EXPECT_TRUE(isSame(both[1], crease));
  // The same edge twice, and a crease beyond the end of the surface.
  EXPECT_FALSE(kept({ planeAt(axisX, 0.85, 0.3), boundary })[1].exists());
  EXPECT_FALSE(kept({ planeAt(axisX, 1.2, 0.3), boundary })[1].exists());
}

TEST(FacePlanes, TheSecondPlaneIsAnotherEdge)
{
  const glm::dvec3 alike = glm::normalize(glm::dvec3(1.0, 0.5, 0.0));  // cosine 0.89
  const glm::dvec3 unlike = glm::normalize(glm::dvec3(1.0, 1.0, 0.0)); // cosine 0.71
  const ClipPlane near = planeAt(axisX, 0.1, Pi);
  EXPECT_FALSE(kept({ near, planeAt(alike, 0.2, Pi) })[1].exists());
  EXPECT_FALSE(kept({ planeAt(alike, 0.2, Pi), near })[1].exists());
  EXPECT_TRUE(isSame(kept({ planeAt(alike, 0.2, Pi), near })[0], near));
  EXPECT_TRUE(kept({ near, planeAt(unlike, 0.2, Pi) })[1].exists());
  EXPECT_TRUE(kept({ planeAt(unlike, 0.2, Pi), near })[1].exists());
}

/// A sector of a ring around the z axis, radii 1 to 2; the field is the height above a bowl that is z = 0 at the outer
/// radius.
ElementMesh sector(double slope)
{
  MeshRecipe recipe;
  recipe.degrees = { 6, 6, 2 };
  recipe.map = [](const glm::dvec3& x)
  { return glm::dvec3(x.x * std::cos(x.y), x.x * std::sin(x.y), x.z); };
  recipe.field = [=](const glm::dvec3& x) { return x.z - slope * (x.x * x.x + x.y * x.y - 4.0); };
  ElementMesh mesh;
  appendBox(mesh, recipe, { 1, 0, -1 }, { 2, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

constexpr int outerFace = 1;

/// A particle at the middle of the sector, whose element's outer face has a dihedral angle.
Particle offered(const ElementMesh& mesh, double radius, double slope, double angle)
{
  const Isosurface surface{ &mesh, 0.0, 1e-9 };
  FaceJumps jumps;
  jumps.dihedralAngles.assign(MaximumFaces, 0.0f);
  jumps.dihedralAngles[outerFace] = static_cast<float>(angle);
  const double z = slope * (radius * radius - 4.0);
  Particle particle;
  particle.location = { 0, { { radius - 1.0, 0.5, 0.5 * (z + 1.0) } } };
  particle.spacing = spacing;
  const Jet jet = evaluateHessian(mesh.form(0), particle.location.u);
  const FieldPoint point = fieldPoint(jet, 0.0);
  particle.position = point.map.position;
  particle.normal = surfaceNormal(point.gradient);
  offerFaces(surface, jumps, jet, point, particle);
  return particle;
}

/// The plane touches a circle of radius 2, to second order, on a flat surface and on a bowl.
TEST(FacePlanes, OfACreaseTouchTheCircleWhereItIsNearest)
{
  for (const double slope : { 0.0, 0.2 })
  {
    const ElementMesh mesh = sector(slope);
    for (const double distance : { 0.0, 0.3 * spacing, spacing })
    {
      const double radius = 2.0 - distance;
      const Particle particle = offered(mesh, radius, slope, 0.5);
      ASSERT_NEAR(glm::length(glm::dvec2(particle.position.xyz)), radius, 1e-4 * spacing);
      const ClipPlane& plane = particle.clips[0];
      ASSERT_TRUE(plane.exists()) << slope << " " << distance;
      const glm::dvec3 outward(std::cos(0.5), std::sin(0.5), 0.0);
      EXPECT_LT(glm::distance(plane.normal.xyz, outward), 1e-3);
      EXPECT_NEAR(plane.distance, distance, 1e-3 * spacing);
      // The Hessian of the face is that at the particle, on a circle of radius 2 - distance.
      EXPECT_NEAR(plane.edgeCurvature, -0.5, 0.3 * distance + 1e-3);
      EXPECT_EQ(plane.face, outerFace);
      EXPECT_NEAR(plane.dihedralAngle, 0.5, 1e-6);
      EXPECT_FALSE(plane.isBoundary());
      EXPECT_FALSE(particle.clips[1].exists());
    }
  }
}

TEST(FacePlanes, OfASmallAngleAreFacesToFirstOrder)
{
  const ElementMesh mesh = sector(0.2);
  const ClipPlane plane = offered(mesh, 2.0 - 0.5 * spacing, 0.2, 0.5 * CreaseAngle).clips[0];
  ASSERT_TRUE(plane.exists());
  EXPECT_NEAR(plane.distance, 0.5 * spacing, 1e-3 * spacing);
  EXPECT_EQ(plane.edgeCurvature, 0.0);
}

TEST(FacePlanes, AreNotThoseOfSmoothOrDistantFaces)
{
  const ElementMesh mesh = sector(0.0);
  EXPECT_FALSE(offered(mesh, 1.95, 0.0, 0.0).clips[0].exists());
  EXPECT_FALSE(offered(mesh, 2.0 - 1.01 * ClipReach * spacing, 0.0, 0.5).clips[0].exists());
  EXPECT_TRUE(offered(mesh, 2.0 - 0.99 * ClipReach * spacing, 0.0, 0.5).clips[0].exists());
}

} // namespace
} // namespace hop::testing
