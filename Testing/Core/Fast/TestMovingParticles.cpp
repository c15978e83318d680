#include "Fast/MovingParticles.h"

#include "AnalyticFields.h"
#include "SurfaceSeeds.h"
#include "TestMeshes.h"
#include "ThreadedFor.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

constexpr double spacing = 0.2;

ElementMesh sphereMesh()
{
  MeshRecipe recipe;
  recipe.domain = Domain::Hexahedron;
  recipe.degrees = { 3, 3, 3 };
  recipe.cells = 3;
  recipe.map = wavyMap(0.1);
  recipe.field = sphere({ 0, 0, 0 }, 0.7).field;
  return makeMesh(recipe);
}

/// Particles at seeds, and three patches on boundary curves, which are recognized by their shape.
class Moving : public ::testing::Test
{
protected:
  Moving()
  {
    for (int i = 0; i < 3; ++i)
    {
      this->BoundaryPatches.emplace_back();
      this->BoundaryPatches.back().shape[0] = 100.0f + static_cast<float>(i);
    }
    this->Particles = std::make_unique<MovingParticles>(
      this->Surface, this->Proxy, this->BoundaryPatches, threadedFor(2));
    this->Particles->add(
      this->Proxy.seeds(std::llround(this->Proxy.particleCount()), 0.5, threadedFor(2)));
  }

  void expectBoundaryPatchesLast() const
  {
    const Buffer<Patch>& patches = this->Particles->patches();
    ASSERT_EQ(this->Particles->size(), this->Particles->count() + 3);
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_EQ(patches[this->Particles->count() + i].shape[0], this->BoundaryPatches[i].shape[0]);
    }
  }

  ElementMesh Mesh = sphereMesh();
  Isosurface Surface{ &Mesh, 0.0, 1e-9 };
  SurfaceProxy Proxy{ Surface, { spacing, 0.0 }, findSurfaceBoxes(Mesh, 0.0, spacing, {}), {} };
  Buffer<Patch> BoundaryPatches;
  std::unique_ptr<MovingParticles> Particles;
};

std::vector<glm::dvec3> positionsOf(const MovingParticles& moving)
{
  std::vector<glm::dvec3> positions;
  for (std::size_t i = 0; i < moving.count(); ++i)
  {
    positions.push_back(moving.patches()[i].position);
  }
  return positions;
}

TEST_F(Moving, KeptParticlesStayAsTheyAre)
{
  const std::vector<glm::dvec3> before = positionsOf(*this->Particles);
  ASSERT_GT(before.size(), 50u);
  // Marks of particles on boundary curves count for nothing.
  std::vector<char> kept(this->Particles->size(), 0);
  std::vector<glm::dvec3> expected;
  for (std::size_t i = 0; i < before.size(); i += 3)
  {
    kept[i] = 1;
    expected.push_back(before[i]);
  }
  kept.back() = 1;
  this->Particles->keep(kept);
  EXPECT_EQ(positionsOf(*this->Particles), expected);
  this->expectBoundaryPatchesLast();
  for (std::size_t i = 0; i < this->Particles->count(); ++i)
  {
    const Location& place = this->Particles->anchors()[i].place;
    EXPECT_LT(glm::distance(positionAt(this->Mesh, place), expected[i]), spacing);
  }
}

TEST_F(Moving, AddedParticlesComeBeforeBoundaryPatches)
{
  const std::size_t count = this->Particles->count();
  const Buffer<Anchor> anchors{ this->Particles->anchors()[7] };
  const Buffer<Patch> patches{ this->Particles->patches()[7] };
  this->Particles->add(anchors, patches);
  ASSERT_EQ(this->Particles->count(), count + 1);
  EXPECT_EQ(this->Particles->patches()[count].position, patches[0].position);
  this->expectBoundaryPatchesLast();
}

TEST_F(Moving, StepsEndOnTheSurfaceSortedByElement)
{
  const std::size_t count = this->Particles->count();
  std::vector<char> kept(count, 1);
  kept[0] = kept[count / 2] = 0;
  const std::vector<glm::vec2> displacements(
    count, { 0.3f * static_cast<float>(spacing), 0.1f * static_cast<float>(spacing) });
  this->Particles->commit(displacements, kept);
  EXPECT_EQ(this->Particles->count(), count - 2);
  this->expectBoundaryPatchesLast();
  int last = 0;
  for (std::size_t i = 0; i < this->Particles->count(); ++i)
  {
    EXPECT_LE(last, this->Particles->anchors()[i].place.element);
    last = this->Particles->anchors()[i].place.element;
    EXPECT_NEAR(glm::length(this->Particles->patches()[i].position), 0.7, 0.02);
  }
}

} // namespace
} // namespace hop::testing
