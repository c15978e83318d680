#include "Mesh/EdgeSplitting.h"

#include "FlatSheet.h"
#include "Mesh/SurfaceMesh.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

using Edges = std::vector<std::array<int, 2>>;

/// Particles at (-0.5, 0), (0.5, 0) and elsewhere. The surface ends below each of the others, so far.
Distribution above(const std::vector<glm::dvec2>& places, double distance)
{
  std::vector<glm::dvec2> all{ { -0.5, 0.0 }, { 0.5, 0.0 } };
  all.insert(all.end(), places.begin(), places.end());
  Distribution distribution;
  distribution.particles = particlesAt(all);
  for (Particle& particle : distribution.particles)
  {
    particle.clips[0].normal = { { 0, -1, 0 } };
    particle.clips[0].distance = distance;
  }
  return distribution;
}

Edges split(const Distribution& distribution, Edges edges)
{
  splitAtParticles(distribution, edges);
  return edges;
}

TEST(EdgeSplitting, IsAtParticlesOnAnEdgeInTheirOrder)
{
  const Distribution distribution = above({ { 0.2, 0.01 }, { -0.1, 0.0 } }, 0.01);
  EXPECT_EQ(split(distribution, { { 0, 1 } }), (Edges{ { 0, 3 }, { 2, 1 }, { 3, 2 } }));
}

TEST(EdgeSplitting, IsNotAtParticlesThatOthersReplace)
{
  Distribution distribution = above({ { 0.499999, 0.0 } }, 0.0);
  distribution.edges.replaced = { 2 };
  EXPECT_EQ(split(distribution, { { 0, 1 } }), (Edges{ { 0, 1 } }));
}

TEST(EdgeSplitting, IsAtParticlesBeyondTheChordOfACurve)
{
  for (const double fromCurve : { 0.0, 0.2 })
  {
    EXPECT_EQ(
      split(above({ { 0.1, -0.1 } }, fromCurve), { { 0, 1 } }), (Edges{ { 0, 2 }, { 2, 1 } }));
  }
}

TEST(EdgeSplitting, DropsAnEdgeBesideTwoThatLeadTheSameWay)
{
  const Edges all{ { 0, 1 }, { 0, 2 }, { 2, 1 } };
  EXPECT_EQ(split(above({ { 0.1, 0.02 } }, 1.0), all), (Edges{ { 0, 2 }, { 2, 1 } }));
  EXPECT_EQ(split(above({ { 0.1, 0.2 } }, 1.0), all), all) << "a triangle";
  const Edges there{ { 0, 1 }, { 0, 2 }, { 1, 0 }, { 2, 1 } };
  EXPECT_EQ(split(above({ { 0.1, 0.02 } }, 1.0), there), there) << "a slit";
}

TEST(EdgeSplitting, IsNotWhereTheSurfaceGoesOn)
{
  EXPECT_EQ(split(above({ { 0.1, 0.1 } }, 0.1), { { 0, 1 } }), (Edges{ { 0, 1 } }));
  EXPECT_EQ(split(above({ { 0.6, 0.0 } }, 0.0), { { 0, 1 } }), (Edges{ { 0, 1 } })) << "beside it";
  EXPECT_EQ(split(above({ { 0.1, -0.6 } }, 0.0), { { 0, 1 } }), (Edges{ { 0, 1 } })) << "far off";
}

TEST(EdgeSplitting, IsNotAtOtherSheets)
{
  Distribution distribution = above({ { 0.1, 0.0 } }, 0.0);
  distribution.particles[2].normal = { { 0, 0, -1 } };
  EXPECT_EQ(split(distribution, { { 0, 1 } }), (Edges{ { 0, 1 } }));
}

TEST(EdgeSplitting, LeavesSlitsAndCreasesAlone)
{
  Distribution distribution = above({ { 0.1, 0.0 }, { -0.5, 0.0 }, { 0.5, 0.0 } }, 0.0);
  const Edges slit{ { 0, 1 }, { 1, 0 } };
  EXPECT_EQ(split(distribution, slit), (Edges{ { 0, 1 }, { 1, 0 } }));
  distribution.edges.coincident = { { 0, 3 }, { 1, 4 } };
  EXPECT_EQ(split(distribution, { { 0, 1 } }), (Edges{ { 0, 1 } }));
}

TEST(EdgeSplitting, LeavesNoParticleOver)
{
  FlatSheet sheet({ { { -0.8, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.8 }, { -0.8, 0.8 } } }, 0.1);
  Particle particle = sheet.distribution.particles[0];
  particle.position = { { 0.03, -0.81, 0.0 } };
  particle.clips = {};
  particle.clips[0].normal = { { 0, -1, 0 } };
  sheet.distribution.particles.push_back(particle);
  const SurfaceMesh mesh =
    meshSurface(sheet.surface(), ConstrainedEdges(sheet.distribution), sheet.distribution, {}, {});
  EXPECT_EQ(mesh.unusedParticles, 0);
  EXPECT_EQ(mesh.openLoops, 0);
}

} // namespace
} // namespace hop::testing
