#pragma once

#include "Elements/ElementMesh.h"

#include <limits>

namespace hop
{

/// A part of an element in which the isosurface may be.
struct SurfaceBox
{
  /// Middle of the box; in the box of one of two sheets, the middle of that sheet.
  Location middle;
  /// Diagonal of the bounds of the control points, world units.
  double size = 0.0;
  /// Largest distance of a corner from the middle of the box, reference space.
  double referenceRadius = 0.0;
  /// Whether the surface in the box is proven to be one sheet: either the field only rises along some direction, or two
  /// sheets close to each other have one box each. The box is undecided otherwise.
  bool certified = false;
  /// Whether the box is certified although the field stands still somewhere in it, as at a wall or on the axis of a
  /// needle: the surface may lie near that place, and bend much within the box.
  bool risesWeakly = false;
  /// Whether the field stands still in a larger piece that holds the box: the surface may be thinner than the box.
  bool mayBeThin = false;
  /// Whether F - c has opposite signs at the two ends: a point of the surface then lies on the line between them.
  bool straddles = false;
  /// The corners of the smallest and the largest F - c; in the box of one of two sheets, places on both sides of it.
  std::array<ReferencePoint, 2> ends;
  /// Corners in reference space, in the order of facts(domain).corners.
  std::array<glm::vec3, MaximumCorners> corners{};
  /// F - c at the corners, in units of `valueUnit`; in the box of one of two sheets, SheetPair::Sheet::values.
  std::array<float, MaximumCorners> values{};
  /// A power of two near the largest value, as fields need not fit into single precision.
  double valueUnit = 1.0;
  /// In the box of one of two sheets, the largest absolute value, in units of `valueUnit`, that belongs to this sheet;
  /// infinite otherwise.
  float largestOwnValue = std::numeric_limits<float>::infinity();
};

/// Whether a place lies in the ball around a box. A seed that Newton's method took farther may be on another component
/// than the surface in the box.
bool isAtBox(const SurfaceBox& box, const Location& location);

/// A point near the surface on the line between the ends of a box, by the regula falsi. |F - c| at the point is less
/// than a thousandth of the difference between the ends.
/// \pre box.straddles
/// \param evaluations is increased by the number of evaluations
Location findBetweenEnds(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, std::int64_t& evaluations);

} // namespace hop
