#pragma once

#include "Common/Monitor.h"
#include "Support/Buffer.h"

#include <glm/glm.hpp>

namespace hop
{

/// A box along the axes.
struct Bounds
{
  glm::dvec3 lower{ 0.0 };
  glm::dvec3 upper{ 0.0 };

  void include(const Bounds& other)
  {
    this->lower = glm::min(this->lower, other.lower);
    this->upper = glm::max(this->upper, other.upper);
  }
  /// Whether the boxes have a point in common, be it at their borders.
  bool overlaps(const Bounds& other) const
  {
    return glm::all(glm::lessThanEqual(this->lower, other.upper)) &&
      glm::all(glm::lessThanEqual(other.lower, this->upper));
  }
  Bounds widened(double by) const { return { this->lower - by, this->upper + by }; }
  double diagonal() const { return glm::distance(this->lower, this->upper); }
};

/// The smallest box that holds all points; of no points, the origin.
Bounds boundsOf(Span<glm::dvec3> points, const ParallelFor& parallelFor);

} // namespace hop
