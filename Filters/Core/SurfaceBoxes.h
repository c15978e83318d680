#pragma once

#include "ElementMesh.h"
#include "Monitor.h"

namespace hop
{

/// A part of an element in which the isosurface may be.
struct SurfaceBox
{
  /// Its middle.
  Location middle;
  /// World diagonal of the bounds of its control points.
  double size = 0.0;
};

/// Splits every element into boxes (de Casteljau) until a box provably holds no surface, because its
/// coefficients of f lie on one side of the isovalue, or is no larger than `wantedSize`, or was
/// halved MaximumBisections times. The boxes that remain hold all of the surface. Elements with a
/// coefficient that is NaN or infinite give none.
/// \param wantedSize world units, > 0
/// \return boxes in the order of the elements, the same for any number of threads
std::vector<SurfaceBox> findSurfaceBoxes(
  const ElementMesh& mesh, double isovalue, double wantedSize, const ParallelFor& parallelFor);

constexpr int MaximumBisections = 24;

} // namespace hop
