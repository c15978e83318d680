#pragma once

#include "Isolation/SurfaceBox.h"

namespace hop
{

/// A point where the field's gradient vanishes.
struct CriticalPoint
{
  Location location;
  /// Whether the isosurface runs through it, to rounding: a cone, an isolated point, a crossing.
  bool onSurface = false;
};

/// Looks for a critical point in and right around an uncertified box, by Newton's method on the
/// gradient in reference space.
/// \return whether there is one
bool findCriticalPoint(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, CriticalPoint& result);

} // namespace hop
