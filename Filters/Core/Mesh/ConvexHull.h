#pragma once

#include "Mesh/TriangleFans.h"

#include <glm/glm.hpp>

#include <vector>

namespace hop
{

/// The convex hull of few points: the time grows with the square of their number.
/// \return its triangles, counterclockwise as seen from outside, which have the numbers of the points; none if all points
///   are in one plane
std::vector<Triangle> convexHull(const std::vector<glm::dvec3>& points);

} // namespace hop
