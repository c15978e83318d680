#pragma once

#include "ElementMesh.h"
#include "Monitor.h"

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

/// Splits every element into boxes by de Casteljau's algorithm. A box is
///  - dropped if its coefficients of F - c have one sign: the convex hull holds no zero;
///  - certified if F - c changes its sign between corners and its derivative along the mean gradient
///    has coefficients of one sign, or is zero only where F - c is not (MonotoneTest.h): then the surface is
///    a graph along that direction, one sheet, and has no component of its own inside the box. A box with a face on its element's must also hold
///    one piece of the sheet only (BoundaryTest.h), as a corner that it cuts off there may be all that
///    the mesh has of a component;
///  - taken for two boxes if it holds two sheets close to each other (SheetPair.h), is small and was halved often
///    enough for them to be as good as flat;
///  - halved otherwise, across its longest direction; until it was halved MaximumBisections times, or its element had
///    to be split into more than MaximumPieces undecided pieces, or MaximumPieceBytes of them, or
///    MaximumLongPieces where they were halved LongBisections times: then the surface is singular along lines.
///    What is left then is certified if its field rises along some direction all the same: the surface touches such a
///    box, or cuts off less of it than counts. Otherwise it is returned uncertified.
/// Where the field only touches the isovalue (TouchTest.h) an element is given up much earlier. What has
/// one sign at its corners and is left so is returned as a few large boxes, that do not straddle: of the
/// parts of the element, halved PartBisections times, that it lies in.
/// Certified boxes are split on until no larger than `wantedSize`, and dropped where empty.
///
/// All of the surface lies in the boxes returned, and every component of it that is larger than
/// 2^-(MaximumBisections/3) of an element, or has no critical point near, in certified ones. Bounds
/// are widened by the rounding errors of the splitting. Elements with a coefficient that is NaN or
/// infinite give no boxes.
/// \param wantedSize world units, > 0
/// \param isSmall instead: whether a certified box is small enough; called from several threads
/// \param found is told what share of the work is done, 0 to 1; called from several threads
/// \return boxes in the order of the elements, the same for any number of threads
std::vector<SurfaceBox> findSurfaceBoxes(
  const ElementMesh& mesh, double isovalue, double wantedSize, const ParallelFor& parallelFor);
std::vector<SurfaceBox> findSurfaceBoxes(const ElementMesh& mesh, double isovalue,
  const std::function<bool(const SurfaceBox&)>& isSmall, const ParallelFor& parallelFor,
  const std::function<void(double)>& found = {});

/// Whether a place lies in the ball around a box: a seed that Newton's method took farther may be on
/// another component than the box's own.
bool isAtBox(const SurfaceBox& box, const Location& location);

/// A point near the surface on the line between the ends of a box that straddles it, by the regula falsi:
/// F - c is less there than a thousandth of what it differs by between the ends.
/// \param evaluations what it cost is added
Location findBetweenEnds(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, std::int64_t& evaluations);

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

constexpr int MaximumBisections = 36;
/// Halving adds rounding errors of the order of eps times the values themselves.
constexpr double RoundingShare = 1e-14;
/// Boxes on the rim of their element, halved that often, need not hold one piece of their sheet only.
constexpr int MaximumRimBisections = 30;
constexpr int MaximumPieces = 16384;
constexpr std::size_t MaximumPieceBytes = std::size_t{ 1 } << 29;
constexpr int LongBisections = 24;
constexpr int MaximumLongPieces = 1024;
constexpr int PartBisections = 3;

} // namespace hop
