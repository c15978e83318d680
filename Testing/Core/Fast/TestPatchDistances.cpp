#include "Fast/PatchDistances.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hop::testing
{
namespace
{

Buffer<Patch> inARow(const std::vector<double>& places)
{
  Buffer<Patch> patches;
  for (const double x : places)
  {
    Patch patch;
    patch.position = { x, 0.0, 0.0 };
    patch.normal = { 0, 0, 1 };
    patches.push_back(patch);
  }
  return patches;
}

using Marks = std::vector<char>;

TEST(PatchDistances, TheFirstOfTwoStays)
{
  const Buffer<Patch> row = inARow({ 0.0, 0.5, 1.0, 2.0 });
  EXPECT_EQ(thinOut(row, { 1, 1, 1, 1 }, 0.6, {}), (Marks{ 1, 0, 1, 1 }));
}

TEST(PatchDistances, PatchesThatAreNoCandidatesPushNoneAside)
{
  const Buffer<Patch> row = inARow({ 0.0, 0.5, 1.0, 2.0 });
  EXPECT_EQ(thinOut(row, { 0, 1, 1, 1 }, 0.6, {}), (Marks{ 0, 1, 0, 1 }));
  EXPECT_EQ(thinOut(row, { 0, 1, 0, 1 }, 0.6, {}), (Marks{ 0, 1, 0, 1 }));
}

TEST(PatchDistances, PatchesBehindTheCandidatesStayWhoeverIsNear)
{
  const Buffer<Patch> row = inARow({ 0.0, 2.0, 0.5 });
  EXPECT_EQ(thinOut(row, { 1, 1 }, 0.6, {}), (Marks{ 0, 1 }));
}

TEST(PatchDistances, SheetsThatAreTurnedAwayAreNotSeen)
{
  Buffer<Patch> row = inARow({ 0.0, 0.1 });
  row[1].normal = { 0, 0, -1 };
  EXPECT_EQ(thinOut(row, { 1, 1 }, 0.6, {}), (Marks{ 1, 1 }));
}

TEST(PatchDistances, AreFarInUnitsOfTheirOwnSpacing)
{
  Buffer<Patch> row = inARow({ 0.5, 0.7, 1.5 });
  EXPECT_EQ(areFarFrom(row, 3, inARow({ 0.0 }), 0.6, {}), (Marks{ 0, 1, 1 }));
  row[1].spacing = 2.0f;
  EXPECT_EQ(areFarFrom(row, 3, inARow({ 0.0 }), 0.6, {}), (Marks{ 0, 0, 1 }));
  EXPECT_EQ(areFarFrom(row, 1, inARow({ 0.0 }), 0.6, {}), Marks{ 0 });
  row[0].normal = { 0, 0, -1 };
  EXPECT_EQ(areFarFrom(row, 1, inARow({ 0.0 }), 0.6, {}), Marks{ 1 });
}

TEST(PatchDistances, AreSeparatedInUnitsOfTheSmallerSpacing)
{
  Buffer<Patch> row = inARow({ 0.0, 0.5, 2.0 });
  EXPECT_EQ(areSeparated(row, 3, 0.6, {}), (Marks{ 0, 0, 1 }));
  row[0].spacing = 0.8f;
  EXPECT_EQ(areSeparated(row, 3, 0.6, {}), (Marks{ 1, 1, 1 }));
}

TEST(PatchDistances, ClearanceIsTheDistanceOfTheNearest)
{
  Buffer<Patch> row = inARow({ 0.0, 0.5, 1.25, 9.0 });
  row[2].spacing = 1.5f;
  const std::vector<double> found = clearances(row, 4, row, 2.0, {});
  const std::vector<double> expected{ 0.5, 0.5, 0.5, 2.0 };
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
  }
}

TEST(PatchDistances, SelectedOnesAreTheFirstThatAreApart)
{
  const Buffer<Patch> row = inARow({ 0.0, 1.0, 2.0, 3.0, 4.0 });
  using Indices = std::vector<int>;
  EXPECT_EQ(selectSeparated(row, { 2, 1, 0, 4, 3 }, 2, 1.5, {}), (Indices{ 2, 0 }));
  EXPECT_EQ(selectSeparated(row, { 2, 1, 0, 4, 3 }, 3, 1.5, {}), (Indices{ 2, 0, 4 }));
  // No others are left that are apart.
  EXPECT_EQ(selectSeparated(row, { 2, 1, 0, 4, 3 }, 4, 1.5, {}), (Indices{ 2, 0, 4, 1 }));
}

TEST(PatchDistances, ParticleCoversTheSamplesOnItsSheetWithinItsSpacing)
{
  const auto isCovered = [](const glm::dvec3& place, const glm::vec3& normal, float shape)
  {
    Buffer<Patch> particle = inARow({ 0.0 });
    particle[0].shape = { shape, 0.0f, shape };
    SurfaceProxy::Sample sample;
    sample.found = true;
    sample.patch.position = place;
    sample.patch.normal = normal;
    return findUncovered({ sample }, particle, {}) == Marks{ 0 };
  };
  const glm::vec3 up(0, 0, 1);
  EXPECT_TRUE(isCovered({ 0.9, 0, 0.05 }, up, 0.0f));
  EXPECT_FALSE(isCovered({ 1.1, 0, 0 }, up, 0.0f));
  EXPECT_FALSE(isCovered({ 0, 0, 0.05 }, -up, 0.0f));
  // Another sheet above it.
  EXPECT_FALSE(isCovered({ 0.2, 0, 0.15 }, up, 0.0f));
  EXPECT_FALSE(isCovered({ 0.1, 0, 0.3 }, up, 0.6f));
  // On a curved patch, which falls by 0.3 t^2, and off a flat one.
  EXPECT_TRUE(isCovered({ 0.9, 0, -0.243 }, up, 0.6f));
  EXPECT_FALSE(isCovered({ 0.9, 0, -0.243 }, up, 0.0f));
}

TEST(PatchDistances, SamplesOffTheSurfaceNeedNoParticle)
{
  const std::vector<SurfaceProxy::Sample> samples(2);
  EXPECT_EQ(findUncovered(samples, {}, {}), (Marks{ 0, 0 }));
}

/// A sample in the plane, at a random place of a square; one of five faces down. Spacings grow along x.
SurfaceProxy::Sample randomSample(Random& random, double width)
{
  SurfaceProxy::Sample sample;
  sample.found = true;
  const double x = random.uniform();
  sample.patch.position = { width * x, width * random.uniform(), 0.0 };
  sample.patch.normal = { 0, 0, random.uniform() < 0.2 ? -1 : 1 };
  sample.patch.spacing = static_cast<float>(1.0 + 0.05 * width * x);
  return sample;
}

std::vector<SurfaceProxy::Sample> randomSamples(std::size_t count, double width)
{
  Random random(5);
  std::vector<SurfaceProxy::Sample> samples;
  for (std::size_t n = 0; n < count; ++n)
  {
    samples.push_back(randomSample(random, width));
  }
  return samples;
}

TEST(PatchDistances, ChosenSamplesCoverAllOthers)
{
  constexpr std::size_t count = 1000;
  const auto samples = randomSamples(count, 20.0);
  std::vector<char> marks(count, 1);
  std::fill_n(&marks[100], 100, 0);
  std::vector<int> expected;
  for (int b = 0; b < static_cast<int>(samples.size()); ++b)
  {
    const auto covers = [&](int other)
    {
      const Patch& patch = samples[other].patch;
      return glm::distance(patch.position, samples[b].patch.position) <= 0.7 * patch.spacing &&
        glm::dot(patch.normal, samples[b].patch.normal) > 0.0f;
    };
    if (marks[b] && std::none_of(expected.begin(), expected.end(), covers))
    {
      expected.push_back(b);
    }
  }
  EXPECT_EQ(chooseUncovered(samples, marks, {}), expected);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_LT(expected.size(), 800u);
}

/// Comparing each with all chosen before would take 10^11 steps.
TEST(PatchDistances, ManyAreChosenInTime)
{
  constexpr std::size_t count = 500'000;
  std::vector<SurfaceProxy::Sample> samples(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    samples[n].patch.position = { static_cast<double>(n), 0.0, 0.0 };
    samples[n].patch.normal = { 0, 0, 1 };
    samples[n].patch.spacing = 1.0f;
  }
  EXPECT_EQ(chooseUncovered(samples, std::vector<char>(count, 1), {}).size(), count);
}

} // namespace
} // namespace hop::testing
