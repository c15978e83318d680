#pragma once

#include "Isolation/SurfaceBox.h"

namespace hop
{

/// A triangle in an element's reference space.
using ReferenceTriangle = std::array<glm::vec3, 3>;

/// Appends triangles that stand for the surface inside a box: those of marching tetrahedra on the
/// values at its corners, between which the field is taken to be linear.
void appendProxyTriangles(
  Domain domain, const SurfaceBox& box, std::vector<ReferenceTriangle>& triangles);

/// The middle of these triangles; that of the box where there are none.
ReferencePoint proxyMiddle(Domain domain, const SurfaceBox& box);

} // namespace hop
