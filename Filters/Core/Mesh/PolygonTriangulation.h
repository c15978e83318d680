#pragma once

#include "Mesh/TriangleFans.h"

#include <functional>
#include <vector>

namespace hop
{

/// What a triangle costs, in a triangulation of least cost; infinite: it is not allowed.
using TriangleCost = std::function<double(const Triangle&)>;

/// Whether two corners of a polygon may be joined by an edge inside it.
using MayJoin = std::function<bool(int a, int b)>;

/// The triangulation of a polygon whose triangles cost least together, by dynamic programming: the best triangulation
/// of the corners from i to j has one triangle on the edge from i to j, and the best triangulations on its other two
/// edges. Takes time by the cube of the number of corners.
/// \param polygon corners counterclockwise; a corner may occur several times, where the polygon touches itself
/// \param leastCost what no triangle costs less than: saves time, as triangles that cannot be better are not looked at
/// \return triangles counterclockwise; empty if there is no triangulation without triangles that are not allowed
std::vector<Triangle> triangulatePolygon(const std::vector<int>& polygon, const TriangleCost& cost,
  double leastCost, const MayJoin& mayJoin);

} // namespace hop
