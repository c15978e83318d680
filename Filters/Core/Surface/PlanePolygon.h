#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace hop
{

/// A convex polygon: of a surface that is a plane, the part that is wanted. Without corners it is all of the plane.
struct PlanePolygon
{
  /// One behind the other around the polygon, at least three; world units.
  std::vector<glm::dvec3> corners;

  bool isEverything() const { return this->corners.empty(); }
  const glm::dvec3& corner(std::size_t k) const { return this->corners[k % this->corners.size()]; }

  /// Unit vector in the plane that leads out of the polygon across the edge from corner k to the next one.
  glm::dvec3 outward(std::size_t k) const
  {
    const auto edge = [this](std::size_t e) { return this->corner(e + 1) - this->corner(e); };
    return glm::normalize(glm::cross(edge(k), glm::cross(edge(0), edge(1))));
  }

  /// How far a place of the plane lies outside of the polygon, or of the nearest line through one of its edges; negative
  /// inside. Beside a corner the distance is larger.
  double beyond(const glm::dvec3& place) const
  {
    double farthest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < this->corners.size(); ++k)
    {
      farthest = std::max(farthest, glm::dot(this->outward(k), place - this->corners[k]));
    }
    return farthest;
  }

  PlanePolygon scaled(double by) const
  {
    PlanePolygon result = *this;
    for (glm::dvec3& corner : result.corners)
    {
      corner *= by;
    }
    return result;
  }
};

} // namespace hop
