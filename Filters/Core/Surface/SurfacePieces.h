#pragma once

#include "Elements/ElementMesh.h"

#include <vector>

namespace hop
{

/// The pieces into which the surface of a discontinuous field falls: it ends along all of each face between two of them,
/// so that no triangle and no walk leads from one piece to another, however near they are. It may also end at faces inside
/// of a piece, as at a slit. The surface of a continuous field is one piece.
class SurfacePieces
{
public:
  SurfacePieces() = default;

  /// Elements that the surface passes without an end are of one piece; so are all that have faces which the mesh does not
  /// join and behind which it may go on.
  /// \param jumpTolerances as Isosurface::jumpTolerances
  SurfacePieces(const ElementMesh& mesh, const std::vector<float>& jumpTolerances);

  bool areOne() const { return this->OfElement.empty(); }

  bool areSame(const Location& a, const Location& b) const
  {
    return this->areOne() || this->OfElement[a.element] == this->OfElement[b.element];
  }

  /// Whether the surface ends at a face that joins two elements.
  bool endBetween(const ElementMesh& mesh, int element, int other) const;

  /// Whether a face at which the surface ends holds two places of a piece, so that a line between them is the piece's own
  /// end.
  bool areOnEnd(const ElementMesh& mesh, const Location& a, const Location& b) const;

  /// Jump tolerances with which walks end where the surface does; empty where it is one piece.
  std::vector<float> jumpTolerances() const;

private:
  /// By the slots of faces: whether two elements are joined there and the surface ends.
  std::vector<char> Ends;
  std::vector<int> OfElement;
};

} // namespace hop
