#pragma once

#include "Elements/ElementMesh.h"

#include <limits>

namespace hop
{

/// A part of an element in which the isosurface may be.
struct SurfaceBox
{
  /// Its middle.
  Location middle;
  /// World diagonal of the bounds of its control points.
  double size = 0.0;
  /// Largest distance of its corners from its middle, reference space.
  double referenceRadius = 0.0;
  /// The surface in it is one sheet, provably: along some direction the field only rises. Or it is one of two close
  /// to each other, each of which has a box of its own.
  bool certified = false;
  /// Certified, but the field stands still somewhere in it, as at a wall or on the axis of a needle: the
  /// surface may lie near that place, and bend much within the box.
  bool weakly = false;
  /// It was part of one where the field stands still: the surface may be thinner than the box.
  bool mayBeThin = false;
  /// Corners at which F - c has opposite signs, if there are such: a point of the surface lies on the
  /// straight line between them.
  bool straddles = false;
  std::array<ReferencePoint, 2> ends;
  /// In the order of facts(domain).corners: where they are in reference space, and F - c there in units
  /// of `valueUnit`, a power of two near the largest, as fields need not fit into single precision.
  std::array<glm::vec3, MaximumCorners> corners{};
  std::array<float, MaximumCorners> values{};
  double valueUnit = 1.0;
  /// Larger values, in these units, belong to the other one of two sheets: values are then those of SheetPair.h, and
  /// the middle is that of this one.
  float ownValues = std::numeric_limits<float>::infinity();
};

/// Whether a place lies in the ball around a box: a seed that Newton's method took farther may be on
/// another component than the box's own.
bool isAtBox(const SurfaceBox& box, const Location& location);

/// A point near the surface on the line between the ends of a box that straddles it, by the regula falsi:
/// F - c is less there than a thousandth of what it differs by between the ends.
/// \param evaluations what it cost is added
Location findBetweenEnds(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, std::int64_t& evaluations);

} // namespace hop
