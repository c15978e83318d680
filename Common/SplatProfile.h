#pragma once

#include <cmath>

namespace hop
{

/// The radial profile of a splat: how much a particle counts at a distance from it, and how far it makes a surface.
///
/// All distances are in radii of the splat. A particle's radius is the spacing that the filter gave it, so that they
/// are in spacings as well.
///
/// The weight is the Gaussian that M. Zwicker et al., *Surface Splatting*, 2001, take as the kernel of a point,
/// windowed: it is lowered by its value at distance 1 and scaled to be 1 in the middle,
///   w(r) = (exp(-s r^2) - exp(-s)) / (1 - exp(-s)),
/// with the sharpness s. So it ends with zero at the splat's rim, r = 1, and leaves no step there.
/// glsl/PassFragment.glsl of the renderer computes the same weight.
struct SplatProfile
{
  /// Sharpness s, no unit. A small one smooths over the neighbours, a large one shows each particle's own normal.
  double sharpness = 2.0;

  /// Weight at a distance of 0 to 1 radii.
  double weight(double radius) const
  {
    const double atRim = std::exp(-sharpness);
    return (std::exp(-sharpness * radius * radius) - atRim) / (1.0 - atRim);
  }

  /// The distance, in radii, at which the weight is this one, of 0 to 1. The inverse of weight().
  double radiusOf(double weight) const
  {
    const double atRim = std::exp(-sharpness);
    return std::sqrt(-std::log(weight * (1.0 - atRim) + atRim) / sharpness);
  }
};

/// What decides how far a splat makes a surface. Both numbers were chosen by experiment.
struct SplatThreshold
{
  /// Sharpness of the profile by which the reach is found. It stays the same whatever sharpness a user draws with:
  /// sharper profiles fall to the weight below between the particles already, and the surface would have holes.
  static constexpr double Sharpness = 2.0;
  /// Smallest weight that makes a surface where a splat is alone. A larger one leaves holes between particles that
  /// stand unevenly; a smaller one lets single splats stand out farther at outlines and boundary curves.
  static constexpr double Weight = 0.05;
};

/// How far, in radii, a splat fills gaps behind its planes. Chosen by experiment.
struct SplatOverlap
{
  /// Where the surface is almost smooth, along the splat. A smaller one leaves gaps where a discontinuous field makes a
  /// step; with a larger one splats stand out at outlines.
  static constexpr double Smooth = 0.35;
};

/// Distance from its particle, in radii, up to which a splat makes a surface: 0.928. From there to the rim it only
/// has a part in the averages.
inline double splatReach()
{
  return SplatProfile{ SplatThreshold::Sharpness }.radiusOf(SplatThreshold::Weight);
}

} // namespace hop
