#include "Mesh/Slivers.h"

#include "FlatSheet.h"
#include "Mesh/SurfaceMesh.h"
#include "MeshMeasures.h"

#include <gtest/gtest.h>

#include <numeric>

namespace hop::testing
{
namespace
{

using Corners = std::array<int, 3>;

std::vector<int> eachAlone(std::size_t count)
{
  std::vector<int> vertices(count);
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

/// A sheet with a mesh, whose particles are moved before slivers are removed.
struct Sheet
{
  FlatSheet sheet{ { { { -0.8, -0.8 }, { 0.8, -0.8 }, { 0.8, 0.8 }, { -0.8, 0.8 } } }, 0.1 };
  Buffer<Particle>& particles = sheet.distribution.particles;
  std::vector<Corners> triangles;
  std::vector<int> vertices;

  Sheet()
  {
    this->triangles = meshSurface(this->sheet.surface(), ConstrainedEdges(this->sheet.distribution),
      this->sheet.distribution, {}, {})
                        .triangles;
    this->vertices = eachAlone(this->particles.size());
  }

  int nearest(const glm::dvec3& place) const
  {
    const auto distanceOf = [&](const Particle& p) { return glm::distance(p.position.xyz, place); };
    return static_cast<int>(
      std::min_element(this->particles.begin(), this->particles.end(),
        [&](const Particle& a, const Particle& b) { return distanceOf(a) < distanceOf(b); }) -
      this->particles.begin());
  }

  void move(int particle, const glm::dvec3& place)
  {
    this->particles[particle].position = { place };
    this->particles[particle].location.u = { 0.5 * (place + 1.0) };
  }

  /// Least of the heights of triangles, in spacings.
  double leastHeight() const
  {
    double least = 1.0;
    for (const Corners& triangle : this->triangles)
    {
      const auto at = [&](int i) { return this->particles[triangle[i % 3]].position.xyz; };
      const double twice = glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
      const double longest = std::max(
        { glm::distance(at(0), at(1)), glm::distance(at(1), at(2)), glm::distance(at(2), at(0)) });
      least = std::min(least, twice / longest / 0.1);
    }
    return least;
  }

  MeshMeasures remove()
  {
    removeSlivers(
      ConstrainedEdges(this->sheet.distribution), this->particles, this->vertices, this->triangles);
    for (std::size_t p = 0; p < this->vertices.size(); ++p)
    {
      if (this->vertices[p] != static_cast<int>(p))
      {
        this->sheet.distribution.edges.coincident.push_back(
          { this->vertices[p], static_cast<int>(p) });
      }
    }
    return measureMesh(this->sheet.distribution, this->triangles);
  }
};

void expectWhole(const Sheet& sheet, const MeshMeasures& measures)
{
  EXPECT_EQ(measures.badEdges, 0);
  EXPECT_EQ(measures.badVertices, 0);
  EXPECT_EQ(measures.turnedTriangles, 0);
  EXPECT_EQ(measures.unusedParticles, 0);
  EXPECT_EQ(measures.eulerCharacteristic, 1);
  EXPECT_NEAR(measures.area, sheet.sheet.area(), 1e-9);
  EXPECT_GT(sheet.leastHeight(), 0.05);
}

TEST(Slivers, ShortEdgesAreContracted)
{
  Sheet sheet;
  const std::size_t before = sheet.triangles.size();
  const int one = sheet.nearest({ 0.2, 0.1, 0.0 });
  const int other = sheet.nearest(sheet.particles[one].position.xyz + glm::dvec3(0.1, 0.0, 0.0));
  ASSERT_NE(one, other);
  sheet.move(other, sheet.particles[one].position.xyz + glm::dvec3(0.002, 0.001, 0.0));
  ASSERT_LT(sheet.leastHeight(), 0.05);
  expectWhole(sheet, sheet.remove());
  EXPECT_EQ(sheet.triangles.size(), before - 2);
  EXPECT_EQ(sheet.vertices[one], sheet.vertices[other]);
  EXPECT_EQ(sheet.particles[one].position.xyz, sheet.particles[other].position.xyz);
}

TEST(Slivers, ParticlesOnBoundaryCurvesStay)
{
  Sheet sheet;
  const int inside = sheet.nearest({ 0.1, -0.73, 0.0 });
  const int end = sheet.nearest({ 0.1, -0.8, 0.0 });
  const glm::dvec3 place = sheet.particles[end].position.xyz;
  sheet.move(inside, place + glm::dvec3(0.0, 0.003, 0.0));
  expectWhole(sheet, sheet.remove());
  EXPECT_EQ(sheet.vertices[inside], end);
  EXPECT_EQ(sheet.particles[end].position.xyz, place);
}

TEST(Slivers, EdgesWithACornerOnThemAreFlipped)
{
  Sheet sheet;
  const std::size_t before = sheet.triangles.size();
  const int one = sheet.nearest({ -0.2, 0.3, 0.0 });
  // Two neighbours side by side: onto the middle of their edge.
  const glm::dvec3 place = sheet.particles[one].position.xyz;
  const int a = sheet.nearest(place + glm::dvec3(0.05, 0.087, 0.0));
  const int b = sheet.nearest(place + glm::dvec3(-0.05, 0.087, 0.0));
  sheet.move(one, 0.5 * (sheet.particles[a].position.xyz + sheet.particles[b].position.xyz));
  ASSERT_LT(sheet.leastHeight(), 1e-9);
  expectWhole(sheet, sheet.remove());
  EXPECT_EQ(sheet.triangles.size(), before);
}

TEST(Slivers, TrianglesAtTheEndOfAMeshGo)
{
  Sheet sheet;
  const std::size_t before = sheet.triangles.size();
  const int inside = sheet.nearest({ 0.1, -0.73, 0.0 });
  const glm::dvec3 place = sheet.particles[inside].position.xyz;
  const int left = sheet.nearest({ place.x - 0.05, -0.8, 0.0 });
  const int right = sheet.nearest({ place.x + 0.05, -0.8, 0.0 });
  ASSERT_NE(left, right);
  sheet.move(
    inside, 0.5 * (sheet.particles[left].position.xyz + sheet.particles[right].position.xyz));
  expectWhole(sheet, sheet.remove());
  EXPECT_EQ(sheet.triangles.size(), before - 1);
}

/// Three curves of particles that have come to lie on one line: rows of flat triangles on each other.
TEST(Slivers, RowsOfFlatTrianglesGo)
{
  Sheet sheet;
  for (Particle& particle : sheet.particles)
  {
    glm::dvec3& x = particle.position.xyz;
    x.y = std::abs(x.y) < 0.18 ? 0.0 : x.y;
  }
  ASSERT_LT(sheet.leastHeight(), 1e-9);
  expectWhole(sheet, sheet.remove());
}

TEST(Slivers, TheTopologyStays)
{
  // Neither of a small tetrahedron nor of a small triangle may an edge be contracted.
  const double s = 1e-3;
  Buffer<Particle> particles = particlesAt({ { 0, 0 }, { s, 0 }, { 0, s }, { s, s } });
  particles[3].position.xyz.z = s;
  for (Particle& particle : particles)
  {
    particle.normal.xyz =
      glm::normalize(particle.position.xyz - glm::dvec3(0.4 * s, 0.4 * s, 0.2 * s));
  }
  const std::vector<Corners> tetrahedron{ { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  for (const std::vector<Corners>& before : { tetrahedron, std::vector<Corners>{ { 0, 1, 2 } } })
  {
    std::vector<Corners> triangles = before;
    std::vector<int> vertices = eachAlone(particles.size());
    removeSlivers(ConstrainedEdges(Distribution{}), particles, vertices, triangles);
    EXPECT_EQ(triangles, before);
    EXPECT_EQ(vertices, eachAlone(particles.size()));
  }
}

} // namespace
} // namespace hop::testing
