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
  /// Unit vector along the surface, out of the domain; zero where the surface goes on, in elements that
  /// the mesh does not join to this one.
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
/// spacing that the surface wants there, and on its corners. Where two curves run side by side (on the
/// two sides of faces that are not joined, or where two sides that jump apart elsewhere agree), only one
/// keeps its particles.
RimCurves findRimCurves(
  const Isosurface& surface, const SurfaceProxy& proxy, const SpacingLaw& law);

} // namespace hop
