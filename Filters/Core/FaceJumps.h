#pragma once

#include "SurfaceProxy.h"

namespace hop
{

/// What the surface does where it passes from element to element.
struct FaceJumps
{
  /// As Isosurface::cuts.
  std::vector<char> cuts;
  /// MaximumFaces entries an element; nonzero: the normal turns at that face, on both sides of it.
  std::vector<char> kinks;
  std::int64_t evaluations = 0;
};

/// The part of a spacing by which the two sides of the surface may miss each other at a face and still
/// count as one.
constexpr double LargestJumpPerSpacing = 0.4;

/// Cosine of the angle between normals that makes a kink: 10 degrees.
constexpr double KinkCosine = 0.98480775;

/// Looks at the inner faces that the surface passes: for kinks at a few places, for jumps at one
/// place for every box that shows it. Two elements whose corners on the face have the same values, and
/// whose degrees are the same, are taken to agree on all of it.
FaceJumps findFaceJumps(
  const Isosurface& surface, const SurfaceProxy& proxy, const ParallelFor& parallelFor);

/// F - c on the other side of a face, at a place on it; zero where there is no other side.
double valueBehind(const Isosurface& surface, const Location& location, int face);

} // namespace hop
