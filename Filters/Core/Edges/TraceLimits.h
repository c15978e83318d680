#pragma once

#include "Elements/ElementMesh.h"

#include <unordered_map>

namespace hop
{

/// How long a trace of a boundary curve may become, so that it ends whatever rounding does to it.
///
/// On a face, F = c is a polynomial equation of a degree d, at most the sum of the element's degrees, so that a line
/// meets the curve in d points at most. Two limits follow for all of the curve on that face, in reference space. By
/// Crofton's formula it is no longer than d/2 times the perimeter of the face, which is below 5. And it comes over the
/// edges of the face, of which there are four at most, 4 d times at most. A trace that does more goes round.
class TraceLimits
{
public:
  explicit TraceLimits(const ElementMesh& mesh)
    : Mesh(mesh)
  {
  }

  /// Counts a chord on a face.
  /// \param from, to ends of the chord; `to` may lie in another element
  /// \return whether the curve can be as long as the chords on that face
  bool admit(const Location& from, int face, const Location& to)
  {
    const std::size_t slot = faceSlot(from.element, face);
    OnFace& sum = this->Faces[slot];
    sum.visits += slot != this->LatestFace;
    sum.length += from.element == to.element ? length(to.u - from.u) : 0.0;
    this->LatestFace = slot;
    const Degrees& degrees = this->Mesh.elements[from.element].degrees;
    const int degree = degrees[0] + degrees[1] + degrees[2];
    return sum.visits <= Slack * (4 * degree + 1) && sum.length <= Slack * 2.5 * degree;
  }

private:
  /// Vertices are only near the curve: chords may be longer than it. A larger one lets a trace that goes round go on
  /// for longer.
  static constexpr int Slack = 2;
  struct OnFace
  {
    int visits = 0;
    double length = 0.0;
  };

  const ElementMesh& Mesh;
  /// By the slots of the faces.
  std::unordered_map<std::size_t, OnFace> Faces;
  std::size_t LatestFace = static_cast<std::size_t>(-1);
};

} // namespace hop
