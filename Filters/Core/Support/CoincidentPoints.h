#pragma once

#include "Common/Monitor.h"
#include "Support/Buffer.h"

#include <glm/glm.hpp>

#include <vector>

namespace hop
{

/// A point that was rounded, and how far from it other points may stand that mean the same place.
struct RoundedPoint
{
  glm::dvec3 position{ 0.0 };
  /// > 0
  double reach = 0.0;
};

/// For each point the first one that stands in the same place: the point itself or an earlier one. Points of equal
/// coordinates stand in one place. Then pairs are taken, the nearest first: two places become one if the pair is no
/// farther apart than any point of both places reaches. So the two sides of a thin layer stay apart even where points
/// beside it reach across.
///
/// Which points stand together depends neither on their order nor on the number of threads. The time taken grows with
/// the number of points, however unevenly they are spread.
/// \param points finite
std::vector<int> coincidentPoints(
  const Buffer<RoundedPoint>& points, const ParallelFor& parallelFor = {});

} // namespace hop
