#pragma once

#include <glm/glm.hpp>

#include <limits>

namespace hop
{

/// What lies between two parallel planes: the part of space in which one worker distributes particles. Without planes it
/// is all of space.
struct Slab
{
  /// Unit length.
  glm::dvec3 direction{ 0.0, 0.0, 1.0 };
  /// Places of the planes along the direction, world units; infinite where there is none.
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();

  bool hasBegin() const { return this->begin > -std::numeric_limits<double>::infinity(); }
  bool hasEnd() const { return this->end < std::numeric_limits<double>::infinity(); }
  bool isEverything() const { return !this->hasBegin() && !this->hasEnd(); }

  double placeOf(const glm::dvec3& position) const { return glm::dot(this->direction, position); }
  /// The first plane belongs to the slab before.
  bool holds(const glm::dvec3& position) const
  {
    const double place = this->placeOf(position);
    return this->begin < place && place <= this->end;
  }

  Slab widened(double by) const { return { this->direction, this->begin - by, this->end + by }; }
  Slab shifted(double by) const { return { this->direction, this->begin + by, this->end + by }; }
};

} // namespace hop
