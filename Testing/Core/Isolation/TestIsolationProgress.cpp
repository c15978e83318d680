#include "Isolation/IsolationProgress.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace hop::testing
{
namespace
{

TEST(IsolationProgress, CountsThePiecesThatHoldSurface)
{
  double share = 0.0;
  const ReportProgress reportShare = [&](double now) { share = now; };
  IsolationProgress progress(reportShare);
  progress.beginLevel(5);
  progress.closePiece(false);
  EXPECT_DOUBLE_EQ(share, 1.0 / 5.0);
  progress.closePiece(true); // four pieces may hold surface
  EXPECT_DOUBLE_EQ(share, 1.0 / 4.0);
  progress.closePiece(true);
  EXPECT_DOUBLE_EQ(share, 1.0 / 3.0);
  // Two pieces are halved: their four halves are the two thirds that are left.
  progress.beginLevel(4);
  progress.closePiece(false);
  EXPECT_DOUBLE_EQ(share, 1.0 / 3.0 + 2.0 / 3.0 / 4.0);
  progress.closePiece(false);
  progress.closePiece(true);
  EXPECT_DOUBLE_EQ(share, 1.0 / 3.0 + 2.0 / 3.0 * 2.0 / 3.0);
  progress.closePiece(false);
  EXPECT_EQ(share, 1.0);
}

/// Pieces of random fates, level by level, until none is left. The last piece holds surface.
std::vector<double> sharesOfARandomElement(std::uint64_t seed)
{
  Random random(seed);
  std::vector<double> shares;
  const ReportProgress reportShare = [&](double share) { shares.push_back(share); };
  IsolationProgress progress(reportShare);
  std::size_t pieces = 1 + static_cast<std::size_t>(6.0 * random.uniform());
  for (int level = 0; pieces > 0; ++level)
  {
    progress.beginLevel(pieces);
    std::size_t halved = 0;
    for (std::size_t n = 1; n < pieces; ++n)
    {
      const double fate = random.uniform();
      const bool isHalved = level < 10 && fate < 0.4;
      halved += isHalved;
      if (!isHalved)
      {
        progress.closePiece(fate < 0.7);
      }
    }
    progress.closePiece(false);
    pieces = 2 * halved;
  }
  return shares;
}

TEST(IsolationProgress, NeverFallsAndReachesOneExactlyOnce)
{
  for (int seed = 1; seed <= 200; ++seed)
  {
    const std::vector<double> shares = sharesOfARandomElement(seed);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end())) << seed;
    EXPECT_GE(shares.front(), 0.0) << seed;
    EXPECT_EQ(shares.back(), 1.0) << seed;
    EXPECT_EQ(std::count(shares.begin(), shares.end(), 1.0), 1) << seed;
  }
}

TEST(IsolationProgress, StaysWhereItIsWhereNothingHoldsSurface)
{
  std::vector<double> shares;
  const ReportProgress reportShare = [&](double share) { shares.push_back(share); };
  IsolationProgress progress(reportShare);
  progress.beginLevel(2);
  progress.closePiece(false); // the other piece is halved
  progress.beginLevel(2);
  progress.closePiece(true);
  progress.closePiece(true);
  EXPECT_EQ(shares, (std::vector<double>{ 0.5, 0.5, 0.5 }));
}

TEST(IsolationProgress, NobodyNeedsToListen)
{
  const ReportProgress nobody;
  IsolationProgress progress(nobody);
  progress.beginLevel(1);
  EXPECT_NO_THROW(progress.closePiece(false));
}

} // namespace
} // namespace hop::testing
