#pragma once

#include "Surface/SurfaceGeometry.h"

namespace hop
{

/// Half-space values below this count as 'on the face' (reference coordinates are of order one).
constexpr double OnFace = 1e-11;

/// Whether a place lies on a face of its element.
inline bool isOnFace(
  const ElementMesh& mesh, const Location& location, int face, double accuracy = OnFace)
{
  return faceMargin(mesh.face(location.element, face), location.u) < accuracy;
}

/// Faces that hold a point back, at most two: with three it cannot move.
struct ActiveFaces
{
  std::array<int, 2> face{};
  int count = 0;

  bool holds(int f) const
  {
    return (this->count > 0 && this->face[0] == f) || (this->count > 1 && this->face[1] == f);
  }
  void add(int f) { this->face[this->count++] = f; }
};

/// The reference vector along the active faces whose world image is nearest to v.
ReferenceVector pullAlong(
  Domain domain, const ActiveFaces& active, const LocalMap& map, const WorldVector& v);

struct Exit
{
  double fraction = 1.0;
  /// -1: the step stays inside.
  int face = -1;
};

/// Where a step leaves the domain, if it does: at fraction zero where u lies on that face.
Exit findExit(
  Domain domain, const ReferencePoint& u, const ReferenceVector& du, const ActiveFaces& active);

} // namespace hop
