#include "Fast/PackingRepair.h"

#include "MovingOnSphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hop::testing
{
namespace
{

/// Nearest pairs that are no defects, as the packing's repair has it, and a little less, as the last round may leave.
constexpr double least = 0.8;

/// An even packing, and one particle more beside another.
struct Crowded
{
  MovingOnSphere on;
  std::unique_ptr<MovingParticles> moving = on.relaxed();
  glm::dvec3 place{ 0.0 };

  Crowded()
  {
    repairPacking(*this->moving, {});
    const Buffer<Anchor> anchors{ this->moving->anchors()[3] };
    Buffer<Patch> patches{ this->moving->patches()[3] };
    this->place = patches[0].position;
    patches[0].position += patches[0].step({ 0.1f * patches[0].spacing, 0.0f });
    this->moving->add(anchors, patches);
  }
};

using Place = std::array<double, 3>;

std::set<Place> placesOf(const MovingParticles& moving)
{
  std::set<Place> places;
  for (const glm::dvec3& x : positionsOf(moving.patches()))
  {
    places.insert({ x.x, x.y, x.z });
  }
  return places;
}

/// Distance, in spacings, of the farthest particle that is not where one was before.
double reachOfChange(const Crowded& crowded, const std::set<Place>& before)
{
  double reach = 0.0;
  for (const glm::dvec3& x : positionsOf(crowded.moving->patches()))
  {
    if (before.count({ x.x, x.y, x.z }) == 0)
    {
      reach = std::max(reach, glm::distance(x, crowded.place) / crowded.on.sizing.spacing);
    }
  }
  return reach;
}

TEST(PackingRepair, EvenPackingIsLeftAlone)
{
  const MovingOnSphere on;
  const auto moving = on.relaxed();
  repairPacking(*moving, {});
  ASSERT_GE(leastDistance(*moving), least);
  const auto before = positionsOf(moving->patches());
  repairPacking(*moving, {});
  EXPECT_EQ(positionsOf(moving->patches()), before);
}

TEST(PackingRepair, OneTooManyIsMadeRoomForOrDeleted)
{
  Crowded crowded;
  ASSERT_LT(leastDistance(*crowded.moving), 0.2);
  const std::size_t count = crowded.moving->count();
  repairPacking(*crowded.moving, {});
  EXPECT_GE(leastDistance(*crowded.moving), least);
  EXPECT_GE(crowded.moving->count(), count - 1);
  EXPECT_LE(crowded.moving->count(), count);
}

TEST(PackingRepair, LeavesCrowdsOutsideOfASlabAlone)
{
  Crowded crowded;
  const glm::dvec3 along(1.0, 0.0, 0.0);
  const double place = glm::dot(along, crowded.place);
  const double reach = crowded.on.sizing.spacing;
  const std::set<Place> before = placesOf(*crowded.moving);
  repairPacking(*crowded.moving, {}, { along, place + reach, place + 2.0 * reach });
  EXPECT_EQ(placesOf(*crowded.moving), before);
  repairPacking(*crowded.moving, {}, { along, place - reach, place + reach });
  EXPECT_GE(leastDistance(*crowded.moving), least);
}

TEST(PackingRepair, RelaxesAroundPlacesOnly)
{
  for (const double reach : { 1.5, 3.0 })
  {
    Crowded crowded;
    const std::set<Place> before = placesOf(*crowded.moving);
    Patch patch;
    patch.position = crowded.place;
    patch.normal = glm::vec3(glm::normalize(crowded.place));
    patch.spacing = static_cast<float>(crowded.on.sizing.spacing);
    relaxAround({ patch }, Balance::None, *crowded.moving, {}, { reach, 0.3f });
    EXPECT_EQ(crowded.moving->size(), before.size());
    const double changed = reachOfChange(crowded, before);
    EXPECT_GT(changed, 0.5);
    // Two rounds of 0.3 spacings each.
    EXPECT_LE(changed, reach + 0.7);
  }
}

TEST(PackingRepair, TellsWhichStandTooNearAfterwards)
{
  Crowded crowded;
  const Buffer<Patch> places = relaxAround({}, Balance::None, *crowded.moving, {});
  EXPECT_TRUE(places.empty());
  Patch patch;
  patch.position = crowded.place;
  patch.normal = glm::vec3(glm::normalize(crowded.place));
  patch.spacing = static_cast<float>(crowded.on.sizing.spacing);
  // Steps so short that the two cannot part.
  const Buffer<Patch> still =
    relaxAround({ patch }, Balance::None, *crowded.moving, {}, { 3.0, 0.01f });
  ASSERT_EQ(still.size(), 2u);
  for (const Patch& p : still)
  {
    EXPECT_LE(glm::distance(p.position, crowded.place), 0.2 * crowded.on.sizing.spacing);
  }
  // The one too many is deleted where it may be.
  const std::size_t count = crowded.moving->count();
  relaxAround({ patch }, Balance::Crowded, *crowded.moving, {}, { 3.0, 0.01f });
  EXPECT_EQ(crowded.moving->count(), count - 1);
}

} // namespace
} // namespace hop::testing
