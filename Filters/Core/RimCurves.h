#pragma once

#include "Particles.h"
#include "SurfaceProxy.h"

namespace hop
{

/// A particle on the rim of the surface.
struct RimParticle
{
  Particle particle;
  /// Anchored to the wall and fixed.
  Patch patch;
  /// Unit vector along the surface, out of the domain.
  WorldVector outward;
};

/// The rims {F = c} on boundary faces, as closed curves: they pass from face to face around the edges
/// of the mesh, always with the domain on the same side.
struct RimCurves
{
  std::vector<RimParticle> particles;
  std::int64_t evaluations = 0;
  /// Curves that could not be followed back to where they began.
  std::int64_t open = 0;
};

/// Follows every rim that the boxes of the proxy show, and places particles on it, evenly at the
/// spacing that the surface wants there, and on its corners.
RimCurves findRimCurves(
  const Isosurface& surface, const SurfaceProxy& proxy, const SpacingLaw& law);

} // namespace hop
