#include "Edges/CellBorders.h"

#include "Elements/BatchEvaluator.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

/// A sector of a ring around the z axis, radii 1 to 2; the field is the height above a bowl that is z = 0 at the outer
/// radius.
ElementMesh sector(double slope)
{
  MeshRecipe recipe;
  recipe.degrees = { 8, 8, 2 };
  recipe.map = [](const glm::dvec3& x)
  { return glm::dvec3(x.x * std::cos(x.y), x.x * std::sin(x.y), x.z); };
  recipe.field = [=](const glm::dvec3& x) { return x.z - slope * (x.x * x.x + x.y * x.y - 4.0); };
  ElementMesh mesh;
  appendBox(mesh, recipe, { 1, 0, -1 }, { 2, 1, 1 });
  findFaceNeighbors(mesh, 1e-9);
  return mesh;
}

/// A particle of the sector at this radius and angle.
Particle particleOn(
  const ElementMesh& mesh, double radius, double angle, double slope, double spacing)
{
  const double z = slope * (radius * radius - 4.0);
  const Location place{ 0, { { radius - 1.0, angle, 0.5 * (z + 1.0) } } };
  const Jet jet = evaluateHessian(mesh.form(0), place.u);
  const FieldPoint point = fieldPoint(jet, 0.0);
  Particle particle =
    particleAt(place, point, curvature(point.gradient, worldHessian(jet, point)), spacing);
  markCellBorders(mesh, jet, point.map, particle);
  return particle;
}

/// How far the place on the border that lies at a length along it is off the circle of radius 2, as the particle sees
/// surface and border: both to second order.
double errorAlong(const Particle& particle, const CellBorder& border, double along)
{
  const glm::dvec3 foot(border.foot);
  const glm::dvec3 outward = glm::normalize(foot);
  const glm::dvec3 tangent = glm::cross(particle.normal.xyz, outward);
  const glm::dvec3 inPlane =
    foot + along * tangent + 0.5 * border.curvature * along * along * outward;
  const double below = 0.5 * glm::dot(inPlane, particle.curvature.shape * inPlane);
  const glm::dvec3 place = particle.position.xyz + inPlane - below * particle.normal.xyz;
  return std::abs(glm::length(glm::dvec2(place)) - 2.0);
}

TEST(CellBorders, AreRightToSecondOrderOnCurvedFacesAndSurfaces)
{
  for (const double slope : { 0.0, 0.3, -0.8 })
  {
    const ElementMesh mesh = sector(slope);
    const auto errorAt = [&](double spacing)
    {
      double largest = 0.0;
      for (const double distance : { 0.0, 0.3, 0.8 })
      {
        const Particle particle = particleOn(
          mesh, 2.0 - distance * spacing / std::hypot(1.0, 4.0 * slope), 0.5, slope, spacing);
        EXPECT_TRUE(particle.borders[0].exists()) << slope << " " << distance;
        EXPECT_FALSE(particle.borders[1].exists());
        EXPECT_NEAR(glm::length(particle.borders[0].foot), distance * spacing, 0.1 * spacing);
        EXPECT_NEAR(glm::dot(glm::dvec3(particle.borders[0].foot), particle.normal.xyz), 0.0, 1e-6);
        for (const double along : { -0.7, 0.0, 0.7 })
        {
          largest = std::max(largest, errorAlong(particle, particle.borders[0], along * spacing));
        }
      }
      return largest / spacing;
    };
    const double coarse = errorAt(0.1);
    EXPECT_LT(coarse, 0.01) << slope;
    // A quarter for half the spacing: errors are of third order, in units of the spacing of second.
    EXPECT_LT(errorAt(0.05), 0.35 * coarse + 1e-5) << slope;
  }
}

TEST(CellBorders, OfACornerAreKeptNearestFirst)
{
  const double spacing = 0.1;
  const ElementMesh mesh = sector(0.0);
  const Particle particle = particleOn(mesh, 1.95, 0.01, 0.0, spacing);
  EXPECT_NEAR(glm::length(particle.borders[0].foot), 1.95 * std::sin(0.01), 1e-3 * spacing);
  EXPECT_NEAR(glm::length(particle.borders[1].foot), 0.05, 1e-3 * spacing);
  EXPECT_FALSE(particle.borders[2].exists());
  EXPECT_NEAR(particle.borders[0].curvature, 0.0, 0.05);
  EXPECT_NEAR(particle.borders[1].curvature, -0.5, 0.05);
}

TEST(CellBorders, OutOfReachAreNone)
{
  const ElementMesh mesh = sector(0.0);
  EXPECT_FALSE(particleOn(mesh, 1.5, 0.5, 0.0, 0.1).borders[0].exists());
  EXPECT_FALSE(particleOn(mesh, 1.895, 0.5, 0.0, 0.1).borders[0].exists());
  EXPECT_TRUE(particleOn(mesh, 1.905, 0.5, 0.0, 0.1).borders[0].exists());
}

TEST(CellBorders, KeepTheirDirectionWhereTheParticleStandsOnThem)
{
  const Particle particle = particleOn(sector(0.0), 2.0, 0.5, 0.0, 0.1);
  ASSERT_TRUE(particle.borders[0].exists());
  const glm::vec3 outward(std::cos(0.5), std::sin(0.5), 0.0);
  EXPECT_LT(glm::distance(glm::normalize(particle.borders[0].foot), outward), 1e-4f);
  EXPECT_LT(glm::length(particle.borders[0].foot), 1e-5f);
}

TEST(CellBorders, NotMoreThanThereIsRoomForAreKept)
{
  const double spacing = 3.0; // beyond all six faces of the sector but those above and below
  const Particle particle = particleOn(sector(0.0), 1.4, 0.3, 0.0, spacing);
  for (int i = 0; i + 1 < CellBorder::Most; ++i)
  {
    ASSERT_TRUE(particle.borders[i + 1].exists());
    EXPECT_LE(glm::length(particle.borders[i].foot), glm::length(particle.borders[i + 1].foot));
  }
}

} // namespace
} // namespace hop::testing
