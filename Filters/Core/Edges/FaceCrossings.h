#pragma once

#include "Isolation/SurfaceBox.h"

#include <algorithm>

namespace hop
{

/// A place on a face of an element near which the surface leaves it.
struct FaceCrossing
{
  Location location;
  int face = -1;
  /// Places on an edge of a box between which it lies, as a rule corners, and by how much F differs between them.
  std::array<glm::dvec3, 2> ends{};
  double rise = 0.0;
};

/// Calls use(crossing) for places on faces of the box's element that are part of the box: between two
/// neighbouring corners of the box where F - c has opposite signs, as if it were linear there.
/// \param wanted tells for the number of a face whether it is of interest
template <class Wanted, class Use>
void visitFaceCrossings(
  const ElementMesh& mesh, const SurfaceBox& box, const Wanted& wanted, const Use& use)
{
  // Corners of boxes are kept in single precision.
  constexpr double rounding = 1e-6;
  const int element = box.middle.element;
  const auto& faces = facts(mesh.elements[element].domain).faces;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    const glm::dvec3& inward = faces[f].inward.xyz;
    const auto margin = [&](const glm::dvec3& u) { return glm::dot(inward, u) + faces[f].offset; };
    const auto onFace = [&](int corner)
    { return margin(glm::dvec3(box.corners[corner])) < rounding; };
    if (!wanted(f))
    {
      continue;
    }
    for (const Face& side : faces)
    {
      if (!std::all_of(side.corners.begin(), side.corners.begin() + side.cornerCount, onFace))
      {
        continue;
      }
      for (int c = 0; c < side.cornerCount; ++c)
      {
        const int a = side.corners[c];
        const int b = side.corners[(c + 1) % side.cornerCount];
        if ((box.values[a] > 0.0f) != (box.values[b] > 0.0f))
        {
          const glm::dvec3 from(box.corners[a]);
          const glm::dvec3 to(box.corners[b]);
          const double valueFrom = box.values[a];
          const double valueTo = box.values[b];
          const auto placeOf = [&](double value)
          { return glm::mix(from, to, (valueFrom - value) / (valueFrom - valueTo)); };
          const double own = box.ownValues;
          const double first = std::clamp(valueFrom, -own, own);
          const double last = std::clamp(valueTo, -own, own);
          glm::dvec3 u = placeOf(0.0);
          u -= (margin(u) / glm::dot(inward, inward)) * inward;
          use(FaceCrossing{ { element, { u } }, f, { placeOf(first), placeOf(last) },
            box.valueUnit * std::abs(first - last) });
        }
      }
    }
  }
}

} // namespace hop
