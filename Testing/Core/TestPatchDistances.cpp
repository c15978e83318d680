#include "PatchDistances.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(standApart(row, { 1, 1, 1, 1 }, 0.6, {}), (Marks{ 1, 0, 1, 1 }));
}

TEST(PatchDistances, ThoseThatAreNotWantedPushNoneAside)
{
  const Buffer<Patch> row = inARow({ 0.0, 0.5, 1.0, 2.0 });
  EXPECT_EQ(standApart(row, { 0, 1, 1, 1 }, 0.6, {}), (Marks{ 0, 1, 0, 1 }));
  EXPECT_EQ(standApart(row, { 0, 1, 0, 1 }, 0.6, {}), (Marks{ 0, 1, 0, 1 }));
}

TEST(PatchDistances, ThoseBehindStayWhoeverIsNear)
{
  const Buffer<Patch> row = inARow({ 0.0, 2.0, 0.5 });
  EXPECT_EQ(standApart(row, { 1, 1 }, 0.6, {}), (Marks{ 0, 1 }));
}

TEST(PatchDistances, SheetsThatAreTurnedAwayAreOthers)
{
  Buffer<Patch> row = inARow({ 0.0, 0.1 });
  row[1].normal = { 0, 0, -1 };
  EXPECT_EQ(standApart(row, { 1, 1 }, 0.6, {}), (Marks{ 1, 1 }));
}

} // namespace
} // namespace hop::testing
