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

/// A particle that is no part of the mesh yet.
struct Loose
{
  glm::dvec3 place;
  glm::dvec3 normal;
  double spacing = 0.1;
};

/// A square with a mesh.
struct Square
{
  FlatSheet sheet{ { square }, 0.1 };
  Distribution& distribution = sheet.distribution;
  ConstrainedEdges edges{ distribution };
  std::vector<Triangle> triangles =
    agreedTriangles(ParticleNeighbors(distribution, {}), edges, {}).triangles({});

  int add(const Loose& loose)
  {
    Particle particle = this->distribution.particles.front();
    particle.position = { loose.place };
    particle.normal = { loose.normal };
    particle.spacing = loose.spacing;
    this->distribution.particles.push_back(particle);
    return static_cast<int>(this->distribution.particles.size()) - 1;
  }

  MeshMeasures join()
  {
    TriangleFans fans = fansOf(this->distribution.particles.size(), this->triangles);
    const ParticleNeighbors neighbors(this->distribution, {});
    joinLooseParticles(neighbors, this->edges,
      findOpenLoops(this->distribution.particles, this->edges, fans, {}), fans);
    const MeshMeasures measures = measureMesh(this->distribution, fans.triangles({}));
    EXPECT_EQ(measures.badEdges, 0);
    EXPECT_EQ(measures.badVertices, 0);
    EXPECT_EQ(measures.turnedTriangles, 0);
    EXPECT_EQ(measures.holeEdges, 0);
    EXPECT_EQ(measures.eulerCharacteristic, 1);
    return measures;
  }
};

/// The mesh of a square, and one more particle.
MeshMeasures measuresWith(const glm::dvec3& place, const glm::dvec3& normal, double spacing = 0.1)
{
  Square some;
  some.add({ place, normal, spacing });
  const MeshMeasures measures = some.join();
  EXPECT_NEAR(measures.area, some.sheet.area(), 1e-9);
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

TEST(LooseParticles, AreJoinedThoughTheirOwnSpacingIsTooSmallToSeeTheMesh)
{
  EXPECT_EQ(measuresWith({ 0.031, 0.044, 0 }, { 0, 0, 1 }, 0.005).unusedParticles, 0);
}

TEST(LooseParticles, TakeSmallPiecesApartThatLieOnTheMesh)
{
  // On a ridge, whose particles see each other alone.
  Square some;
  std::vector<int> ridge;
  for (const glm::dvec3& place :
    { glm::dvec3(0.031, 0.044, 0), glm::dvec3(0.037, 0.044, 0), glm::dvec3(0.034, 0.049, 0) })
  {
    ridge.push_back(some.add({ place, { 0, 0, 1 }, 0.006 }));
  }
  some.triangles.push_back({ ridge[0], ridge[1], ridge[2] });
  const MeshMeasures measures = some.join();
  EXPECT_EQ(measures.components, 1);
  EXPECT_EQ(measures.unusedParticles, 0);
  EXPECT_NEAR(measures.area, some.sheet.area(), 1e-9);
}

TEST(LooseParticles, AreLeftAloneBesideAnotherSheet)
{
  EXPECT_EQ(measuresWith({ 0.031, 0.044, 0.0 }, { 0, 0, -1 }).unusedParticles, 1);
  EXPECT_EQ(measuresWith({ 0.031, 0.044, 0.08 }, { 0, 0, 1 }).unusedParticles, 1);
}

} // namespace
} // namespace hop::testing
