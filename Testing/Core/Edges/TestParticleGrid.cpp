#include "Edges/ParticleGrid.h"

#include "Common/SplatProfile.h"
#include "ElementCases.h"
#include "Support/Random.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

constexpr std::size_t freeCount = 500;
constexpr std::size_t boundaryCount = 200;

/// Somewhere in a cube; spacings differ by less than a factor of two, as gradation sees to.
Particle randomParticle(Random& random)
{
  Particle particle;
  particle.position = { randomVector(random) };
  particle.spacing = 0.1 * (1.0 + 0.9 * random.uniform());
  return particle;
}

struct Particles
{
  Particles()
  {
    Random random(7);
    for (std::size_t i = 0; i < freeCount; ++i)
    {
      this->free.push_back(randomParticle(random));
    }
    for (std::size_t i = 0; i < boundaryCount; ++i)
    {
      this->onBoundary.push_back({ randomParticle(random), {}, {}, {} });
    }
  }

  Buffer<Particle> free;
  Buffer<BoundaryParticle> onBoundary;
};

TEST(ParticleGrid, NumbersFreeParticlesFirst)
{
  Particles particles;
  const ParticleGrid grid(particles.free, particles.onBoundary, {});
  ASSERT_EQ(grid.size(), freeCount + boundaryCount);
  EXPECT_EQ(&grid.boundaryParticles(), &particles.onBoundary);
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    const Particle& expected =
      i < freeCount ? particles.free[i] : particles.onBoundary[i - freeCount].particle;
    EXPECT_EQ(&grid.at(i), &expected);
    EXPECT_EQ(grid.position(static_cast<int>(i)), expected.position.xyz);
    EXPECT_EQ(grid.spacing(static_cast<int>(i)), static_cast<float>(expected.spacing));
  }
}

TEST(ParticleGrid, ReachesAsFarAsSplatsOverlap)
{
  EXPECT_GE(ParticleGrid::Reach, 2.0 * splatReach());
  EXPECT_LT(ParticleGrid::Reach, 2.01 * splatReach());
}

TEST(ParticleGrid, FindsAllParticlesWithinReach)
{
  Particles particles;
  const ParticleGrid grid(particles.free, particles.onBoundary, threadedFor(3));
  std::size_t within = 0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    const Particle& particle = grid.at(i);
    std::vector<int> visited(grid.size(), 0);
    grid.visit(particle.position.xyz, particle.spacing, [&](int j) { ++visited[j]; });
    for (std::size_t j = 0; j < grid.size(); ++j)
    {
      const Particle& other = grid.at(j);
      const double mean =
        2.0 * particle.spacing * other.spacing / (particle.spacing + other.spacing);
      const bool isWithin = length(other.position - particle.position) < ParticleGrid::Reach * mean;
      within += isWithin;
      found += visited[j];
      EXPECT_LE(visited[j], 1);
      EXPECT_TRUE(visited[j] == 1 || !isWithin) << i << " " << j;
    }
  }
  // Not by visiting all.
  EXPECT_GT(within, 4 * grid.size());
  EXPECT_LT(found, grid.size() * grid.size() / 4);
}

} // namespace
} // namespace hop::testing
