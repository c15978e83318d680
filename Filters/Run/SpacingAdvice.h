#pragma once

#include "Surface/Particles.h"
#include "Surface/SizingFunction.h"

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
  /// Unit of lengths in the distribution, world units.
  double unit = 1.0;
  /// Index of the particle where the surface bends most for its spacing.
  std::size_t worst = 0;
  /// Whether the gradient of the field vanishes on the surface, or nearly so.
  bool isSingular = false;
  /// Whether no spacing is advised, and a smallest spacing is given.
  bool isBounded = false;

  /// Largest number of particles that is advised, in units of the number there is. Larger: runs that a user would not
  /// wait for; smaller: no advice where there could be one.
  static constexpr double MostTimes = 10.0;
};

/// Whether particles that cannot follow the surface are so many that the user is told.
bool hasTooManyUndersampled(const Distribution& distribution);

/// Looks for the largest spacing that follows the surface: each particle stands for its part of the surface, which
/// takes more particles at a smaller spacing and bends as the particle's place does.
/// \param sizing that the distribution was made with; spacing 0 if a number of particles was given
/// \param unit of lengths in the distribution and of spacings, world units
/// \param countAt the number of particles that the surface takes at a spacing; asked once at most
/// \pre hasTooManyUndersampled(distribution)
SpacingAdvice adviseSpacing(const Distribution& distribution, SizingFunction sizing, double unit,
  const std::function<double(double spacing)>& countAt);

} // namespace hop
