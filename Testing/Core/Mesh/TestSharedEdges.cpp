#include "Mesh/SharedEdges.h"

#include "FanCases.h"
#include "FlatSheet.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

const FlatSheet::Loop square{ { -0.8, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.8 }, { -0.8, 0.8 } };

/// Two sheets of two triangles each, (0, 1, 2), (1, 0, 3) and (4, 5, 6), (5, 4, 7), on the surface of a sheet. The edges in
/// their middles, (0, 1) and (4, 5), end in the same two places.
struct TwoSheets
{
  TwoSheets()
  {
    this->distribution.particles = particlesAt({ { 0, 0 }, { 0.2, 0 }, { 0.1, 0.1 }, { 0.1, -0.1 },
      { 0, 0 }, { 0.2, 0 }, { 0, 0.2 }, { 0, -0.2 } });
    for (Particle& particle : this->distribution.particles)
    {
      particle.location = this->sheet.distribution.particles[0].location;
      particle.spacing = 2.0;
    }
    this->distribution.edges.coincident = { { 0, 4 }, { 1, 5 } };
  }

  std::vector<int> places() const
  {
    return firstInPlace(this->distribution.edges, this->distribution.particles.size());
  }

  FlatSheet sheet{ { square }, 0.1 };
  Distribution distribution;
  TriangleFans fans = fansOf(8, { { 0, 1, 2 }, { 1, 0, 3 }, { 4, 5, 6 }, { 5, 4, 7 } });
};

TEST(SharedEdges, GiveAllSheetsButOneAParticleInTheMiddle)
{
  TwoSheets two;
  splitSharedEdges(two.sheet.surface(), two.places(), two.distribution, two.fans, {});
  ASSERT_EQ(two.distribution.particles.size(), 9u);
  const glm::dvec3 middle = two.distribution.particles[8].position.xyz;
  EXPECT_NEAR(glm::distance(middle, glm::dvec3(0.1, 0.0, 0.0)), 0.0, 1e-9);
  EXPECT_EQ(two.fans.apexOf(0, 1), 2);
  EXPECT_EQ(two.fans.apexOf(4, 5), -1);
  EXPECT_EQ(two.fans.apexOf(4, 8), 6);
  EXPECT_EQ(two.fans.apexOf(5, 8), 7);
}

TEST(SharedEdges, StayWhereOneSheetHasThem)
{
  TwoSheets two;
  two.fans.remove({ 4, 5, 6 });
  two.fans.remove({ 5, 4, 7 });
  splitSharedEdges(two.sheet.surface(), two.places(), two.distribution, two.fans, {});
  EXPECT_EQ(two.distribution.particles.size(), 8u);
  EXPECT_EQ(two.fans.apexOf(0, 1), 2);
}

TEST(SharedEdges, EndsInOnePlaceBecomeOne)
{
  Distribution distribution;
  distribution.particles = particlesAt({ { 0, 0 }, { 1, 0 }, { 1, 0 }, { 0, 1 } });
  distribution.edges.segments = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } };
  distribution.edges.directed = distribution.edges.segments;
  uniteEnds(distribution);
  const ConstrainedEdges edges(distribution);
  EXPECT_TRUE(edges.has(0, 1) && edges.has(1, 3) && edges.has(3, 0));
  EXPECT_FALSE(edges.isOnEdge(2));
  EXPECT_EQ(distribution.edges.replaced, (std::vector<int>{ 2 }));
  EXPECT_EQ(firstInPlace(distribution.edges, 4), (std::vector<int>{ 0, 1, 1, 3 }));
}

/// A slit from (-1, 0) to the origin: 0 to 1 along one side of a crease, 2 to 3 back along the other one.
struct Slit
{
  Slit()
  {
    this->distribution.particles = particlesAt({ { -1, 0 }, { 0, 0 }, { 0, 0 }, { -1, 0 } });
    this->distribution.edges.segments = { { 0, 1 }, { 2, 3 } };
    this->distribution.edges.directed = this->distribution.edges.segments;
    this->distribution.edges.coincident = { { 1, 2 } };
  }

  Distribution distribution;
};

TEST(SharedEdges, CreasesThatEndInTheSurfaceHaveOneParticleThere)
{
  Slit slit;
  uniteEnds(slit.distribution);
  const ConstrainedEdges edges(slit.distribution);
  EXPECT_TRUE(edges.has(0, 1) && edges.has(1, 3));
  EXPECT_FALSE(edges.isOnEdge(2));
}

TEST(SharedEdges, CreasesBetweenOppositeSheetsEndInTwo)
{
  Slit slit;
  for (const int other : { 2, 3 })
  {
    slit.distribution.particles[other].normal = -1.0 * slit.distribution.particles[other].normal;
  }
  uniteEnds(slit.distribution);
  EXPECT_TRUE(ConstrainedEdges(slit.distribution).isOnEdge(2));
}

TEST(SharedEdges, SidesOfACreaseThatGoesOnStayApart)
{
  Slit slit;
  slit.distribution.particles.push_back(slit.distribution.particles[0]);
  slit.distribution.particles.back().position = { { 1.0, 0.0, 0.0 } };
  slit.distribution.edges.directed = { { 0, 1 }, { 1, 4 }, { 4, 2 }, { 2, 3 } };
  uniteEnds(slit.distribution);
  EXPECT_EQ(slit.distribution.edges.directed[3], (std::array<int, 2>{ 2, 3 }));
}

} // namespace
} // namespace hop::testing
