#include "Edges/BoundaryCurves.h"

#include "AnalyticFields.h"
#include "ElementCases.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.06;
constexpr double tolerance = 1e-9;

BoundaryCurves curvesOf(const ElementMesh& mesh, const ParallelFor& parallelFor = {},
  SampledCurves sampled = SampledCurves::Boundary)
{
  const SizingFunction sizing{ spacing, 0.0 };
  Isosurface surface{ &mesh, 0.0, tolerance };
  const SurfaceProxy proxy(
    surface, sizing, findSurfaceBoxes(mesh, 0.0, 6.0 * spacing, parallelFor), parallelFor);
  FaceJumps jumps = findFaceJumps(surface, proxy, parallelFor);
  surface.jumpTolerances = &jumps.jumpTolerances;
  return findBoundaryCurves(surface, jumps, proxy, sizing, sampled, parallelFor);
}

/// Distances of neighbours on a closed curve around the origin.
std::vector<double> gapsOfCurve(const std::vector<glm::dvec2>& places)
{
  std::vector<glm::dvec2> sorted = places;
  const auto angle = [](const glm::dvec2& x) { return std::atan2(x.y, x.x); };
  std::sort(sorted.begin(), sorted.end(),
    [&](const glm::dvec2& a, const glm::dvec2& b) { return angle(a) < angle(b); });
  std::vector<double> gaps;
  for (std::size_t n = 0; n < sorted.size(); ++n)
  {
    gaps.push_back(glm::distance(sorted[n], sorted[(n + 1) % sorted.size()]));
  }
  return gaps;
}

/// Places of the particles on a face of the cube [-1,1]^3, as coordinates of the face.
std::vector<glm::dvec2> placesOnFace(const BoundaryCurves& curves, int axis, double side)
{
  std::vector<glm::dvec2> places;
  for (const BoundaryParticle& p : curves.particles)
  {
    const glm::dvec3& x = p.particle.position.xyz;
    if (std::abs(x[axis] - side) < 1e-9)
    {
      places.emplace_back(x[(axis + 1) % 3], x[(axis + 2) % 3]);
    }
  }
  return places;
}

class BoundaryCurvesIn : public ::testing::TestWithParam<Domain>
{
};

INSTANTIATE_TEST_SUITE_P(BoundaryCurves, BoundaryCurvesIn, ::testing::ValuesIn(allDomains),
  [](const auto& which) { return ::testing::PrintToString(which.param); });

/// A sphere that each face of a cube cuts in a circle.
TEST_P(BoundaryCurvesIn, OfASphereAreCirclesOfEvenParticles)
{
  constexpr double sphereRadius = 1.2;
  const double radius = std::sqrt(sphereRadius * sphereRadius - 1.0);
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.field = sphere({ 0, 0, 0 }, sphereRadius).field;
  const BoundaryCurves curves = curvesOf(makeMesh(recipe));
  const double length = 2.0 * Pi * radius;
  const double count = std::round(length / spacing);
  EXPECT_EQ(static_cast<double>(curves.particles.size()), 6.0 * count);
  EXPECT_GT(curves.evaluations, 0);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      const auto places = placesOnFace(curves, axis, side);
      EXPECT_EQ(static_cast<double>(places.size()), count);
      for (const glm::dvec2& place : places)
      {
        EXPECT_NEAR(glm::length(place), radius, 10.0 * tolerance);
      }
      const std::vector<double> gaps = gapsOfCurve(places);
      EXPECT_NEAR(std::accumulate(gaps.begin(), gaps.end(), 0.0), length, 0.01 * length);
      for (const double gap : gaps)
      {
        EXPECT_NEAR(gap, spacing, 0.04 * spacing);
      }
    }
  }
}

/// Every particle on a closed curve has two neighbours, one spacing away.
TEST_P(BoundaryCurvesIn, OfASphereAreChainsOfParticles)
{
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.field = sphere({ 0, 0, 0 }, 1.2).field;
  const BoundaryCurves curves = curvesOf(makeMesh(recipe));
  std::vector<int> neighbors(curves.particles.size());
  for (const auto& [a, b] : curves.edges.segments)
  {
    ++neighbors[a];
    ++neighbors[b];
    EXPECT_NEAR(
      glm::distance(curves.particles[a].patch.position, curves.particles[b].patch.position),
      spacing, 0.04 * spacing);
  }
  ASSERT_FALSE(neighbors.empty());
  EXPECT_EQ(std::count(neighbors.begin(), neighbors.end(), 2),
    static_cast<std::ptrdiff_t>(neighbors.size()));
}

/// The caps beyond the faces are holes of the surface: the circles bend outwards, with geodesic curvature cot(theta)/R
/// at the angle theta from the pole, cos(theta) = 1/R.
TEST_P(BoundaryCurvesIn, OfASphereKnowTheWayOutAndTheirBend)
{
  constexpr double sphereRadius = 1.2;
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.field = sphere({ 0, 0, 0 }, sphereRadius).field;
  const double cosine = 1.0 / sphereRadius;
  const double bend = cosine / std::sqrt(1.0 - cosine * cosine) / sphereRadius;
  for (const BoundaryParticle& p : curvesOf(makeMesh(recipe)).particles)
  {
    const glm::dvec3& x = p.particle.position.xyz;
    EXPECT_LT(glm::distance(p.particle.normal.xyz, x / sphereRadius), 1e-7);
    EXPECT_LE(p.particle.residual, tolerance);
    ASSERT_TRUE(p.side.exists());
    EXPECT_FALSE(p.otherSide.exists());
    glm::dvec3 pole(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      pole[axis] = std::abs(std::abs(x[axis]) - 1.0) < 1e-9 ? x[axis] : 0.0;
    }
    const glm::dvec3 normal = x / sphereRadius;
    const glm::dvec3 outward = glm::normalize(pole - glm::dot(pole, normal) * normal);
    EXPECT_LT(glm::distance(p.side.outward.xyz, outward), 1e-6);
    EXPECT_NEAR(p.side.edgeCurvature, bend, 1e-5);
    EXPECT_TRUE(p.patch.fixed);
    EXPECT_LT(glm::distance(p.patch.position, x), 10.0 * tolerance);
    EXPECT_EQ(p.patch.spacing, static_cast<float>(spacing));
  }
}

/// A larger sphere crosses the edges of the cube at (1, 1, 1/2) and the like: around each corner of the cube a curve of
/// three arcs of 36.87 degrees on circles of radius sqrt(5)/2, with a corner between two arcs.
TEST_P(BoundaryCurvesIn, HaveCornersWhereFacesOfACubeMeet)
{
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.field = sphere({ 0, 0, 0 }, 1.5).field;
  const BoundaryCurves curves = curvesOf(makeMesh(recipe));
  const double arc = 0.5 * std::sqrt(5.0) * (std::atan(2.0) - std::atan(0.5));
  const double perArc = std::round(arc / spacing);
  EXPECT_EQ(static_cast<double>(curves.particles.size()), 24.0 * perArc);
  int corners = 0;
  for (const BoundaryParticle& p : curves.particles)
  {
    const glm::dvec3 x = glm::abs(p.particle.position.xyz);
    const int sides = (x.x > 1.0 - 1e-9) + (x.y > 1.0 - 1e-9) + (x.z > 1.0 - 1e-9);
    ASSERT_GE(sides, 1);
    corners += sides == 2;
    // Of two tetrahedra or wedges at an edge of the cube each has one of the faces only.
    const bool isOneElement = this->GetParam() == Domain::Hexahedron;
    EXPECT_TRUE(p.otherSide.exists() ? sides == 2 : sides < 2 || !isOneElement);
    if (sides == 2)
    {
      EXPECT_NEAR(std::min({ x.x, x.y, x.z }), 0.5, 10.0 * tolerance);
    }
  }
  EXPECT_EQ(corners, 24);
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto places = placesOnFace(curves, axis, 1.0);
    for (const glm::dvec2& place : places)
    {
      double nearest = 1.0;
      for (const glm::dvec2& other : places)
      {
        nearest = &other == &place ? nearest : std::min(nearest, glm::distance(place, other));
      }
      EXPECT_NEAR(nearest, arc / perArc, 0.04 * spacing);
    }
  }
}

/// A plane cuts a polygon out of one element: a particle on each of its corners, the others at equal distances between.
TEST_P(BoundaryCurvesIn, OfAPlaneAreAPolygon)
{
  const Domain domain = this->GetParam();
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.3, 1.0));
  const double offset = 0.37;
  ElementMesh mesh = referenceMesh(domain, 1, plane(normal, offset).field);
  findFaceNeighbors(mesh, 1e-9);
  const DomainFacts& which = facts(domain);
  double expected = 0.0;
  std::vector<std::array<glm::dvec3, 2>> sides;
  for (const Face& face : which.faces)
  {
    std::vector<glm::dvec3> corners;
    for (int c = 0; c < face.cornerCount; ++c)
    {
      const glm::dvec3& from = which.corners[face.corners[c]].xyz;
      const glm::dvec3& to = which.corners[face.corners[(c + 1) % face.cornerCount]].xyz;
      const double a = glm::dot(normal, from) - offset;
      const double b = glm::dot(normal, to) - offset;
      if (a * b < 0.0)
      {
        corners.push_back(glm::mix(from, to, a / (a - b)));
      }
    }
    if (corners.size() == 2)
    {
      sides.push_back({ corners[0], corners[1] });
      expected += std::max(1.0, std::round(glm::distance(corners[0], corners[1]) / spacing));
    }
  }
  ASSERT_GE(sides.size(), 3u);
  const BoundaryCurves curves = curvesOf(mesh);
  EXPECT_EQ(static_cast<double>(curves.particles.size()), expected);
  std::size_t corners = 0;
  for (const auto& [from, to] : sides)
  {
    const double length = glm::distance(from, to);
    const double count = std::max(1.0, std::round(length / spacing));
    std::vector<double> along;
    for (const BoundaryParticle& p : curves.particles)
    {
      const glm::dvec3& x = p.particle.position.xyz;
      const double t = glm::dot(x - from, to - from) / (length * length);
      if (glm::distance(x, glm::mix(from, to, t)) < 10.0 * tolerance)
      {
        along.push_back(t);
        corners += p.otherSide.exists();
        EXPECT_NEAR(p.side.edgeCurvature, 0.0, 1e-9);
      }
    }
    std::sort(along.begin(), along.end());
    ASSERT_EQ(static_cast<double>(along.size()), count + 1.0);
    for (std::size_t n = 0; n < along.size(); ++n)
    {
      EXPECT_NEAR(along[n], static_cast<double>(n) / count, n % (along.size() - 1) ? 1e-3 : 1e-8);
    }
  }
  EXPECT_EQ(corners, 2 * sides.size());
}

/// The plane leaves the first triangle of a wedge for its oblique side at an angle of 19.3 degrees.
TEST(BoundaryCurves, PassCornersOfLessThanTwentyDegrees)
{
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.4, 0.7, 1.0));
  const double offset = 0.45;
  ElementMesh mesh = referenceMesh(Domain::Wedge, 1, plane(normal, offset).field);
  findFaceNeighbors(mesh, 1e-9);
  const double y = (offset - normal.x) / (normal.y - normal.x); // on the edge x + y = 1, z = 0
  const glm::dvec3 corner(1.0 - y, y, 0.0);
  std::vector<double> distances;
  for (const BoundaryParticle& p : curvesOf(mesh).particles)
  {
    distances.push_back(glm::distance(p.particle.position.xyz, corner));
  }
  std::sort(distances.begin(), distances.end());
  ASSERT_GT(distances.size(), 40u);
  EXPECT_GT(distances[0], 1e-3);
  EXPECT_NEAR(distances[0] + distances[1], spacing, 0.05 * spacing);
}

TEST_P(BoundaryCurvesIn, AreNoneOnASurfaceInsideTheDomain)
{
  MeshRecipe recipe;
  recipe.domain = this->GetParam();
  recipe.field = sphere({ 0.1, -0.13, 0.07 }, 0.6).field;
  EXPECT_EQ(curvesOf(makeMesh(recipe)).particles.size(), 0u);
}

/// Two halves of a cube: the surface z = 0.03, on the right higher by a step, in units of the spacing.
ElementMesh halvesWithStep(double step)
{
  ElementMesh mesh;
  MeshRecipe recipe;
  recipe.degrees = { 1, 1, 1 };
  recipe.field = [](const glm::dvec3& x) { return x.z - 0.03; };
  appendBox(mesh, recipe, { -1, -1, -1 }, { 0, 1, 1 });
  recipe.field = [=](const glm::dvec3& x) { return x.z - 0.03 - step * spacing; };
  appendBox(mesh, recipe, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

TEST(BoundaryCurves, RunAlongBothSidesOfAJumpAndKnowIt)
{
  constexpr double step = 0.9;
  std::array<int, 2> counts{};
  for (const BoundaryParticle& p : curvesOf(halvesWithStep(step)).particles)
  {
    const glm::dvec3& x = p.particle.position.xyz;
    if (std::abs(x.x) < 1e-9)
    {
      const bool right = x.z > 0.03 + 0.5 * step * spacing;
      ++counts[right];
      EXPECT_NEAR(x.z, right ? 0.03 + step * spacing : 0.03, 10.0 * tolerance);
      EXPECT_NEAR(p.particle.jump, (right ? step : -step) * spacing, 1e-8);
      EXPECT_NEAR(
        p.side.outward.xyz.x, right ? -1.0 : 1.0, std::abs(x.y) < 1.0 - 1e-9 ? 1e-9 : 1.0);
    }
  }
  EXPECT_NEAR(counts[0], 2.0 / spacing + 1.0, 1.0);
  EXPECT_NEAR(counts[1], 2.0 / spacing + 1.0, 1.0);
}

TEST(BoundaryCurves, AreNoneAlongJumpsThatTheSurfacePasses)
{
  int inMiddle = 0;
  for (const BoundaryParticle& p : curvesOf(halvesWithStep(0.15)).particles)
  {
    const glm::dvec3& x = p.particle.position.xyz;
    inMiddle += std::abs(x.x) < 1e-9 && std::abs(x.y) < 1.0 - 1e-9;
  }
  EXPECT_EQ(inMiddle, 0);
}

/// Two halves of a cube whose step grows from nothing at one end of the face between them to 0.8 spacings at the other.
ElementMesh halvesWithFadingStep()
{
  ElementMesh mesh;
  MeshRecipe left, right;
  left.field = [](const glm::dvec3& x) { return x.z - 0.03; };
  right.field = [](const glm::dvec3& x) { return x.z - 0.03 - 0.4 * spacing * (1.0 + x.y); };
  appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, right, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

/// \param below which they have y
int particlesAtStep(const BoundaryCurves& curves, double below)
{
  return static_cast<int>(std::count_if(curves.particles.begin(), curves.particles.end(),
    [below](const BoundaryParticle& p)
    {
      const glm::dvec3& x = p.particle.position.xyz;
      return std::abs(x.x) < 1e-9 && x.y > -1.0 + 1e-9 && x.y < below;
    }));
}

TEST(BoundaryCurves, OfMeshesDoNotEndWhereAJumpFades)
{
  const BoundaryCurves curves = curvesOf(halvesWithFadingStep(), {}, SampledCurves::ForMeshes);
  // Both sides along all of the face, though at one end they meet.
  EXPECT_NEAR(particlesAtStep(curves, 1.0 - 1e-9), 2.0 * (2.0 / spacing - 1.0), 2.0);
  std::vector<int> begins(curves.particles.size(), 0);
  std::vector<int> ends(curves.particles.size(), 0);
  for (const auto& [a, b] : curves.edges.directed)
  {
    ++begins[a];
    ++ends[b];
  }
  EXPECT_EQ(begins, std::vector<int>(curves.particles.size(), 1));
  EXPECT_EQ(ends, begins);
}

/// On the left the surface reaches over the upper end of the face between two halves of a cube, for less than a chord: its
/// curve leaves the face there, runs along the end of the mesh, and comes back.
TEST(BoundaryCurves, OfMeshesLeaveAFaceHoweverShortTheWayOutside)
{
  constexpr double bend = 0.98;
  constexpr double middle = 0.04;
  for (const double half : { 0.018, 0.02 })
  {
    MeshRecipe left, right;
    left.degrees = { 2, 2, 2 };
    left.field = [=](const glm::dvec3& x)
    { return x.z - 1.0 - bend * (half * half - std::pow(x.y - middle, 2)) - 0.3 * x.x; };
    right.field = [](const glm::dvec3& x) { return x.z - 0.5; };
    ElementMesh mesh;
    appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
    appendBox(mesh, right, { 0, -1, -1 }, { 1, 1, 1 });
    findFaceNeighbors(mesh, 1e-9);
    const BoundaryCurves curves = curvesOf(mesh, {}, SampledCurves::ForMeshes);
    std::vector<int> surplus(curves.particles.size(), 0);
    for (const auto& [a, b] : curves.edges.directed)
    {
      ++surplus[a];
      --surplus[b];
    }
    EXPECT_EQ(surplus, std::vector<int>(curves.particles.size(), 0)) << half;
  }
}

TEST(BoundaryCurves, OfSplatsEndWhereAJumpFades)
{
  const BoundaryCurves curves = curvesOf(halvesWithFadingStep());
  const double passed = -1.0 + LargestJumpPerSpacing / 0.4;
  EXPECT_EQ(particlesAtStep(curves, passed - spacing), 0);
  EXPECT_GT(particlesAtStep(curves, 1.0 - 1e-9), 1.0 / spacing);
}

TEST(BoundaryCurves, DoNotDependOnThreads)
{
  MeshRecipe recipe;
  recipe.domain = Domain::Tetrahedron;
  recipe.field = sphere({ 0.1, -0.13, 0.07 }, 1.3).field;
  const ElementMesh mesh = makeMesh(recipe);
  const BoundaryCurves serial = curvesOf(mesh);
  const BoundaryCurves threaded = curvesOf(mesh, threadedFor(3));
  EXPECT_EQ(threaded.evaluations, serial.evaluations);
  ASSERT_EQ(threaded.particles.size(), serial.particles.size());
  for (std::size_t i = 0; i < serial.particles.size(); ++i)
  {
    EXPECT_EQ(threaded.particles[i].patch.position, serial.particles[i].patch.position);
  }
}

/// A roof with a ridge of a right angle over x = 0.
ElementMesh ridge()
{
  MeshRecipe left, right;
  left.field = [](const glm::dvec3& x) { return x.z - 0.1 - x.x; };
  right.field = [](const glm::dvec3& x) { return x.z - 0.1 + x.x; };
  ElementMesh mesh;
  appendBox(mesh, left, { -1, -1, -1 }, { 0, 1, 1 });
  appendBox(mesh, right, { 0, -1, -1 }, { 1, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

TEST(BoundaryCurves, LeaveCreasesOutUnlessAskedFor)
{
  const BoundaryCurves curves = curvesOf(ridge());
  EXPECT_TRUE(curves.edges.coincident.empty());
  EXPECT_TRUE(curves.edges.directed.empty());
  for (const BoundaryParticle& p : curves.particles)
  {
    EXPECT_FALSE(p.isOnCrease);
  }
}

TEST(BoundaryCurves, OfBothSidesOfACreaseMeetInTheSamePlaces)
{
  const BoundaryCurves curves = curvesOf(ridge(), {}, SampledCurves::ForMeshes);
  // The ridge is 2 long, and has particles at both ends.
  EXPECT_EQ(
    curves.edges.coincident.size(), static_cast<std::size_t>(std::ceil(2.0 / (1.1 * spacing))) + 1);
  for (const auto& [a, b] : curves.edges.coincident)
  {
    const Particle& first = curves.particles[a].particle;
    const Particle& second = curves.particles[b].particle;
    EXPECT_EQ(first.position.xyz, second.position.xyz);
    EXPECT_NE(first.location.element, second.location.element);
    EXPECT_NEAR(dot(first.normal, second.normal), 0.0, 1e-9);
    EXPECT_LT(std::abs(first.position.xyz.x), tolerance);
  }
}

TEST(BoundaryCurves, OfOneSideOfACreaseHaveItsSurfaceToTheirLeft)
{
  const BoundaryCurves curves = curvesOf(ridge(), {}, SampledCurves::ForMeshes);
  // Both halves are rectangles, so that their middles are to the left of all edges.
  EXPECT_GT(curves.edges.directed.size(), curves.particles.size() - 1);
  for (const auto& [a, b] : curves.edges.directed)
  {
    const Particle& first = curves.particles[a].particle;
    const Particle& second = curves.particles[b].particle;
    const double side = first.normal.xyz.x > 0.0 ? -0.5 : 0.5;
    const glm::dvec3 middle(side, 0.0, 0.1 - std::abs(side));
    const glm::dvec3 left = glm::cross(first.normal.xyz, (second.position - first.position).xyz);
    EXPECT_GT(glm::dot(left, middle - first.position.xyz), 0.0);
  }
}

} // namespace
} // namespace hop::testing
