#pragma once

#include "Surface/SurfaceGeometry.h"

namespace hop
{

/// Steps that boundary faces hold back: a linear constraint f . u + offset >= 0 in reference space for each face, and
/// the active-set method of constrained optimisation. See Documentation/algorithm.md, section Walking on the surface.

/// Half-space value (faceMargin) below which a place counts as on the face; reference coordinates are of order one.
/// Some 45,000 epsilons of doubles: rounding errors of a step to a face stay below. Larger: places are moved by as much
/// when they cross to the next element; smaller: a place that was moved to a face may not be recognised there.
constexpr double OnFace = 1e-11;

/// Whether a place lies on a face of its element.
/// \param accuracy largest half-space value
inline bool isOnFace(
  const ElementMesh& mesh, const Location& location, int face, double accuracy = OnFace)
{
  return faceMargin(mesh.face(location.element, face), location.u) < accuracy;
}

/// Faces that hold a point back. There are at most two: with three it cannot move.
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

/// The reference vector along the active faces whose world image is nearest to v: least squares, by the normal
/// equations of the map's Jacobian restricted to the directions that the faces leave free.
/// \pre at most two faces are active, and the map is not singular
ReferenceVector pullAlong(
  Domain domain, const ActiveFaces& active, const LocalMap& map, const WorldVector& v);

/// Where a step leaves the domain.
struct Exit
{
  /// Share of the step that lies inside, 0 to 1.
  double fraction = 1.0;
  /// The face by which the step leaves; -1: it stays inside.
  int face = -1;
};

/// The first face by which a step leaves the domain, active faces left aside. The fraction is zero where u lies on that
/// face.
Exit findExit(
  Domain domain, const ReferencePoint& u, const ReferenceVector& du, const ActiveFaces& active);

} // namespace hop
