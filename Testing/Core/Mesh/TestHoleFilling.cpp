#include "Mesh/HoleFilling.h"

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
constexpr double spacing = 0.1;

/// Triangles with all corners within a distance from a place are taken away.
void cutOut(
  const Distribution& distribution, const glm::dvec3& middle, double radius, TriangleFans& fans)
{
  for (const Triangle& triangle : fans.triangles({}))
  {
    if (std::all_of(triangle.begin(), triangle.end(),
          [&](int corner)
          { return glm::distance(distribution.particles[corner].position.xyz, middle) < radius; }))
    {
      fans.remove(triangle);
    }
  }
}

struct Filled
{
  std::size_t added = 0;
  MeshMeasures measures;
};

/// \param change takes something away before the holes are filled
template <class Change>
Filled fillAfter(FlatSheet& sheet, const Change& change)
{
  Distribution& distribution = sheet.distribution;
  const std::size_t before = distribution.particles.size();
  const ConstrainedEdges edges(distribution);
  const ParticleNeighbors neighbors(distribution, {});
  TriangleFans fans = agreedTriangles(neighbors, edges, {});
  change(fans);
  fillHoles(sheet.surface(), neighbors, edges, distribution, fans, {});
  return { distribution.particles.size() - before, measureMesh(distribution, fans.triangles({})) };
}

void expectWhole(const FlatSheet& sheet, const Filled& filled)
{
  EXPECT_EQ(filled.measures.badEdges, 0);
  EXPECT_EQ(filled.measures.badVertices, 0);
  EXPECT_EQ(filled.measures.turnedTriangles, 0);
  EXPECT_EQ(filled.measures.holeEdges, 0);
  EXPECT_EQ(filled.measures.unusedParticles, 0);
  EXPECT_NEAR(filled.measures.area, sheet.area(), 1e-9);
}

TEST(HoleFilling, JoinsParticlesInsideOfHoles)
{
  FlatSheet sheet({ square }, spacing);
  const Filled filled = fillAfter(sheet,
    [&](TriangleFans& fans) {
      cutOut(sheet.distribution, { 0.1, 0.2, 0.0 }, 0.25, fans);
    });
  expectWhole(sheet, filled);
  EXPECT_EQ(filled.added, 0u);
}

TEST(HoleFilling, JoinsPiecesInsideOfHoles)
{
  FlatSheet sheet({ square }, spacing);
  const Filled filled = fillAfter(sheet,
    [&](TriangleFans& fans)
    {
      const TriangleFans whole = fans;
      const glm::dvec3 middle(0.1, 0.2, 0.0);
      cutOut(sheet.distribution, middle, 0.35, fans);
      TriangleFans rest = whole;
      cutOut(sheet.distribution, middle, 0.13, rest);
      // The triangles in the middle come back.
      for (const Triangle& triangle : whole.triangles({}))
      {
        const auto& [a, b, c] = triangle;
        if (rest.apexOf(a, b) != c)
        {
          fans.add(triangle);
        }
      }
    });
  expectWhole(sheet, filled);
  EXPECT_EQ(filled.added, 0u);
}

/// As at the tip of a slit, where a curve lost its second particle in one place.
TEST(HoleFilling, DoesNotTakeWhatIsInThePlaceOfACornerForWhatIsInside)
{
  const FlatSheet sheet({ square }, 2.0 * spacing);
  const Distribution& whole = sheet.distribution;
  const TriangleFans fans =
    agreedTriangles(ParticleNeighbors(whole, {}), ConstrainedEdges(whole), {});
  for (const Triangle& gone : fans.triangles({}))
  {
    for (const int corner : gone)
    {
      Distribution distribution = whole;
      distribution.particles.push_back(Particle(whole.particles[corner]));
      TriangleFans open = fans;
      open.remove(gone);
      open.appendVertex();
      fillHoles(sheet.surface(), ParticleNeighbors(distribution, {}),
        ConstrainedEdges(distribution), distribution, open, {});
      EXPECT_EQ(open.apexOf(gone[0], gone[1]), gone[2]);
    }
  }
}

TEST(HoleFilling, AddsParticlesWhereTheyAreMissing)
{
  FlatSheet sheet({ square }, spacing);
  auto& particles = sheet.distribution.particles;
  const auto isGone = [](const Particle& p)
  { return glm::distance(p.position.xyz, glm::dvec3(0.1, 0.2, 0.0)) < 0.22; };
  // Particles at the border come last, and keep their places behind those that are gone.
  const auto count = std::count_if(particles.begin(), particles.end(), isGone);
  particles.erase(std::remove_if(particles.begin(), particles.end(), isGone), particles.end());
  for (auto& [a, b] : sheet.distribution.edges.segments)
  {
    a -= static_cast<int>(count);
    b -= static_cast<int>(count);
  }
  const Filled filled = fillAfter(sheet, [](TriangleFans&) {});
  expectWhole(sheet, filled);
  EXPECT_GT(count, 10);
  EXPECT_GT(filled.added, 3u);
  for (const Particle& p : particles)
  {
    EXPECT_LE(std::abs(p.position.xyz.z), 1e-9);
  }
  EXPECT_GE(filled.measures.worstMinAngle, 15.0);
}

TEST(HoleFilling, ClosesWhereNoTriangleSuitsAllCorners)
{
  FlatSheet sheet({ square }, spacing);
  const Filled filled = fillAfter(sheet,
    [&](TriangleFans& fans)
    {
      cutOut(sheet.distribution, { 0.1, 0.2, 0.0 }, 0.25, fans);
      // A particle at the border of the hole, as behind a sharp bend.
      const glm::dvec3 place(0.3, 0.2, 0.0);
      auto& particles = sheet.distribution.particles;
      const auto bent = std::min_element(particles.begin(), particles.end(),
        [&](const Particle& a, const Particle& b)
        { return glm::distance(a.position.xyz, place) < glm::distance(b.position.xyz, place); });
      bent->normal.xyz = { 0.92, 0.0, -0.4 };
    });
  EXPECT_EQ(filled.measures.badEdges, 0);
  EXPECT_EQ(filled.measures.badVertices, 0);
  EXPECT_EQ(filled.measures.holeEdges, 0);
  EXPECT_EQ(filled.measures.unusedParticles, 0);
  EXPECT_GT(filled.measures.turnedTriangles, 0);
  EXPECT_NEAR(filled.measures.area, sheet.area(), 1e-9);
}

TEST(HoleFilling, LeavesOpenWhereTheSurfaceDoesNotGoOn)
{
  // The surface is z = 0 in the cube; here particles claim that it goes on in a bump of a height of five spacings.
  FlatSheet sheet({ square }, spacing);
  for (Particle& p : sheet.distribution.particles)
  {
    const double r = glm::length(p.position.xyz);
    p.position.xyz.z = r < 0.3 ? 0.5 : 0.0;
  }
  const Filled filled = fillAfter(sheet, [](TriangleFans&) {});
  EXPECT_EQ(filled.measures.badEdges, 0);
  EXPECT_GT(filled.measures.holeEdges, 0);
  EXPECT_EQ(filled.added, 0u);
}

} // namespace
} // namespace hop::testing
