#pragma once

#include "Fast/FastDistribution.h"
#include "Surface/Particles.h"

#include <cstdint>
#include <functional>

namespace hop
{

/// What can be done where the surface bends faster than the spacing of its particles can follow.
struct SpacingAdvice
{
  /// Spacing that follows the surface, world units; 0 where none is known that takes at most MostTimes the particles.
  double spacing = 0.0;
  /// Number of particles that it takes.
  std::int64_t count = 0;
  /// Whether spacings were tried at all.
  bool isEstimated = false;
  /// Index of the particle where the surface bends most for its spacing.
  std::size_t worst = 0;
  /// Whether the gradient of the field vanishes on the surface, or nearly so.
  bool isSingular = false;

  /// Largest number of particles that is advised, in units of the number there is. Larger: runs that a user would not
  /// wait for; smaller: no advice where there could be one.
  static constexpr double MostTimes = 10.0;
};

/// Whether particles that cannot follow the surface are so many that the user is told.
bool hasTooManyUndersampled(const Distribution& distribution);

/// Looks for the largest spacing that follows the surface.
/// \param spacing that the distribution was made with, world units; 0 if a number of particles was given
/// \param estimateAt what the surface takes at a spacing
/// \pre hasTooManyUndersampled(distribution)
SpacingAdvice adviseSpacing(const Distribution& distribution, double spacing,
  const std::function<SizingEstimate(double spacing)>& estimateAt);

} // namespace hop
