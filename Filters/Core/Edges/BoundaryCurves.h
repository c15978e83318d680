#pragma once

#include "Edges/FaceJumps.h"
#include "Isolation/SurfaceProxy.h"
#include "Surface/Particles.h"

namespace hop
{

/// Where the surface ends at a wall.
struct BoundarySide
{
  /// Of the particle's element.
  int face = -1;
  /// Unit vector along the surface, out of where it ends; zero where it goes on all the same, less than
  /// particles' distance away.
  WorldVector outward;
  /// By which the boundary curve bends outwards, 1/radius; negative around islands.
  double bend = 0.0;

  bool exists() const { return dot(this->outward, this->outward) > 0.0; }
};

/// A particle on the boundary curve of the surface.
struct BoundaryParticle
{
  Particle particle;
  /// Anchored to the wall and fixed.
  Patch patch;
  BoundarySide side;
  /// In corners of its element, at the other wall.
  BoundarySide otherSide;
};

/// The boundary curves {F = c} on faces at which the surface ends: they pass from face to face around the edges of
/// the mesh, always with the domain on the same side. They are closed curves, but for those along jumps
/// that fade, and beside elements that cover a part of a face.
struct BoundaryCurves
{
  Buffer<BoundaryParticle> particles;
  std::int64_t evaluations = 0;
};

/// Follows every boundary curve that the boxes of the proxy show, and places particles on it, evenly at the
/// spacing that the surface wants there, and on its corners. Where two curves run side by side (on the two
/// sides of a jump that is hardly wider than the surface may pass), only one keeps its particles.
BoundaryCurves findBoundaryCurves(const Isosurface& surface, const FaceJumps& jumps,
  const SurfaceProxy& proxy, const SizingFunction& sizing, const ParallelFor& parallelFor);

} // namespace hop
