#pragma once

#include "Common/Monitor.h"
#include "Support/Buffer.h"

#include <glm/glm.hpp>

namespace hop
{

/// Points, and for each its spacing, the distance wanted to its neighbours, in world units; as SpacingGrid takes them.
struct SpacedPoints
{
  /// \param positionOf positionOf(i) for i in [0, count)
  /// \param spacingOf spacingOf(i) for i in [0, count)
  template <class PositionOf, class SpacingOf>
  SpacedPoints(std::size_t count, const PositionOf& positionOf, const SpacingOf& spacingOf,
    const ParallelFor& parallelFor)
    : positions(count)
    , spacings(count)
  {
    forAll(parallelFor, count,
      [&](std::size_t i)
      {
        this->positions[i] = positionOf(i);
        this->spacings[i] = static_cast<float>(spacingOf(i));
      });
  }

  Buffer<glm::dvec3> positions;
  Buffer<float> spacings;
};

} // namespace hop
