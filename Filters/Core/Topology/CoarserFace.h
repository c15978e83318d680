#pragma once

#include "Surface/FaceLocator.h"

namespace hop
{

/// A face of an element as a part of a larger face of another element, beside hanging nodes. Both are parametrized
/// alike: places of one go to places of the other by an affine map.
struct CoarserFace
{
  int element = -1;
  int face = -1;

  /// The same place in the larger element.
  Location operator()(const ReferencePoint& u) const
  {
    return { this->element, { this->origin + this->slope * u.xyz } };
  }

  /// Sets the map by three places of the face, the first ones, and where these are in the larger element.
  void setMap(const std::array<glm::dvec3, 4>& here, const std::array<glm::dvec3, 4>& there);

  glm::dvec3 origin{ 0.0 };
  glm::dmat3 slope{ 0.0 };
};

/// A place on a face from two coordinates of its own; on a triangle their sum is 1 at most.
ReferencePoint placeOnFace(Domain domain, const Face& face, double s, double t);

/// Whether another element lies behind a face that is not joined, at one of some places inside the face.
bool isSomethingBehind(const ElementMesh& mesh, const FaceLocator& locator, int element, int face);

/// The larger face of which a face that is not joined is a part; nothing if there is none.
std::optional<CoarserFace> findCoarserFace(
  const ElementMesh& mesh, const FaceLocator& locator, int element, int face);

} // namespace hop
