#include "Fast/PatchRelaxation.h"

#include "Support/Random.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

constexpr int side = 400; // 160,000 particles: enough for several tiles

/// Hexagonal packing of spacing 1 in a plane, every particle moved by up to a tenth.
Buffer<Patch> unevenLattice()
{
  Random random(1);
  const auto jitter = [&] { return 0.2 * random.uniform() - 0.1; };
  Buffer<Patch> patches(side * side, Patch());
  for (int n = 0; n < side * side; ++n)
  {
    const int row = n / side;
    const double x = n % side + 0.5 * (row % 2) + jitter();
    patches[n].position = { x, std::sqrt(0.75) * row + jitter(), 0.0 };
    patches[n].normal = { 0.0f, 0.0f, 1.0f };
  }
  return patches;
}

/// Root mean square of what neighbours in a row, away from the border, miss their distance by.
double unevenness(const Buffer<Patch>& patches, const std::vector<glm::vec2>& displacements)
{
  const auto tangents = tangentsOf({ 0.0f, 0.0f, 1.0f });
  const auto placeOf = [&](int n)
  {
    const glm::vec2& t = displacements[n];
    return patches[n].position + glm::dvec3(t.x * tangents[0] + t.y * tangents[1]);
  };
  double sum = 0.0;
  int count = 0;
  for (int row = 20; row < side - 20; ++row)
  {
    for (int column = 20; column < side - 20; ++column, ++count)
    {
      const int n = row * side + column;
      const double miss = glm::distance(placeOf(n), placeOf(n + 1)) - 1.0;
      sum += miss * miss;
    }
  }
  return std::sqrt(sum / count);
}

TEST(PatchRelaxation, EvensOutManyInTilesWhateverTheThreads)
{
  const Buffer<Patch> patches = unevenLattice();
  const Relaxed first = relaxOnPatches(patches, { 6 }, {}, {});
  const double before =
    unevenness(patches, std::vector<glm::vec2>(patches.size(), glm::vec2(0.0f)));
  EXPECT_LT(unevenness(patches, first.displacements), 0.3 * before);
  for (const int threads : { 2, 3, 8 })
  {
    EXPECT_EQ(
      relaxOnPatches(patches, { 6 }, {}, threadedFor(threads)).displacements, first.displacements);
  }
}

} // namespace
} // namespace hop::testing
