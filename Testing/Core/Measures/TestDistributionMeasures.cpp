#include "DistributionMeasures.h"

#include "PointGrid.h"
#include "Support/Random.h"
#include "Surface/Energy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

Particle particleAt(const glm::dvec3& position, const glm::dvec3& normal, double spacing)
{
  Particle particle;
  particle.position = { position };
  particle.normal = { normal };
  particle.spacing = spacing;
  return particle;
}

/// Hexagonal packing at distance `distance`, in a tilted plane, out to a hexagon of `rings` rings
/// around the first particle; the last 6 `rings` particles are its border.
Buffer<Particle> hexagonalLattice(int rings, double distance, double spacing)
{
  const glm::dvec3 e1 = glm::normalize(glm::dvec3(1.0, 2.0, -0.5));
  const glm::dvec3 normal = glm::normalize(glm::cross(e1, glm::dvec3(0.3, 0.1, 1.0)));
  const glm::dvec3 e2 = 0.5 * e1 + 0.5 * std::sqrt(3.0) * glm::cross(normal, e1);
  Buffer<Particle> particles;
  for (int ring = 0; ring <= rings; ++ring)
  {
    for (int i = -ring; i <= ring; ++i)
    {
      for (int j = -ring; j <= ring; ++j)
      {
        if (std::max({ std::abs(i), std::abs(j), std::abs(i + j) }) == ring)
        {
          particles.push_back(
            particleAt(distance * (double(i) * e1 + double(j) * e2), normal, spacing));
        }
      }
    }
  }
  return particles;
}

Buffer<Particle> squareLattice(int rows)
{
  Buffer<Particle> particles;
  for (int n = 0; n < rows * rows; ++n)
  {
    // Sheared by a little, so that no four lie on a circle.
    const glm::dvec2 at(n % rows + 1e-3 * (n / rows), n / rows);
    particles.push_back(particleAt({ at, 0.0 }, { 0, 0, 1 }, 1.0));
  }
  return particles;
}

/// A golden-angle spiral on the unit sphere.
Buffer<Particle> spiral(int count, double spacing)
{
  Buffer<Particle> particles;
  for (int n = 0; n < count; ++n)
  {
    const double z = 1.0 - (2.0 * n + 1.0) / count;
    const double angle = n * Pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    const glm::dvec3 x(r * std::cos(angle), r * std::sin(angle), z);
    particles.push_back(particleAt(x, x, spacing));
  }
  return particles;
}

TEST(DistributionMeasures, HexagonalLatticeIsPerfect)
{
  for (const double scale : { 1e-3, 1.0, 500.0 })
  {
    SCOPED_TRACE(scale);
    const Evenness evenness = measureEvenness(hexagonalLattice(6, scale, scale));
    EXPECT_NEAR(evenness.minSpacing, 1.0, 1e-12);
    EXPECT_NEAR(evenness.variation, 0.0, 1e-6);
    EXPECT_EQ(evenness.sixValentShare, 1.0);
    EXPECT_NEAR(evenness.circumradius, 1.0 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(evenness.meanMinAngle, 60.0, 1e-9);
    EXPECT_NEAR(evenness.worstMinAngle, 60.0, 1e-6);
    EXPECT_EQ(evenness.openStars, 6u * 6u);
  }
}

TEST(DistributionMeasures, AreInUnitsOfTheSpacing)
{
  // Particles at 0.9 of their spacing.
  const Evenness evenness = measureEvenness(hexagonalLattice(4, 0.9, 1.0));
  EXPECT_NEAR(evenness.minSpacing, 0.9, 1e-12);
  EXPECT_NEAR(evenness.circumradius, 0.9 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(evenness.meanMinAngle, 60.0, 1e-9);
}

TEST(DistributionMeasures, SquareLattice)
{
  // Diagonals split the squares: six neighbours, halves of squares.
  const Evenness evenness = measureEvenness(squareLattice(10));
  EXPECT_EQ(evenness.sixValentShare, 1.0);
  EXPECT_NEAR(evenness.circumradius, 1.0 / std::sqrt(2.0), 2e-3);
  EXPECT_NEAR(evenness.meanMinAngle, 45.0, 0.1);
  EXPECT_NEAR(evenness.worstMinAngle, 45.0, 0.1);
}

TEST(DistributionMeasures, VariationIsThatOfNearestDistances)
{
  // Pairs at distance 1 and pairs at distance 2: mean 1.5, deviation 0.5.
  Buffer<Particle> particles;
  for (int n = 0; n < 10; ++n)
  {
    particles.push_back(particleAt({ 10.0 * n, 0, 0 }, { 0, 0, 1 }, 1.0));
    particles.push_back(particleAt({ 10.0 * n + 1.0 + n % 2, 0, 0 }, { 0, 0, 1 }, 1.0));
  }
  const Evenness evenness = measureEvenness(particles);
  EXPECT_NEAR(evenness.minSpacing, 1.0, 1e-12);
  EXPECT_NEAR(evenness.variation, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(evenness.openStars, particles.size());
  EXPECT_EQ(evenness.sixValentShare, 0.0);
  // One that stands alone does not count.
  particles.push_back(particleAt({ -10.0, 0, 0 }, { 0, 0, 1 }, 1.0));
  EXPECT_NEAR(measureEvenness(particles).variation, 1.0 / 3.0, 1e-12);
}

TEST(DistributionMeasures, MissingParticleLeavesAHole)
{
  Buffer<Particle> particles = hexagonalLattice(5, 1.0, 1.0);
  const Particle middle = particles.front();
  const Evenness whole = measureEvenness(particles);
  particles.erase(particles.begin());
  const Evenness holed = measureEvenness(particles);
  // Its six neighbours form a regular hexagon: triangles in it have circumradius 1.
  EXPECT_EQ(holed.openStars, whole.openStars);
  EXPECT_NEAR(holed.circumradius, 1.0, 1e-9);
  EXPECT_NEAR(holed.worstMinAngle, 30.0, 1e-6);
  EXPECT_LT(holed.sixValentShare, 1.0);
  EXPECT_NEAR(coverageRadius(particles, { middle.position.xyz }), 1.0, 1e-12);
}

TEST(DistributionMeasures, ParticlesThatDoNotCountAreNeighborsStill)
{
  // Two particles in the middle are too near to each other.
  Buffer<Particle> particles = hexagonalLattice(6, 1.0, 1.0);
  const glm::dvec3 middle = particles.front().position.xyz;
  particles.push_back(
    particleAt(0.3 * particles[1].position.xyz, particles.front().normal.xyz, 1.0));
  const auto isOutOfTheMiddle = [&](const Particle& p)
  { return glm::distance(p.position.xyz, middle) > 2.5; };
  const Evenness outside = measureEvenness(particles, isOutOfTheMiddle);
  EXPECT_NEAR(measureEvenness(particles).minSpacing, 0.3, 1e-12);
  EXPECT_NEAR(outside.minSpacing, 1.0, 1e-12);
  EXPECT_EQ(outside.sixValentShare, 1.0);
  EXPECT_EQ(outside.openStars, 6u * 6u);
  EXPECT_EQ(measureEvenness(particles, [](const Particle&) { return false; }).openStars, 0u);
}

TEST(DistributionMeasures, WideHoleOpensStars)
{
  Buffer<Particle> particles = hexagonalLattice(6, 1.0, 1.0);
  const Evenness whole = measureEvenness(particles);
  const glm::dvec3 middle = particles.front().position.xyz;
  particles.erase(std::remove_if(particles.begin(), particles.end(),
                    [&](const Particle& p) { return glm::distance(p.position.xyz, middle) < 1.1; }),
    particles.end());
  EXPECT_GT(measureEvenness(particles).openStars, whole.openStars);
}

TEST(DistributionMeasures, OppositeAndParallelSheetsDoNotCount)
{
  Buffer<Particle> sheets = hexagonalLattice(5, 1.0, 1.0);
  const Evenness alone = measureEvenness(sheets);
  const std::size_t count = sheets.size();
  const glm::dvec3 normal = sheets.front().normal.xyz;
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 x = sheets[i].position.xyz + 0.3 * sheets[1].position.xyz;
    sheets.push_back(particleAt(x + 0.1 * normal, -normal, 1.0));
    sheets.push_back(particleAt(x + 1.2 * normal, normal, 1.0));
  }
  const Evenness together = measureEvenness(sheets);
  EXPECT_NEAR(together.minSpacing, 1.0, 1e-12);
  EXPECT_NEAR(together.worstMinAngle, 60.0, 1e-6);
  EXPECT_EQ(together.openStars, 3 * alone.openStars);
}

TEST(DistributionMeasures, StarsOfAClosedSurfaceTriangulateIt)
{
  // Euler: the valences of a sphere's triangulation sum up to 6 n - 12.
  const Buffer<Particle> particles =
    spiral(2000, std::sqrt(4.0 * Pi / 2000 * 2.0 / std::sqrt(3.0)));
  int valences = 0;
  for (const Star& star : delaunayStars(particles))
  {
    EXPECT_TRUE(star.closed);
    valences += star.valence;
  }
  EXPECT_NEAR(valences, 6 * 2000 - 12, 12);
}

TEST(DistributionMeasures, CoverageOfASphereByProbesIsThatOfItsTriangles)
{
  const Buffer<Particle> particles = spiral(1000, 0.11);
  Random random(3);
  std::vector<glm::dvec3> probes;
  while (probes.size() < 100000)
  {
    const glm::dvec3 x =
      2.0 * glm::dvec3(random.uniform(), random.uniform(), random.uniform()) - 1.0;
    if (glm::length(x) <= 1.0 && glm::length(x) > 0.1)
    {
      probes.push_back(glm::normalize(x));
    }
  }
  const double coverage = coverageRadius(particles, probes);
  const double circumradius = measureEvenness(particles).circumradius;
  EXPECT_LE(coverage, circumradius + 0.005); // the bulge of the sphere
  EXPECT_GE(coverage, circumradius - 0.04);  // probes are 0.1 spacings apart
}

TEST(DistributionMeasures, FewParticles)
{
  EXPECT_EQ(measureEvenness({}).minSpacing, 0.0);
  EXPECT_EQ(measureEvenness({ particleAt({ 0, 0, 0 }, { 0, 0, 1 }, 1.0) }).openStars, 0u);
  EXPECT_EQ(coverageRadius({}, {}), 0.0);
  EXPECT_TRUE(std::isinf(coverageRadius({}, { glm::dvec3(0.0) })));
  const Buffer<Particle> turned{ particleAt({ 0, 0, 0 }, { 0, 0, 1 }, 1.0),
    particleAt({ 0, 0, 0.5 }, { 0, 0, -1 }, 1.0) };
  EXPECT_TRUE(std::isinf(nearestSpacings(turned).front()));
}

TEST(DistributionMeasures, NearestSpacingIsFoundAtAnyDistance)
{
  Random random(5);
  Buffer<Particle> particles;
  for (int n = 0; n < 300; ++n)
  {
    const glm::dvec3 x(random.uniform(), random.uniform(), random.uniform());
    particles.push_back(particleAt(x, { 0, 0, random.uniform() < 0.5 ? 1 : -1 }, 1e-3 + x.x));
  }
  const std::vector<double> nearest = nearestSpacings(particles);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    double expected = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < particles.size(); ++j)
    {
      if (i != j && particles[i].normal.xyz.z == particles[j].normal.xyz.z)
      {
        expected = std::min(expected, length(particles[i].position - particles[j].position));
      }
    }
    ASSERT_EQ(nearest[i], expected / particles[i].spacing);
  }
}

TEST(PointGrid, FindsWhatIsWithinARadius)
{
  Random random(7);
  std::vector<glm::dvec3> points;
  for (int n = 0; n < 500; ++n)
  {
    points.emplace_back(random.uniform(), random.uniform(), -random.uniform());
  }
  const PointGrid grid(points, 0.07);
  for (const double radius : { 0.01, 0.1, 0.4, 10.0 })
  {
    const glm::dvec3 place(0.5, 0.2, -0.7);
    std::vector<int> expected;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (glm::distance(points[i], place) <= radius)
      {
        expected.push_back(static_cast<int>(i));
      }
    }
    EXPECT_EQ(grid.within(place, radius), expected);
  }
}

} // namespace
} // namespace hop::testing
