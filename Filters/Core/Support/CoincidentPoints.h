#pragma once

#include "Common/Monitor.h"
#include "Support/Buffer.h"

#include <glm/glm.hpp>

#include <vector>

namespace hop
{

/// A point, and how far from it others may be that are meant to stand in its place: > 0.
struct RoundedPoint
{
  glm::dvec3 position{ 0.0 };
  double reach = 0.0;
};

/// For each point the first of those that stand in its place, which is itself or comes before it. Points of
/// equal coordinates stand in one place; then, from the nearest pairs on, two places become one if points
/// of theirs are no farther from each other than every point of both reaches. So the two sides of a thin
/// layer stay apart even where points beside it reach across.
///
/// Which points stand together depends neither on their order nor on the number of threads. The time that
/// it takes grows with the number of points, however unevenly they are spread.
/// \param points finite
std::vector<int> coincidentPoints(
  const Buffer<RoundedPoint>& points, const ParallelFor& parallelFor = {});

} // namespace hop
