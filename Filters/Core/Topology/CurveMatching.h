#pragma once

#include "Topology/ElementSurface.h"

#include <functional>

namespace hop
{

class FaceLocator;

/// What is on the other side of a curve in a face of an element.
struct CurveMatch
{
  enum Kind
  {
    /// A curve of the neighbour.
    Joined,
    /// Nothing: the surface ends in the curve.
    End,
    /// A curve of a larger face, of which this curve is a part.
    PartOf,
    /// Curves of smaller faces: this curve consists of those that are parts of it.
    Divided,
    /// The face has collapsed to an edge, and the curve to a point of the edge.
    Collapsed,
    /// Something that does not fit.
    Unknown
  };
  Kind kind = Unknown;
  /// Element and number there of the joined or larger curve; which of a joined curve's ends the first end of this curve
  /// is.
  int element = -1;
  int curve = -1;
  int firstEnd = 0;
};

/// Gives the surface in an element. What it returns stays where it is.
using SurfaceOfElement = std::function<const ElementSurface&(int element)>;

/// Finds the curves of neighbours that are those of an element. The two fields at the face have to agree. At a joined
/// face curves correspond if their ends are the same: the how-manieth points of the surface on the same edges. Closed
/// curves correspond, and curves in faces beside hanging nodes, if a point of one lies in a leaf of the other.
/// \param surfaceOf is asked for the element, and for the neighbours at which it has curves
/// \param locator see findTopology()
/// \return one entry a curve of the element
std::vector<CurveMatch> matchCurves(const ElementMesh& mesh, double isovalue, int element,
  const SurfaceOfElement& surfaceOf, const FaceLocator* locator);

/// Difference of the two fields at a joined face up to which they are one, as a share of the range of their
/// coefficients. Larger: the surface is taken to go on where particles end it; smaller: fields that are continuous but
/// for the digits of their file are not.
constexpr double LargestDifference = 1e-4;

/// Where an end of a curve is, world units.
WorldPoint positionOfEnd(const ElementMesh& mesh, double isovalue, int element,
  const ElementSurface& surface, const CurveEnd& end);

} // namespace hop
