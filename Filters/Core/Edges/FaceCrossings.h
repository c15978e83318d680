#pragma once

#include "Isolation/SurfaceBox.h"

#include <algorithm>

namespace hop
{

/// A place on a face of an element near which the surface leaves the element.
struct FaceCrossing
{
  Location location;
  int face = -1;
  /// The ends of an edge of a box, between which the crossing lies, in reference space; nearer to it where larger
  /// values belong to another sheet (SurfaceBox::largestOwnValue).
  std::array<glm::dvec3, 2> ends{};
  /// By how much F differs between them.
  double rise = 0.0;
};

/// Whether all corners of a side of a box lie on a face of the element.
inline bool liesOnFace(const SurfaceBox& box, const Face& side, const Face& face)
{
  // Half-space values are of order one, and corners of boxes are kept in single precision.
  constexpr double rounding = 1e-6;
  return std::all_of(side.corners.begin(), side.corners.begin() + side.cornerCount,
    [&](int corner) { return faceMargin(face, { glm::dvec3(box.corners[corner]) }) < rounding; });
}

/// The crossing between two corners of a box that lie on a face, as if F were linear between them.
/// \pre F - c has opposite signs there
inline FaceCrossing crossingBetween(
  const SurfaceBox& box, int cornerA, int cornerB, const Face& face, int faceNumber)
{
  const glm::dvec3 from(box.corners[cornerA]);
  const glm::dvec3 to(box.corners[cornerB]);
  const double valueFrom = box.values[cornerA];
  const double valueTo = box.values[cornerB];
  const auto placeOf = [&](double value)
  { return glm::mix(from, to, (valueFrom - value) / (valueFrom - valueTo)); };
  const double own = box.largestOwnValue;
  const double first = std::clamp(valueFrom, -own, own);
  const double last = std::clamp(valueTo, -own, own);
  ReferencePoint u{ placeOf(0.0) };
  const glm::dvec3& inward = face.inward.xyz;
  u.xyz -= (faceMargin(face, u) / glm::dot(inward, inward)) * inward;
  return { { box.middle.element, u }, faceNumber, { placeOf(first), placeOf(last) },
    box.valueUnit * std::abs(first - last) };
}

/// Calls use(crossing) for the crossings on faces of the box's element that are part of the box, face by face: between
/// two neighbouring corners of the box where F - c has opposite signs. On each side of the box they come in pairs: the
/// surface enters the side and leaves it.
/// \param wanted tells for the number of a face whether it is of interest
template <class Wanted, class Use>
void visitFaceCrossings(
  const ElementMesh& mesh, const SurfaceBox& box, const Wanted& wanted, const Use& use)
{
  const auto& faces = facts(mesh.elements[box.middle.element].domain).faces;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    if (!wanted(f))
    {
      continue;
    }
    for (const Face& side : faces)
    {
      const int count = liesOnFace(box, side, faces[f]) ? side.cornerCount : 0;
      for (int c = 0; c < count; ++c)
      {
        const int a = side.corners[c];
        const int b = side.corners[(c + 1) % side.cornerCount];
        if ((box.values[a] > 0.0f) != (box.values[b] > 0.0f))
        {
          use(crossingBetween(box, a, b, faces[f], f));
        }
      }
    }
  }
}

} // namespace hop
