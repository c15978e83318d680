#pragma once

#include "Elements/ElementMesh.h"
#include "Support/Buffer.h"
#include "Support/GradationTree.h"
#include "Surface/Patch.h"
#include "Surface/PlanePolygon.h"
#include "Surface/SizingFunction.h"

#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace hop
{

struct SurfaceBox;

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

/// The paper's constants for Classic.
struct ClassicParameters
{
  /// The biased coin: U (E - E_ideal)/E_ideal, U uniform in [0, 1), below which a particle is split. Nearer to zero:
  /// more are split, also in an even packing.
  double splitBelow = -0.35;
  /// And above which it is deleted. Nearer to zero: more are deleted.
  double deleteAbove = 0.75;
  /// The system has settled when fewer than this share of the particles change. Larger: it settles sooner, and less
  /// evenly.
  double settledShare = 0.01;
  /// Relative change of the whole energy at which the system is steady. Larger: particles stop before they stand
  /// evenly; smaller: many more sweeps.
  double steadyChange = 0.0015;
};

/// What a distribution is asked for.
struct DistributionParameters
{
  SizingFunction sizing;
  /// Fast only.
  Quality quality = Quality::Standard;
  /// Classic only.
  ClassicParameters classic;
  /// Seed of random choices; the same seed, the same particles.
  std::uint64_t seed = 1;
  /// 0: as many particles as the spacing asks for. Otherwise this many, those in one place on creases taken for one, and
  /// the spacing follows.
  std::int64_t particleCount = 0;
  /// Whether particles stand on creases, too, on each side one in the same place: what meshes need. Fast only; not
  /// where these are more than the given number.
  bool onCreases = false;
  /// Elements at all of whose faces the surface ends, as a discontinuous field's does elsewhere. Fast only, and for
  /// meshes of discontinuous fields only.
  std::vector<int> endedElements;
  /// Places around which spacings are smaller than the sizing function's. Fast only.
  std::vector<GradationTree::Place> spacingLimits;
  /// What is wanted of a surface that is a plane; without corners all of it. Fast only, without a given number.
  PlanePolygon polygon;
  /// Places of this mesh to start from: particles of the last run, on a surface nearby. Parts of the surface without
  /// such a place are seeded; where few places are near the surface, all of it is. Fast only.
  std::vector<Location> start;
  /// Places around which the distribution to start from is to be changed: its other particles stay where they are. Without
  /// any all are spread anew. Fast only.
  Buffer<Patch> changedAround;
  /// Where the boxes of the surface are kept (SurfaceBoxes.h) from one distribution on it to the next one, which asks for
  /// the same number, quality and sizing function: it need not isolate the surface again. nullptr: nowhere. Fast only;
  /// outlives the distribution.
  std::vector<SurfaceBox>* boxes = nullptr;
  /// A request that would need more particles is refused before work begins. The default is as much as tens of
  /// gigabytes of memory hold.
  std::int64_t particleLimit = 100'000'000;

  /// Why a request for `count` particles is refused; empty if it is not.
  std::string refusal(double count) const
  {
    if (count <= static_cast<double>(this->particleLimit))
    {
      return {};
    }
    // Tiny spacings ask for more particles than integers hold, the tiniest for infinity or NaN: then the message
    // names this number.
    constexpr double most = 1e300;
    std::ostringstream text;
    text.precision(15);
    text << (this->particleCount > 0 ? "there are to be " : "the spacing asks for about ")
         << std::round(std::fmin(count, most)) << " particles, more than the limit of "
         << this->particleLimit;
    return text.str();
  }

  /// Boxes of isolation that take about as much memory as the particles of the limit.
  std::int64_t boxLimit() const { return 2 * this->particleLimit; }

  /// Why a request is refused whose surface lies in more boxes than that.
  std::string refusalOfBoxes() const
  {
    return "the surface bends so much that it takes more than " + std::to_string(this->boxLimit()) +
      " boxes, twice the limit of " + std::to_string(this->particleLimit) + " particles";
  }
};

} // namespace hop
