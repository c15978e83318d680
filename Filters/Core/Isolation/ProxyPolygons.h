#pragma once

#include "Isolation/SurfaceBox.h"

namespace hop
{

/// A triangle in an element's reference space.
using ReferenceTriangle = std::array<glm::vec3, 3>;

/// Appends triangles that approximate the surface in a box: the result of marching tetrahedra on the values at its
/// corners, between which the field is taken to be linear. A value of zero counts as below the isovalue.
void appendProxyTriangles(
  Domain domain, const SurfaceBox& box, std::vector<ReferenceTriangle>& triangles);

/// Centroid of the triangles of a box in reference space; the middle of the box if there are no triangles.
ReferencePoint proxyMiddle(Domain domain, const SurfaceBox& box);

} // namespace hop
