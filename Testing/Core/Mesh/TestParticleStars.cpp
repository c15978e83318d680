#include "Mesh/ParticleStars.h"

#include "FlatSheet.h"
#include "Mesh/TangentPlane.h"
#include "MeshMeasures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

const FlatSheet::Loop square{ { -0.8, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.8 }, { -0.8, 0.8 } };

TriangleFans starsOf(const Distribution& distribution)
{
  const ConstrainedEdges edges(distribution);
  const ParticleNeighbors neighbors(distribution, {});
  return agreedTriangles(neighbors, edges, {});
}

TEST(TangentPlane, RanksTurnsInTheirOrder)
{
  const glm::dvec2 from(0.6, -1.7);
  double before = -1.0;
  constexpr int steps = 720;
  for (int n = 0; n < steps; ++n)
  {
    const double turn = 2.0 * 3.14159265358979 * n / steps;
    const double c = std::cos(turn), s = std::sin(turn), length = 0.1 + n % 7;
    const glm::dvec2 to = length * glm::dvec2(c * from.x - s * from.y, s * from.x + c * from.y);
    const double rank = n == 0 ? turnRank(from, from) : turnRank(from, to);
    EXPECT_GT(rank, before) << n;
    EXPECT_LT(rank, FullRank);
    before = rank;
  }
  EXPECT_EQ(turnRank(from, from), 0.0);
  EXPECT_EQ(turnRank(from, -from), 0.5 * FullRank);
  EXPECT_EQ(turnRank(from, { 0.0, 0.0 }), 0.0);
}

TEST(ParticleStars, AgreeAllOverAPlane)
{
  const FlatSheet sheet({ square }, 0.1);
  const MeshMeasures measures =
    measureMesh(sheet.distribution, starsOf(sheet.distribution).triangles({}));
  EXPECT_EQ(measures.holeEdges, 0);
  EXPECT_NEAR(measures.area, sheet.area(), 1e-9);
}

TEST(ParticleStars, HaveNoParticleThatIsReplaced)
{
  FlatSheet sheet({ square }, 0.1);
  Distribution& distribution = sheet.distribution;
  distribution.particles.push_back(Particle(distribution.particles.front()));
  EXPECT_TRUE(starsOf(distribution).hasTriangles(0));
  distribution.edges.replaced = { 0 };
  const TriangleFans fans = starsOf(distribution);
  EXPECT_FALSE(fans.hasTriangles(0));
  EXPECT_EQ(measureMesh(distribution, fans.triangles({})).holeEdges, 0);
}

TEST(ParticleStars, MakeNoTriangleThatIsTurnedAway)
{
  // Noise: particles anywhere in a thin layer, with normals up to 45 degrees off. What is proven holds all the same.
  Distribution distribution;
  for (std::uint64_t i = 0; i < 3000; ++i)
  {
    const auto random = [i](std::uint64_t k) {
      return static_cast<double>((i * 7919 + k * 104729 + 12345) * 2654435761u % 65536) / 65536.0;
    };
    Particle p;
    p.position = { { random(1), random(2), 0.01 * random(3) } };
    p.normal = { glm::normalize(glm::dvec3(random(4) - 0.5, random(5) - 0.5, 0.7)) };
    p.spacing = 0.03 * (1.0 + random(6));
    distribution.particles.push_back(p);
  }
  const MeshMeasures measures = measureMesh(distribution, starsOf(distribution).triangles({}));
  EXPECT_GT(measures.area, 0.0);
  EXPECT_EQ(measures.badEdges, 0);
  EXPECT_EQ(measures.turnedTriangles, 0);
}

TEST(ParticleStars, DoNotJoinSheetsThatFaceEachOther)
{
  FlatSheet sheet({ square }, 0.1);
  Distribution both = sheet.distribution;
  const int count = static_cast<int>(both.particles.size());
  for (int i = 0; i < count; ++i)
  {
    Particle p = both.particles[i];
    p.position.xyz.z = 0.001;
    p.normal = { { 0, 0, -1 } };
    both.particles.push_back(p);
  }
  for (const auto& [a, b] : sheet.distribution.edges.segments)
  {
    both.edges.segments.push_back({ a + count, b + count });
  }
  const MeshMeasures measures = measureMesh(both, starsOf(both).triangles({}));
  EXPECT_EQ(measures.components, 2);
  EXPECT_EQ(measures.holeEdges, 0);
  EXPECT_NEAR(measures.area, 2.0 * sheet.area(), 1e-9);
}

} // namespace
} // namespace hop::testing
