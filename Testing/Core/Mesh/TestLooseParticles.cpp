#include "Mesh/LooseParticles.h"

#include "FanCases.h"
#include "FlatSheet.h"
#include "Mesh/ParticleStars.h"
#include "MeshMeasures.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

const FlatSheet::Loop square{ { -0.8, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.8 }, { -0.8, 0.8 } };

/// The mesh of a square, and one more particle.
MeshMeasures measuresWith(const glm::dvec3& place, const glm::dvec3& normal)
{
  FlatSheet sheet({ square }, 0.1);
  Distribution& distribution = sheet.distribution;
  const ConstrainedEdges edges(distribution);
  const std::vector<Triangle> triangles =
    agreedTriangles(ParticleNeighbors(distribution, {}), edges, {}).triangles({});
  Particle loose = distribution.particles.front();
  loose.position = { place };
  loose.normal = { normal };
  distribution.particles.push_back(loose);
  TriangleFans fans = fansOf(distribution.particles.size(), triangles);
  joinLooseParticles(ParticleNeighbors(distribution, {}), edges, fans);
  const MeshMeasures measures = measureMesh(distribution, fans.triangles({}));
  EXPECT_EQ(measures.badEdges, 0);
  EXPECT_EQ(measures.badVertices, 0);
  EXPECT_EQ(measures.turnedTriangles, 0);
  EXPECT_EQ(measures.holeEdges, 0);
  EXPECT_EQ(measures.eulerCharacteristic, 1);
  EXPECT_NEAR(measures.area, sheet.area(), 1e-9);
  return measures;
}

TEST(LooseParticles, AreJoinedToWhatCoversThem)
{
  const glm::dvec3 up(0, 0, 1);
  // Anywhere; in the middle of an edge between two particles of a row; and beside the border.
  for (const glm::dvec3& place :
    { glm::dvec3(0.031, 0.044, 0), glm::dvec3(0.0623, 0.0071, 0), glm::dvec3(0.033, 0.799, 0) })
  {
    EXPECT_EQ(measuresWith(place, up).unusedParticles, 0);
  }
}

TEST(LooseParticles, AreLeftAloneBesideAnotherSheet)
{
  EXPECT_EQ(measuresWith({ 0.031, 0.044, 0.0 }, { 0, 0, -1 }).unusedParticles, 1);
  EXPECT_EQ(measuresWith({ 0.031, 0.044, 0.08 }, { 0, 0, 1 }).unusedParticles, 1);
}

} // namespace
} // namespace hop::testing
