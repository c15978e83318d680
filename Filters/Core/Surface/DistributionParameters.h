#pragma once

#include "Elements/ElementMesh.h"
#include "Surface/SizingFunction.h"

#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace hop
{

/// How much work the Fast distribution puts into an even spread.
enum class Quality
{
  /// One round of relaxation.
  Draft,
  /// Two rounds.
  Standard,
  /// Four rounds.
  High
};

/// What a distribution may be told.
struct DistributionParameters
{
  SizingFunction sizing;
  /// Of the Fast distribution.
  Quality quality = Quality::Standard;
  /// Seed of random choices; the same seed, the same particles.
  std::uint64_t seed = 1;
  /// 0: as many particles as the spacing asks for. Otherwise this many, and the spacing follows.
  std::int64_t particleCount = 0;
  /// Where a number of particles is given, the spacing to try first, and to keep if the number is right to a
  /// hundredth; 0: 1/50 of the mesh's diagonal. Fast only.
  double firstSpacing = 0.0;
  /// Places to start from, in the mesh at hand, where a run before left its particles on a surface nearby.
  /// What they miss is seeded; all is where few of them are near. Fast only.
  std::vector<Location> start;
  /// A request that would need more particles than this is refused before it is begun.
  std::int64_t particleLimit = 100'000'000;

  /// Why a request for that many particles is refused; empty if it is not.
  std::string refusal(double count) const
  {
    if (count <= static_cast<double>(this->particleLimit))
    {
      return {};
    }
    // Tiny spacings ask for more than integers hold, and the tiniest for no number.
    constexpr double most = 1e300;
    std::ostringstream text;
    text.precision(15);
    text << (this->particleCount > 0 ? "there are to be " : "the spacing asks for about ")
         << std::round(std::fmin(count, most)) << " particles, more than the limit of "
         << this->particleLimit;
    return text.str();
  }
};

} // namespace hop
