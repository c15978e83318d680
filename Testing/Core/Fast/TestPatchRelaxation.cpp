#include "Fast/PatchRelaxation.h"

#include "DistributionMeasures.h"
#include "Kernel/InstructionSet.h"
#include "Kernel/Kernels.h"
#include "Support/Random.h"
#include "Surface/Energy.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

/// Range of a pair in the plane, in units of the spacing: h/beta.
const double range = 1.0 / HexagonalDistance;

Patch patchAt(const glm::dvec3& position, const glm::vec3& normal = { 0, 0, 1 })
{
  Patch patch;
  patch.position = position;
  patch.normal = normal;
  return patch;
}

/// Site of hexagonal packing of spacing 1 in the plane z = 0.
glm::dvec3 latticeSite(int row, int column)
{
  return { column + 0.5 * (row & 1), std::sqrt(0.75) * row, 0.0 };
}

/// Hexagonal packing of spacing 1 around the origin. Particles farther from it than `freeRadius` are fixed.
Buffer<Patch> hexagonalDisk(double freeRadius)
{
  const int rings = static_cast<int>(freeRadius) + 4;
  Buffer<Patch> patches;
  for (int row = -rings; row <= rings; ++row)
  {
    for (int column = -rings; column <= rings; ++column)
    {
      patches.push_back(patchAt(latticeSite(row, column)));
      patches.back().fixed = glm::length(patches.back().position) > freeRadius;
    }
  }
  return patches;
}

/// Moves each particle that is not fixed by up to `amount` along both axes of the plane z = 0.
void perturb(Buffer<Patch>& patches, double amount)
{
  Random random(7);
  for (Patch& patch : patches)
  {
    const glm::dvec3 step(
      amount * (2.0 * random.uniform() - 1.0), amount * (2.0 * random.uniform() - 1.0), 0.0);
    patch.position += patch.fixed ? glm::dvec3(0.0) : step;
  }
}

glm::dvec3 placeAfter(const Buffer<Patch>& patches, const Relaxed& relaxed, std::size_t i)
{
  return patches[i].position + patches[i].step(relaxed.displacements[i]);
}

Relaxed sweep(const Buffer<Patch>& patches, const Sweeps& sweeps)
{
  return relaxOnPatches(patches, sweeps, {}, {});
}

TEST(PatchRelaxation, HexagonalPackingHasTheIdealEnergy)
{
  // A particle and its two rings of neighbours, in every lane. The second ring stands at the end of the range.
  std::vector<kernel::Seen> seen;
  std::vector<std::int32_t> neighbors;
  for (int row = -2; row <= 2; ++row)
  {
    for (int column = -2; column <= 2; ++column)
    {
      const glm::vec3 x(latticeSite(row, column));
      const bool isSelf = row == 0 && column == 0;
      const auto n = static_cast<std::int32_t>(seen.size());
      neighbors.insert(neighbors.end(), isSelf ? 0 : kernel::SweepLanes, n);
      seen.push_back({ { x.x, x.y, x.z }, 1.0f, { 0.0f, 0.0f, 1.0f }, 0.0f });
    }
  }
  kernel::SweepBlock block{};
  const auto self = static_cast<std::int32_t>(seen.size() / 2);
  std::fill_n(block.tangents[0][0], kernel::SweepLanes, 1.0f);
  std::fill_n(block.tangents[1][1], kernel::SweepLanes, 1.0f);
  std::fill_n(block.normal[2], kernel::SweepLanes, 1.0f);
  std::fill_n(block.inverseSpacing, kernel::SweepLanes, 1.0f);
  std::fill_n(block.relaxation, kernel::SweepLanes, 1.0f);
  std::fill_n(block.farthest, kernel::SweepLanes, 0.5f);
  std::fill_n(block.particle, kernel::SweepLanes, self);
  block.count = kernel::SweepLanes;
  block.neighborCount = static_cast<std::int32_t>(neighbors.size()) / kernel::SweepLanes;
  kernel::current().sweep(&block, 1, neighbors.data(), seen.data());
  for (int lane = 0; lane < kernel::SweepLanes; ++lane)
  {
    EXPECT_NEAR(block.energy[lane], idealEnergy(), 1e-5);
    EXPECT_NEAR(block.energy[lane], 6.0 * pairEnergy(HexagonalDistance), 1e-5);
    EXPECT_NEAR(block.moved[0][lane], 0.0f, 1e-6f);
    EXPECT_NEAR(block.moved[1][lane], 0.0f, 1e-6f);
  }
}

TEST(PatchRelaxation, HexagonalPackingStaysWhereItIs)
{
  const Buffer<Patch> patches = hexagonalDisk(6.0);
  for (const glm::vec2& displacement : sweep(patches, { 10 }).displacements)
  {
    EXPECT_LE(glm::length(displacement), 2e-5f);
  }
}

TEST(PatchRelaxation, PerturbedLatticeComesBack)
{
  const Buffer<Patch> lattice = hexagonalDisk(6.0);
  for (const double amount : { 0.05, 0.1, 0.15 })
  {
    Buffer<Patch> patches = lattice;
    perturb(patches, amount);
    const Relaxed relaxed = sweep(patches, { 60 });
    double farthest = 0.0;
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      farthest =
        std::max(farthest, glm::distance(placeAfter(patches, relaxed, i), lattice[i].position));
    }
    EXPECT_LE(farthest, 0.01) << amount;
  }
}

TEST(PatchRelaxation, PairsNearerThanTheRangeMoveApartAlongTheirLine)
{
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.8, -0.6, 0.0));
  for (const double distance : { 0.2, 0.5, 0.9 })
  {
    const Buffer<Patch> patches{ patchAt({ 3.0, 2.0, 1.0 }),
      patchAt(glm::dvec3(3.0, 2.0, 1.0) + distance * direction) };
    const Relaxed relaxed = sweep(patches, { 30 });
    const glm::dvec3 apart = placeAfter(patches, relaxed, 1) - placeAfter(patches, relaxed, 0);
    EXPECT_GT(glm::length(apart), std::min(distance + 0.99, 0.9 * range)) << distance;
    EXPECT_LE(glm::length(apart), range + 1e-3) << distance;
    EXPECT_NEAR(glm::dot(glm::normalize(apart), direction), 1.0, 1e-6) << distance;
  }
}

TEST(PatchRelaxation, PairsBeyondTheRangeStay)
{
  const Buffer<Patch> patches{ patchAt({ 0, 0, 0 }), patchAt({ 1.001 * range, 0, 0 }) };
  for (const glm::vec2& displacement : sweep(patches, { 5 }).displacements)
  {
    EXPECT_EQ(displacement, glm::vec2(0.0f));
  }
}

TEST(PatchRelaxation, RangeIsThatOfTheHarmonicMeanOfTheSpacings)
{
  // Spacings 1 and 2: harmonic mean 4/3.
  const double end = range * 4.0 / 3.0;
  for (const bool isWithin : { false, true })
  {
    Buffer<Patch> patches{ patchAt({ 0, 0, 0 }),
      patchAt({ (isWithin ? 0.9 : 1.001) * end, 0, 0 }) };
    patches[1].spacing = 2.0f;
    for (const glm::vec2& displacement : sweep(patches, { 3 }).displacements)
    {
      EXPECT_EQ(glm::length(displacement) > 1e-4f, isWithin);
    }
  }
}

TEST(PatchRelaxation, FixedParticlesStayAndPushOthers)
{
  Buffer<Patch> patches{ patchAt({ 0, 0, 0 }), patchAt({ 0.6, 0, 0 }) };
  patches[0].fixed = true;
  const Relaxed relaxed = sweep(patches, { 10 });
  EXPECT_EQ(relaxed.displacements[0], glm::vec2(0.0f));
  EXPECT_GT(placeAfter(patches, relaxed, 1).x, 1.0);
  // Where all are fixed nothing moves.
  patches[1].fixed = true;
  EXPECT_EQ(sweep(patches, { 10 }).displacements, std::vector<glm::vec2>(2, glm::vec2(0.0f)));
}

TEST(PatchRelaxation, NoneGoesFartherThanItMay)
{
  Buffer<Patch> patches = hexagonalDisk(6.0);
  perturb(patches, 0.7);
  for (Patch& patch : patches)
  {
    patch.spacing = 1.2f;
  }
  for (const float farthest : { 0.05f, 0.2f, 0.5f })
  {
    float largest = 0.0f;
    for (const glm::vec2& displacement : sweep(patches, { 8, farthest }).displacements)
    {
      largest = std::max(largest, glm::length(displacement));
    }
    EXPECT_NEAR(largest, farthest * 1.2f, 1e-5f);
  }
}

TEST(PatchRelaxation, NoneGoesFartherThanHalfTheRadiusOfCurvature)
{
  // A cylinder of radius 0.4 along the y axis: D = 2.5, so 0.2 at most.
  Buffer<Patch> patches{ patchAt({ 0, 0, 0 }), patchAt({ 0, 0.2, 0 }) };
  for (Patch& patch : patches)
  {
    // Across the axis, whichever way the tangents are turned.
    const auto tangents = tangentsOf(patch.normal);
    const glm::vec2 across(tangents[0].x, tangents[1].x);
    patch.shape = { across.x * across.x / 0.4f, across.x * across.y / 0.4f,
      across.y * across.y / 0.4f };
  }
  for (const glm::vec2& displacement : sweep(patches, { 20 }).displacements)
  {
    EXPECT_NEAR(glm::length(displacement), 0.2f, 1e-5f);
  }
}

TEST(PatchRelaxation, ParticlesMoveOnTheirPatchesNotInTheirPlanes)
{
  // A sphere of radius 2 falls below its tangent plane, towards a fixed particle there, until both are out of range.
  Buffer<Patch> patches{ patchAt({ 0, 0, 0 }), patchAt({ -0.9, 0, -1.2 }) };
  patches[0].shape = { 0.5f, 0.0f, 0.5f };
  patches[1].fixed = true;
  const Relaxed relaxed = sweep(patches, { 2000 });
  const double apart = glm::distance(placeAfter(patches, relaxed, 0), patches[1].position);
  EXPECT_NEAR(apart, range, 0.005 * range);
}

TEST(PatchRelaxation, SheetsTurnedAwayDoNotSeeEachOther)
{
  const auto movedAt = [](double degrees)
  {
    // The second normal turns about the line between the two particles.
    const auto angle = static_cast<float>(glm::radians(degrees));
    const Buffer<Patch> patches{ patchAt({ 0, 0, 0 }),
      patchAt({ 0.5, 0, 0 }, { 0.0f, std::sin(angle), std::cos(angle) }) };
    return glm::length(sweep(patches, { 1, 10.0f }).displacements[0]);
  };
  for (const double degrees : { 91.0, 120.0, 180.0 })
  {
    EXPECT_EQ(movedAt(degrees), 0.0f) << degrees;
  }
  const float whole = movedAt(0.0);
  EXPECT_GT(whole, 0.1f);
  EXPECT_NEAR(movedAt(55.0), whole, 1e-6f);
  EXPECT_LT(movedAt(89.0), 0.1f * whole);
}

TEST(PatchRelaxation, EmptyAndSingleAreLeftAlone)
{
  EXPECT_TRUE(sweep({}, { 5 }).displacements.empty());
  EXPECT_EQ(sweep({ patchAt({ 1, 2, 3 }) }, { 5 }).displacements[0], glm::vec2(0.0f));
}

TEST(PatchRelaxation, GroupsFarFromEachOtherAreAsExactAsOneAlone)
{
  // Single precision about a common origin would be off by more than a spacing.
  Buffer<Patch> near = hexagonalDisk(3.0);
  perturb(near, 0.1);
  Buffer<Patch> both = near;
  for (const Patch& patch : near)
  {
    both.push_back(patch);
    both.back().position.x += 1e9;
  }
  const Relaxed alone = sweep(near, { 5 });
  const Relaxed together = sweep(both, { 5 });
  for (std::size_t i = 0; i < both.size(); ++i)
  {
    EXPECT_LE(
      glm::distance(together.displacements[i], alone.displacements[i % near.size()]), 1e-4f);
  }
}

/// Points of a unit sphere, by rejection in the cube around it, with the patches of that sphere.
Buffer<Patch> randomSphere(int count)
{
  Random random(3);
  Buffer<Patch> patches;
  while (static_cast<int>(patches.size()) < count)
  {
    const glm::dvec3 x(
      2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0);
    if (glm::length(x) <= 1.0 && glm::length(x) > 0.1)
    {
      patches.push_back(patchAt(glm::normalize(x), glm::vec3(glm::normalize(x))));
      patches.back().shape = { 1.0f, 0.0f, 1.0f };
      // Hexagonal packing of as many particles on the sphere.
      patches.back().spacing = static_cast<float>(std::sqrt(4.0 * Pi / (count * std::sqrt(0.75))));
    }
  }
  return patches;
}

TEST(PatchRelaxation, RandomPointsOfASphereBecomeEven)
{
  Buffer<Patch> patches = randomSphere(800);
  for (int round = 0; round < 8; ++round)
  {
    const Relaxed relaxed = sweep(patches, { 12 });
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      const glm::dvec3 place = placeAfter(patches, relaxed, i);
      // Patches leave the sphere by the fourth order of half a spacing.
      EXPECT_NEAR(glm::length(place), 1.0, 1e-5);
      patches[i].position = glm::normalize(place);
      patches[i].normal = glm::vec3(patches[i].position);
    }
  }
  Buffer<Particle> particles(patches.size(), Particle());
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    particles[i].position = { patches[i].position };
    particles[i].normal = { patches[i].position };
    particles[i].spacing = patches[i].spacing;
  }
  const Evenness evenness = measureEvenness(particles);
  EXPECT_GE(evenness.minSpacing, 0.78);
  EXPECT_LE(evenness.variation, 0.04);
  EXPECT_GE(evenness.meanMinAngle, 50.0);
  EXPECT_EQ(evenness.openStars, 0u);
}

TEST(PatchRelaxation, DoesNotDependOnThreads)
{
  const Buffer<Patch> patches = randomSphere(3000);
  const Relaxed first = relaxOnPatches(patches, { 6 }, {}, {});
  for (const int threads : { 2, 3, 8 })
  {
    EXPECT_EQ(
      relaxOnPatches(patches, { 6 }, {}, threadedFor(threads)).displacements, first.displacements);
  }
}

constexpr int side = 400; // 160,000 particles: enough for several tiles

/// Hexagonal packing of spacing 1 in a plane, every particle moved by up to a tenth.
Buffer<Patch> unevenLattice()
{
  Buffer<Patch> patches;
  for (int n = 0; n < side * side; ++n)
  {
    patches.push_back(patchAt(latticeSite(n / side, n % side)));
  }
  perturb(patches, 0.1);
  return patches;
}

/// Root mean square of the errors of the distances between neighbours in a row, away from the border.
double unevenness(const Buffer<Patch>& patches, const Relaxed& relaxed)
{
  double sum = 0.0;
  int count = 0;
  for (int row = 20; row < side - 20; ++row)
  {
    for (int column = 20; column < side - 20; ++column, ++count)
    {
      const int n = row * side + column;
      const double error =
        glm::distance(placeAfter(patches, relaxed, n), placeAfter(patches, relaxed, n + 1)) - 1.0;
      sum += error * error;
    }
  }
  return std::sqrt(sum / count);
}

TEST(PatchRelaxation, EvensOutManyInTilesWhateverTheThreads)
{
  const Buffer<Patch> patches = unevenLattice();
  const Relaxed first = relaxOnPatches(patches, { 6 }, {}, {});
  const Relaxed unmoved{ std::vector<glm::vec2>(patches.size(), glm::vec2(0.0f)), {}, {} };
  EXPECT_LT(unevenness(patches, first), 0.3 * unevenness(patches, unmoved));
  for (const int threads : { 2, 3, 8 })
  {
    EXPECT_EQ(
      relaxOnPatches(patches, { 6 }, {}, threadedFor(threads)).displacements, first.displacements);
  }
}

} // namespace
} // namespace hop::testing
