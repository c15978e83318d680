#pragma once

#include "Isolation/SurfaceBoxes.h"

namespace hop::testing
{

/// A point of the isosurface for each box that leads to one, as distributions seed them: Newton's
/// method from the middle of the box, else bisection between its ends.
std::vector<Location> surfaceSeeds(
  const ElementMesh& mesh, double isovalue, const std::vector<SurfaceBox>& boxes);

/// Number of boxes that are not certified.
std::ptrdiff_t uncertifiedCount(const std::vector<SurfaceBox>& boxes);

/// World position of a place of the mesh.
glm::dvec3 positionAt(const ElementMesh& mesh, const Location& location);

} // namespace hop::testing
