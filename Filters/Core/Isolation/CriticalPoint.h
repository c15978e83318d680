#pragma once

#include "Isolation/SurfaceBox.h"

namespace hop
{

/// A point where the field's gradient vanishes.
struct CriticalPoint
{
  Location location;
  /// Whether the isosurface runs through the point, to rounding: the tip of a cone, an isolated point, or a crossing
  /// of sheets.
  bool onSurface = false;
};

/// Searches an undecided box and its surroundings for a critical point, by Newton's method on the gradient in
/// reference space.
/// \param result is changed only where a point was found
/// \return whether a point was found
bool findCriticalPoint(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, CriticalPoint& result);

} // namespace hop
