#include "Fast/InsertionDeletion.h"

#include "Fast/PatchRelaxation.h"

#include "Surface/Energy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hop::testing
{
namespace
{

/// A hexagonal lattice in the plane z = 0. Particles inside a circle are free, the others fixed. The sizing function
/// is 1 everywhere, whatever the spacing of the lattice.
struct Lattice
{
  Buffer<Patch> patches;

  explicit Lattice(double spacing, double radius = 12.0)
  {
    for (int row = -30; row <= 30; ++row)
    {
      for (int column = -30; column <= 30; ++column)
      {
        Patch patch;
        patch.position =
          spacing * glm::dvec3(column + 0.5 * std::abs(row % 2), std::sqrt(0.75) * row, 0.0);
        patch.normal = { 0, 0, 1 };
        patch.fixed = glm::length(patch.position) > radius;
        this->patches.push_back(patch);
      }
    }
    std::stable_partition(
      this->patches.begin(), this->patches.end(), [](const Patch& patch) { return !patch.fixed; });
  }

  std::ptrdiff_t freeCount() const
  {
    return std::count_if(
      this->patches.begin(), this->patches.end(), [](const Patch& patch) { return !patch.fixed; });
  }

  std::size_t nearest(const glm::dvec3& position) const
  {
    const auto distance = [&](const Patch& patch)
    { return glm::distance(patch.position, position); };
    return std::min_element(this->patches.begin(), this->patches.end(),
             [&](const Patch& a, const Patch& b) { return distance(a) < distance(b); }) -
      this->patches.begin();
  }
};

Relaxed relax(const Lattice& lattice, Balance::Extent extent,
  const std::optional<double>& missing = {}, int sweeps = 3)
{
  return relaxOnPatches(lattice.patches, { sweeps }, { extent, missing }, {});
}

std::ptrdiff_t deletedOf(const Relaxed& relaxed)
{
  return std::count(relaxed.kept.begin(), relaxed.kept.end(), 0);
}

TEST(InsertionDeletion, LeavesAPerfectLatticeAlone)
{
  const Lattice lattice(1.0);
  for (const auto extent : { Balance::None, Balance::Defects, Balance::Everywhere })
  {
    const Relaxed relaxed = relax(lattice, extent, 0.0);
    EXPECT_EQ(deletedOf(relaxed), 0);
    EXPECT_TRUE(relaxed.insertions.empty());
  }
}

TEST(InsertionDeletion, InsertsAndDeletesWhatSpacingsTell)
{
  for (const double spacing : { 0.9, 0.95, 1.05, 1.1 })
  {
    const Lattice lattice(spacing);
    const auto count = static_cast<double>(lattice.freeCount());
    // Given the number, the mean energy of a perfect lattice is corrected to the one of relaxed packings.
    const double missing = (spacing * spacing - 1.0) * count;
    const Relaxed relaxed = relax(lattice, Balance::Everywhere, missing);
    const auto change =
      static_cast<double>(relaxed.insertions.size()) - static_cast<double>(deletedOf(relaxed));
    EXPECT_NEAR(change, missing, 0.1 * std::abs(missing) + 1.0) << spacing;
    EXPECT_EQ(spacing < 1.0 ? relaxed.insertions.size() : deletedOf(relaxed), 0u);
  }
}

TEST(InsertionDeletion, EnergiesAloneTellNearlyAsMuch)
{
  // Relaxed packings have more energy: 6% more, that is 2.5% of the particles.
  for (const double spacing : { 0.9, 1.1 })
  {
    const Lattice lattice(spacing);
    const auto count = static_cast<double>(lattice.freeCount());
    const Relaxed relaxed = relax(lattice, Balance::Everywhere);
    const auto change =
      static_cast<double>(relaxed.insertions.size()) - static_cast<double>(deletedOf(relaxed));
    EXPECT_NEAR(change, (spacing * spacing - 1.0) * count, 0.05 * count) << spacing;
  }
}

TEST(InsertionDeletion, FillsAHole)
{
  // Before anything moves: sweeps would spread so regular a hole.
  Lattice lattice(1.0);
  const glm::dvec3 hole = lattice.patches[lattice.nearest(glm::dvec3(0.0))].position;
  lattice.patches.erase(lattice.patches.begin() + lattice.nearest(hole));
  const SpacedPoints points = spacedPoints(lattice.patches, {});
  const SeenLists lists(points.positions, points.spacings, 2.0, {});
  std::vector<float> energies;
  for (const Patch& patch : lattice.patches)
  {
    const bool isBeside = glm::distance(patch.position, hole) < 1.1;
    energies.push_back(static_cast<float>((isBeside ? 5.0 : 6.0) / 6.0 * idealEnergy()));
  }
  Relaxed relaxed{ std::vector<glm::vec2>(energies.size(), glm::vec2(0.0f)),
    std::vector<char>(energies.size(), 1), {} };
  insertAndDelete(lattice.patches, lists, energies, { Balance::Defects, {} }, {}, relaxed);
  ASSERT_EQ(relaxed.insertions.size(), 1u);
  EXPECT_EQ(deletedOf(relaxed), 0);
  const Insertion& insertion = relaxed.insertions.front();
  const Patch& parent = lattice.patches[insertion.beside];
  const auto tangents = tangentsOf(parent.normal);
  const glm::dvec3 place = parent.position +
    glm::dvec3(insertion.displacement.x * tangents[0] + insertion.displacement.y * tangents[1]);
  EXPECT_LT(glm::distance(place, hole), 0.2);
}

TEST(InsertionDeletion, DeletesOneOfTwoInOnePlace)
{
  Lattice lattice(1.0);
  Patch second = lattice.patches[lattice.nearest(glm::dvec3(0.0))];
  second.position.x += 0.05;
  lattice.patches.insert(lattice.patches.begin(), second);
  const Relaxed relaxed = relax(lattice, Balance::Defects, {}, 1);
  EXPECT_EQ(deletedOf(relaxed), 1);
  const auto deleted =
    std::find(relaxed.kept.begin(), relaxed.kept.end(), 0) - relaxed.kept.begin();
  EXPECT_LT(glm::distance(lattice.patches[deleted].position, second.position), 0.1);
  EXPECT_EQ(deletedOf(relax(lattice, Balance::None, {}, 1)), 0);
}

TEST(InsertionDeletion, TwoInOnePlaceTellNothingAboutOtherPlaces)
{
  // All neighbours of two particles in one place have an energy out of all proportion.
  const Lattice lattice(1.0);
  const SpacedPoints points = spacedPoints(lattice.patches, {});
  const SeenLists lists(points.positions, points.spacings, 2.0, {});
  std::vector<float> energies;
  for (const Patch& patch : lattice.patches)
  {
    const bool isNear = glm::length(patch.position) < 1.1;
    energies.push_back(static_cast<float>((isNear ? 50.0 : 1.06) * idealEnergy()));
  }
  Relaxed relaxed{ std::vector<glm::vec2>(energies.size(), glm::vec2(0.0f)),
    std::vector<char>(energies.size(), 1), {} };
  insertAndDelete(lattice.patches, lists, energies, { Balance::Everywhere, {} }, {}, relaxed);
  EXPECT_TRUE(relaxed.insertions.empty());
  EXPECT_LE(deletedOf(relaxed), 5);
}

} // namespace
} // namespace hop::testing
