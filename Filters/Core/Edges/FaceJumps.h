#pragma once

#include "Isolation/SurfaceProxy.h"

namespace hop
{

/// What the surface does where it passes from element to element.
/// Derivation: Documentation/algorithm.md, section Boundary curves and creases.
struct FaceJumps
{
  /// As Isosurface::jumpTolerances, world units: infinite at faces where no jump was seen, LargestJumpPerSpacing of the
  /// spacing at faces with a jump and at faces that the mesh does not join.
  std::vector<float> jumpTolerances;
  /// MaximumFaces entries an element: the dihedral angle at the face, which is the angle between the surface's normals
  /// on its two sides, radians. The largest one seen, and the same for both sides of the face; 0 where the surface is
  /// smooth. A jump that the surface passes counts as an angle, too: jump / spacing, below CreaseAngle; where the sides
  /// are parallel, a small one may be overlooked.
  std::vector<float> dihedralAngles;
  /// Largest distance of the surfaces on the two sides of a face that the mesh joins, as far as seen, in units of the
  /// spacing: along their normals, as a surface may be tangent to a face.
  double largestJump = 0.0;
  /// Whether meshes of the surface are to be in pieces: it is larger than LargestJumpPerSpacing, or the surface is to end
  /// around some elements.
  bool isDiscontinuous = false;
  std::int64_t evaluations = 0;
};

/// Largest jump, in units of the spacing, at which the two sides of the surface at a face count as one. Chosen by
/// experiment (splat_errors, files of discontinuous fields). A larger one lets splats bridge gaps that are seen in the
/// picture; with a smaller one the surface of a discontinuous field falls into pieces, each with boundary curves of its
/// own.
constexpr double LargestJumpPerSpacing = 0.2;

/// Smallest dihedral angle that makes a crease, radians: 10 degrees. Chosen by experiment. Splats are cut off at
/// creases, and hand over gradually to the other side at smaller angles; a larger one blurs edges, with a smaller one
/// faceted surfaces of discontinuous fields show every face.
constexpr double CreaseAngle = 0.17453293;

/// Looks at the faces that the surface passes. Dihedral angles are measured at a few places of a face, unless samples
/// on both sides look like one smooth sheet; jumps in one place of every box that shows the face, unless the
/// coefficients of the two elements differ by too little on the face. At faces that the mesh does not join, jumps are
/// left to be judged place by place.
FaceJumps findFaceJumps(
  const Isosurface& surface, const SurfaceProxy& proxy, const ParallelFor& parallelFor);

/// Lets the surface end at all faces of some elements behind which it may go on, as it does at jumps.
void endAround(const Isosurface& surface, const std::vector<int>& elements, FaceJumps& jumps);

/// How often the surface reaches a face between two elements, counted from each side, and how often it ends there, at a
/// jump. Faces to which nothing is joined do not count, be it the end of the mesh or an element without surface.
struct FacePassages
{
  std::int64_t reached = 0;
  std::int64_t ended = 0;
};

/// \param jumps of the surface
FacePassages countFacePassages(const ElementMesh& mesh, const SurfaceProxy& proxy,
  const FaceJumps& jumps, const ParallelFor& parallelFor);

} // namespace hop
