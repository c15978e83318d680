#pragma once

#include "Surface/SurfaceWalker.h"

#include <vector>

namespace hop
{

/// A point of a boundary curve. It lies on a boundary face: a face of an element at which the surface may end, because
/// nothing lies behind it or because the field jumps there (Isosurface::mayEnd).
struct BoundaryPoint
{
  Evaluated at;
  int face = -1;
};

/// Whether the surface is cut along the face of a point.
inline bool isCutAt(const Isosurface& surface, const BoundaryPoint& point)
{
  return surface.isCutAt(point.at.location.element, point.face);
}

/// Where a particle is to stand on a boundary curve, nearly.
struct BoundaryPlace
{
  Location location;
  /// Of the element; -1 where it is yet to be found.
  int face = -1;
  /// Wanted nearby, world units.
  double spacing = 0.0;
};

/// A vertex of a traced boundary curve. On an edge of the mesh it has two faces: one on which the curve comes, one on
/// which it goes on.
struct BoundaryVertex
{
  BoundaryPoint arriving;
  BoundaryPoint leaving;
  /// The boundary curve has a corner here, or passes an edge of the mesh and is a cut before or behind it.
  bool corner = false;
  /// Wanted here, world units.
  double spacing = 0.0;

  const glm::dvec3& position() const { return this->arriving.at.point.map.position.xyz; }
};

struct BoundaryTrace
{
  std::vector<BoundaryVertex> vertices;
  /// The last vertex is followed by the first.
  bool closed = false;
};

} // namespace hop
