#pragma once

#include "Topology/ElementSurface.h"

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
    /// The face has collapsed to an edge, and the curve to a point of the edge.
    Collapsed,
    /// Something that does not fit.
    Unknown
  };
  Kind kind = Unknown;
  /// Of a joined curve: its element and number there, and which of its ends the first end of this curve is.
  int element = -1;
  int curve = -1;
  int firstEnd = 0;
};

/// Finds the curves of neighbours that are those of an element. The two fields of a joined face have to agree, and curves
/// correspond if their ends are the same: the how-manieth points of the surface on the same edges. Closed curves
/// correspond if one has a point within the bounds of the other, and of no third one.
/// \param surfaces one an element
/// \param locator see findTopology()
/// \return one entry a curve of the element
std::vector<CurveMatch> matchCurves(const ElementMesh& mesh, double isovalue, int element,
  const std::vector<ElementSurface>& surfaces, const FaceLocator* locator);

/// Difference of the two fields at a joined face up to which they are one, as a share of the range of their
/// coefficients. Larger: the surface is taken to go on where particles end it; smaller: fields that are continuous but
/// for the digits of their file are not.
constexpr double LargestDifference = 1e-4;

} // namespace hop
