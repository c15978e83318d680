#pragma once

#include "FaceJumps.h"
#include "Particles.h"
#include "SurfaceProxy.h"

namespace hop
{

/// Where the surface ends at a wall.
struct RimSide
{
  /// Of the particle's element.
  int face = -1;
  /// Unit vector along the surface, out of where it ends; zero where it goes on all the same, less than
  /// particles' distance away.
  WorldVector outward;
  /// By which the rim bends outwards, 1/radius; negative around islands.
  double bend = 0.0;

  bool exists() const { return dot(this->outward, this->outward) > 0.0; }
};

/// A particle on the rim of the surface.
struct RimParticle
{
  Particle particle;
  /// Anchored to the wall and fixed.
  Patch patch;
  RimSide side;
  /// In corners of its element, at the other wall.
  RimSide otherSide;
};

/// The rims {F = c} on faces at which the surface ends: they pass from face to face around the edges of
/// the mesh, always with the domain on the same side. They are closed curves, but for those along jumps
/// that fade, and beside elements that cover a part of a face.
struct RimCurves
{
  Buffer<RimParticle> particles;
  std::int64_t evaluations = 0;
};

/// Follows every rim that the boxes of the proxy show, and places particles on it, evenly at the
/// spacing that the surface wants there, and on its corners. Where two curves run side by side (on the two
/// sides of a jump that is hardly wider than the surface may pass), only one keeps its particles.
RimCurves findRimCurves(const Isosurface& surface, const FaceJumps& jumps,
  const SurfaceProxy& proxy, const SpacingLaw& law, const ParallelFor& parallelFor);

} // namespace hop
