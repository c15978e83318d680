#include "Fast/GivenNumber.h"

#include "Fast/FastSystem.h"
#include "Fast/PatchDistances.h"
#include "MovingOnSphere.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hop::testing
{
namespace
{

DistributionParameters withCount(std::size_t count)
{
  DistributionParameters parameters;
  parameters.particleCount = static_cast<std::int64_t>(count);
  return parameters;
}

/// Shows the boxes of a system that has found the spacing which goes with a number.
class SpacingOfNumber : public FastSystem
{
public:
  using FastSystem::FastSystem;

  void find() { this->matchSpacing(this->Parameters.particleCount); }
  const std::vector<SurfaceBox>& roughBoxes() const { return this->RoughBoxes; }
  const std::vector<SurfaceBox>& boxes() const { return this->Proxy->boxes(); }
};

/// Twelve planes at right angles to x, one in the middle of each layer of linear elements: an area of 48 in a cube whose
/// diagonal's square is 12. That is more than a number's first guess takes for granted, so that the spacing comes out
/// larger than the one at which the rough proxy was made.
ElementMesh layersOfPlanes()
{
  MeshRecipe recipe;
  recipe.degrees = { 1, 1, 1 };
  recipe.cells = 12;
  recipe.field = [](const glm::dvec3& x) { return std::cos(6.0 * Pi * x.x); };
  return makeMesh(recipe);
}

TEST(GivenNumber, BoxesOfTheRoughProxyAreKeptWhereTheyAreFineEnough)
{
  const ElementMesh mesh = layersOfPlanes();
  SpacingOfNumber system({ &mesh, 0.0, 1e-10 }, withCount(16000), {}, threadedFor(2));
  system.find();
  // At the spacing that was found an element is small enough for one box.
  ASSERT_GT(system.roughBoxes().size(), mesh.elements.size());
  ASSERT_EQ(system.boxes().size(), system.roughBoxes().size());
  for (std::size_t b = 0; b < system.boxes().size(); ++b)
  {
    const SurfaceBox& box = system.boxes()[b];
    const SurfaceBox& rough = system.roughBoxes()[b];
    ASSERT_EQ(box.middle.element, rough.middle.element) << b;
    ASSERT_EQ(box.middle.u.xyz, rough.middle.u.xyz) << b;
  }
}

TEST(GivenNumber, IsReachedFromFewerAndFromMore)
{
  const MovingOnSphere on;
  const auto right = static_cast<std::int64_t>(on.proxy.particleCount());
  for (const std::int64_t start : { right - right / 20, right, right + right / 20 })
  {
    SCOPED_TRACE(start);
    const auto moving = on.relaxed(start);
    matchGivenNumber(withCount(right), {}, *moving, threadedFor(2));
    EXPECT_EQ(static_cast<std::int64_t>(moving->size()), right);
    EXPECT_GE(leastDistance(*moving), MinimumSeparation);
  }
}

TEST(GivenNumber, NothingChangesWhereTheNumberIsRightAndNoneCrowd)
{
  const MovingOnSphere on;
  const auto moving = on.relaxed();
  ASSERT_GE(leastDistance(*moving), MinimumSeparation);
  const auto before = positionsOf(moving->patches());
  matchGivenNumber(withCount(moving->size()), {}, *moving, {});
  EXPECT_EQ(positionsOf(moving->patches()), before);
}

TEST(GivenNumber, CrowdedParticlesAreExchangedForOthersInGaps)
{
  // One particle less, and another one doubled: the number is right, but they do not stand well.
  const MovingOnSphere on;
  const auto moving = on.relaxed();
  const std::size_t count = moving->count();
  const glm::dvec3 gap = moving->patches()[0].position;
  const Buffer<Anchor> anchors{ moving->anchors()[count / 2] };
  Buffer<Patch> patches{ moving->patches()[count / 2] };
  patches[0].position += patches[0].step({ 0.2f * patches[0].spacing, 0.0f });
  std::vector<char> kept(count, 1);
  kept[0] = 0;
  moving->keep(kept);
  moving->add(anchors, patches);
  ASSERT_LT(leastDistance(*moving), 0.3);
  matchGivenNumber(withCount(count), {}, *moving, {});
  EXPECT_EQ(moving->count(), count);
  EXPECT_GE(leastDistance(*moving), MinimumSeparation);
  double nearest = 1.0;
  for (const glm::dvec3& x : positionsOf(moving->patches()))
  {
    nearest = std::min(nearest, glm::distance(x, gap));
  }
  EXPECT_LE(nearest, 0.5 * on.sizing.spacing);
}

TEST(GivenNumber, ParticlesOnBoundaryCurvesCountAndStay)
{
  // Some of the particles are fixed, as if a boundary curve passed there.
  const MovingOnSphere on;
  const auto all = on.relaxed();
  Buffer<Patch> fixed(all->patches().begin(), all->patches().begin() + 10);
  for (Patch& patch : fixed)
  {
    patch.fixed = true;
  }
  // Beside them others, too near.
  const auto moving = on.particles(fixed);
  moving->add(all->anchors(), Buffer<Patch>(all->patches().begin(), all->patches().end()));
  const std::size_t count = all->count();
  matchGivenNumber(withCount(count), fixed, *moving, {});
  EXPECT_EQ(moving->size(), count);
  EXPECT_EQ(moving->count(), count - fixed.size());
  for (std::size_t i = 0; i < fixed.size(); ++i)
  {
    EXPECT_EQ(moving->patches()[moving->count() + i].position, fixed[i].position);
  }
  EXPECT_GE(leastDistance(*moving), MinimumSeparation);
}

} // namespace
} // namespace hop::testing
