#include "Input/BlockGroups.h"

#include <gtest/gtest.h>

namespace hop::testing
{
namespace
{

using Groups = std::vector<std::set<int>>;

TEST(BlockGroups, BlocksThatShareNothingAreOneGroup)
{
  EXPECT_EQ(groupsWithoutSharedCells({ 2, 5, 7 }, {}), (Groups{ { 2, 5, 7 } }));
  EXPECT_EQ(groupsWithoutSharedCells({}, {}), Groups());
}

TEST(BlockGroups, BlocksThatShareCellsAreInDifferentGroups)
{
  EXPECT_EQ(groupsWithoutSharedCells({ 1, 2, 3, 4 }, { { 1, 3 }, { 2, 4 } }),
    (Groups{ { 1, 2 }, { 3, 4 } }));
  EXPECT_EQ(groupsWithoutSharedCells({ 1, 2, 3 }, { { 1, 2 }, { 1, 3 }, { 2, 3 } }),
    (Groups{ { 1 }, { 2 }, { 3 } }));
}

} // namespace
} // namespace hop::testing
