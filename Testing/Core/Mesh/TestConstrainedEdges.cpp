#include "Mesh/ConstrainedEdges.h"

#include "FlatSheet.h"
#include "Mesh/SurfaceMesh.h"
#include "MeshMeasures.h"

#include <gtest/gtest.h>

#include <numeric>

namespace hop::testing
{
namespace
{

const FlatSheet::Loop square{ { -0.8, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.8 }, { -0.8, 0.8 } };

TEST(ConstrainedEdges, HaveTheSurfaceToTheLeft)
{
  const FlatSheet sheet({ square }, 0.1);
  const ConstrainedEdges edges(sheet.distribution);
  std::int64_t count = 0;
  const auto& particles = sheet.distribution.particles;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    for (const int next : edges.after(static_cast<int>(i)))
    {
      ++count;
      const glm::dvec3 a = particles[i].position.xyz;
      EXPECT_GT(glm::cross(a, particles[next].position.xyz).z, 0.0);
      EXPECT_TRUE(edges.has(static_cast<int>(i), next));
      EXPECT_FALSE(edges.has(next, static_cast<int>(i)));
      EXPECT_TRUE(edges.joins(next, static_cast<int>(i)));
      ASSERT_EQ(edges.before(next).size(), 1u);
      EXPECT_EQ(edges.before(next)[0], static_cast<int>(i));
    }
  }
  EXPECT_EQ(count, static_cast<std::int64_t>(sheet.distribution.edges.segments.size()));
}

TEST(ConstrainedEdges, GoBothWaysWhereNoPlaneTellsTheSide)
{
  FlatSheet sheet({ square }, 0.1);
  for (Particle& p : sheet.distribution.particles)
  {
    p.clips = {};
  }
  const ConstrainedEdges edges(sheet.distribution);
  for (const auto& [a, b] : sheet.distribution.edges.segments)
  {
    EXPECT_TRUE(edges.has(a, b));
    EXPECT_TRUE(edges.has(b, a));
  }
}

TEST(ConstrainedEdges, LeadFromNoParticleToItself)
{
  Distribution distribution;
  distribution.particles = particlesAt({ { 0, 0 }, { 1, 0 } });
  distribution.edges.directed = { { 0, 0 }, { 0, 1 }, { 1, 0 } };
  const ConstrainedEdges edges(distribution);
  EXPECT_EQ(edges.after(0).size(), 1u);
  EXPECT_FALSE(edges.has(0, 0));
}

TEST(ConstrainedEdges, AreNoneWithoutSegments)
{
  const ConstrainedEdges edges{ Distribution() };
  EXPECT_TRUE(edges.empty());
  EXPECT_FALSE(edges.isOnEdge(0));
  EXPECT_FALSE(edges.joins(3, 7));
}

/// A name, and the borders of a flat surface.
struct BorderCase
{
  const char* name;
  std::vector<FlatSheet::Loop> loops;
};

std::ostream& operator<<(std::ostream& out, const BorderCase& which)
{
  return out << which.name;
}

class Borders : public ::testing::TestWithParam<BorderCase>
{
};

/// Spacing 0.1 in all cases.
INSTANTIATE_TEST_SUITE_P(ConstrainedEdges, Borders,
  ::testing::Values(BorderCase{ "Square", { square } },
    BorderCase{ "Triangle", { { { -0.8, -0.5 }, { 0.8, -0.6 }, { 0.1, 0.8 } } } },
    BorderCase{ "Needle", { { { -0.8, 0.0 }, { 0.8, -0.1 }, { 0.8, 0.1 } } } },
    BorderCase{ "Strip", { { { -0.8, 0.0 }, { 0.8, 0.0 }, { 0.8, 0.06 }, { -0.8, 0.06 } } } },
    BorderCase{ "ReentrantCorner",
      { { { -0.8, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.0 }, { 0.0, 0.0 }, { 0.0, 0.8 },
        { -0.8, 0.8 } } } },
    BorderCase{ "Notch",
      { { { -0.8, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.8 }, { 0.02, 0.8 }, { 0.0, 0.0 }, { -0.02, 0.8 },
        { -0.8, 0.8 } } } },
    BorderCase{ "ThinSlit",
      { square, { { -0.5, -0.005 }, { -0.5, 0.005 }, { 0.5, 0.005 }, { 0.5, -0.005 } } } },
    BorderCase{ "SlitWithoutWidth", { square, { { -0.5, 0.0 }, { 0.5, 0.0 } } } },
    BorderCase{
      "SmallHole", { square, { { -0.1, -0.1 }, { -0.1, 0.1 }, { 0.1, 0.1 }, { 0.1, -0.1 } } } },
    BorderCase{ "OneTriangle", { { { 0.0, 0.0 }, { 0.1, 0.0 }, { 0.05, 0.09 } } } },
    BorderCase{ "TwoPieces",
      { { { -0.8, -0.8 }, { -0.01, -0.8 }, { -0.01, 0.8 }, { -0.8, 0.8 } },
        { { 0.01, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.8 }, { 0.01, 0.8 } } } }),
  [](const auto& which) { return which.param.name; });

TEST_P(Borders, AreTheOnlyOpenEdges)
{
  FlatSheet sheet(this->GetParam().loops, 0.1);
  const SurfaceMesh mesh =
    meshSurface(sheet.surface(), ConstrainedEdges(sheet.distribution), sheet.distribution, {}, {});
  const MeshMeasures measures = measureMesh(sheet.distribution, mesh.triangles);
  EXPECT_EQ(measures.badEdges, 0);
  EXPECT_EQ(measures.badVertices, 0);
  EXPECT_EQ(measures.turnedTriangles, 0);
  EXPECT_EQ(measures.holeEdges, 0);
  EXPECT_EQ(measures.unusedParticles, 0);
  EXPECT_EQ(
    measures.openEdges, static_cast<std::int64_t>(sheet.distribution.edges.segments.size()));
  EXPECT_EQ(mesh.openLoops, 0);
  EXPECT_EQ(mesh.unusedParticles, 0);
  EXPECT_NEAR(measures.area, sheet.area(), 1e-9);
}

TEST_P(Borders, EndTheAreasOfParticles)
{
  const FlatSheet sheet(this->GetParam().loops, 0.1);
  const std::vector<double> areas =
    particleAreas(sheet.distribution, ConstrainedEdges(sheet.distribution), {}, {});
  // Cells are cut off at the border of the particle itself, not at other parts of the border near it.
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0) / sheet.area(), 1.0, 0.03);
}

} // namespace
} // namespace hop::testing
