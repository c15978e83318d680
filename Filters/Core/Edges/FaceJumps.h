#pragma once

#include "Isolation/SurfaceProxy.h"

namespace hop
{

/// What the surface does where it passes from element to element.
struct FaceJumps
{
  /// As Isosurface::jumpTolerances: infinite at faces where no jump was seen, some part of a spacing at others
  /// and at those that the mesh does not join.
  std::vector<float> jumpTolerances;
  /// MaximumFaces entries an element: the largest angle seen by which the normal turns at that face, on both
  /// sides of it, radians; 0 where it hardly turns. A step between sides that count as one is an angle, too:
  /// step / spacing, below CreaseAngle; of sides that are parallel, small ones may be overlooked.
  std::vector<float> dihedralAngles;
  std::int64_t evaluations = 0;
};

/// The part of a spacing by which the two sides of the surface may miss each other at a face and still
/// count as one.
constexpr double LargestJumpPerSpacing = 0.4;

/// Angle between normals that makes a crease, radians: 10 degrees.
constexpr double CreaseAngle = 0.17453293;

/// Looks at the faces that the surface passes: for turns at a few places, unless samples on both sides look
/// like one smooth sheet, for jumps at one place for every box that shows it, unless the coefficients of
/// the two elements on the face differ by too little. Faces that the mesh does not join are left to be judged
/// place by place.
FaceJumps findFaceJumps(
  const Isosurface& surface, const SurfaceProxy& proxy, const ParallelFor& parallelFor);

} // namespace hop
