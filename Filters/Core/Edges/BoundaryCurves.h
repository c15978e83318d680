#pragma once

#include "Edges/FaceJumps.h"
#include "Isolation/SurfaceProxy.h"
#include "Support/Slab.h"
#include "Surface/Particles.h"

namespace hop
{

/// How the surface ends at a boundary face.
struct BoundarySide
{
  /// Of the particle's element.
  int face = -1;
  /// Unit vector along the surface, out of it across the boundary curve. Zero where there is no end: the surface goes
  /// on less than a spacing away.
  WorldVector outward;
  /// Curvature of the boundary curve along the surface, 1/radius, positive where the curve bends outwards: negative
  /// where the surface is convex there, positive around holes in it.
  double edgeCurvature = 0.0;

  bool exists() const { return dot(this->outward, this->outward) > 0.0; }
};

/// Whether the surface ends on both sides of a slit: the ways out are more than 120 degrees apart.
inline bool lookAtEachOther(const BoundarySide& a, const BoundarySide& b)
{
  return dot(a.outward, b.outward) < -0.5;
}

/// A particle on a boundary curve of the surface, or on one side of a crease.
struct BoundaryParticle
{
  Particle particle;
  /// Anchored to the boundary face and fixed.
  Patch patch;
  BoundarySide side;
  /// In a corner of the boundary curve, at the other boundary face, if that is one of the same element.
  BoundarySide otherSide;
  /// On one side of a crease.
  bool isOnCrease = false;
  /// Where two stretches of a curve meet.
  bool isCorner = false;
  /// Stays however near others are.
  bool isNeeded = false;
};

/// What is to be sampled.
enum class SampledCurves
{
  Boundary,
  /// For meshes: of a continuous field creases, too (CreaseAngle), on both sides; of a discontinuous one the ends of
  /// each piece of surface as if it were alone.
  ForMeshes
};

/// Particles on the boundary curves {F = c} of the surface, which run on the faces at which it ends. The curves pass
/// from face to face around the edges of the mesh, always with the domain on the same side. They are closed, but for
/// curves along jumps that fade, and beside elements that cover a part of a face.
/// Derivation: Documentation/algorithm.md, section Boundary curves and creases.
struct BoundaryCurves
{
  Buffer<BoundaryParticle> particles;
  /// Places of the curves that are too near to particles to be particles, as on a strip of the surface narrower than a
  /// spacing; and corners as seen from the second curve there. They tell where splats are to be cut off.
  Buffer<BoundaryParticle> thinned;
  /// By the numbers of the particles; see CurveSegments.h, too.
  SurfaceEdges edges;
  /// For meshes of a discontinuous field; else one.
  SurfacePieces pieces;
  std::int64_t evaluations = 0;
};

/// Follows every boundary curve that the boxes of the proxy show, and places particles on it: one on each of its
/// corners, and between corners evenly at the spacing that the surface wants. Where two curves run side by side (on the
/// two sides of a jump hardly wider than the largest that the surface passes), only one keeps its particles.
/// For meshes the surface of a continuous field is cut along creases: each side has a curve of its own. The particles of
/// both sides, and of all sides where creases meet, stand in the same places. The surface of a discontinuous field ends
/// along all of a face at which it ends anywhere, so that its curves are closed.
/// \param surface with the jump tolerances of `jumps`
/// \param jumps for meshes of a discontinuous field, receives the faces along which the surface ends
/// \param slab where a curve passes one of its planes a particle stands, unless a corner is near: the worker on the
///   other side of the plane has one there, too
/// \param reach where curves are sought: the mesh may end outside of it where the surface does not
BoundaryCurves findBoundaryCurves(const Isosurface& surface, FaceJumps& jumps,
  const SurfaceProxy& proxy, const SizingFunction& sizing, SampledCurves sampled,
  const ParallelFor& parallelFor, const Slab& slab = {}, const Slab& reach = {});

} // namespace hop
