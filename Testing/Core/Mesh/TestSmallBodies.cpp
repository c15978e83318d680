#include "Mesh/SmallBodies.h"

#include "FanCases.h"
#include "MeshMeasures.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

/// Evenly spread on an ellipsoid around a place, with normals inward or outward.
struct Ellipsoid
{
  glm::dvec3 middle{ 0.0 };
  glm::dvec3 axes{ 4.0, 1.0, 2.0 };
  int count = 24;
  double side = 1.0;

  void addTo(Buffer<Particle>& particles) const
  {
    for (int n = 0; n < this->count; ++n)
    {
      const double z = 1.0 - (2.0 * n + 1.0) / this->count;
      const double angle = n * glm::pi<double>() * (3.0 - std::sqrt(5.0));
      const double r = std::sqrt(1.0 - z * z);
      const glm::dvec3 x(r * std::cos(angle), r * std::sin(angle), z);
      Particle particle;
      particle.position = { this->middle + this->axes * x };
      particle.normal = { this->side * glm::normalize(x / this->axes) };
      particle.spacing = 1.6;
      particle.location = { 0, { glm::dvec3(0.5) } };
      particles.push_back(particle);
    }
  }
};

/// What becomes of particles without triangles.
MeshMeasures closed(const Distribution& distribution, bool isAny = true)
{
  TriangleFans fans = fansOf(distribution.particles.size(), {});
  const ConstrainedEdges edges(distribution);
  const ParticleNeighbors neighbors(distribution, {});
  EXPECT_EQ(closeSmallBodies(neighbors, edges, {}, fans), isAny);
  return measureMesh(distribution, fans.triangles({}));
}

TEST(SmallBodies, AreClosedByTheirHull)
{
  for (const double side : { 1.0, -1.0 })
  {
    Distribution distribution;
    Ellipsoid some;
    some.side = side;
    some.addTo(distribution.particles);
    const MeshMeasures measures = closed(distribution);
    EXPECT_EQ(measures.unusedParticles, 0);
    EXPECT_EQ(measures.openEdges, 0);
    EXPECT_EQ(measures.badEdges, 0);
    EXPECT_EQ(measures.eulerCharacteristic, 2);
    EXPECT_EQ(measures.turnedTriangles, 0) << "seen from where the normals point to";
  }
}

TEST(SmallBodies, ThatAreNearEachOtherAreNone)
{
  // Two that touch all but, and look at each other.
  Distribution distribution;
  Ellipsoid some;
  some.addTo(distribution.particles);
  some.middle = { 0.0, 2.05, 0.0 };
  some.addTo(distribution.particles);
  EXPECT_EQ(closed(distribution, false).components, 0);
}

TEST(SmallBodies, AreNeitherPatchesNorLarge)
{
  Distribution patch;
  Ellipsoid some;
  some.count = 60;
  some.addTo(patch.particles);
  patch.particles.resize(20); // one end of it
  EXPECT_EQ(closed(patch, false).components, 0) << "whose hull has a back";
  Distribution large;
  some.axes = glm::dvec3(3.0);
  some.count = 120;
  some.addTo(large.particles);
  EXPECT_EQ(closed(large, false).components, 0);
}

} // namespace
} // namespace hop::testing
