#include "Mesh/SurfaceBelow.h"

#include <cmath>

namespace hop
{

SurfaceBelow::SurfaceBelow(const Isosurface& surface, const ParallelFor& parallelFor)
  : Surface(surface)
{
  if (!this->Surface.locator)
  {
    this->Locator.emplace(*this->Surface.mesh, this->Surface.isovalue, parallelFor);
    this->Surface.locator = &*this->Locator;
  }
  this->Walker.emplace(this->Surface);
}

std::optional<Evaluated> SurfaceBelow::placeBelow(
  const glm::dvec3& point, const Particle& start, double spacing)
{
  // Largest distance between the point and the surface, and between the point and where a walk along the surface towards
  // it ends, in units of the spacing. Larger: the surface's end is covered where it has no particles; smaller: strongly
  // bent surface stays open.
  constexpr double beside = 0.5;
  const Evaluated from = this->Walker->evaluate(start.location);
  const Evaluated there = this->Walker->evaluate(
    this->Walker->move(from, WorldVector{ point - from.point.map.position.xyz }));
  const double slope = length(there.point.gradient);
  const double aside = glm::distance(there.point.map.position.xyz, point);
  if (!(aside <= beside * spacing) || !(std::abs(there.point.value) <= beside * spacing * slope))
  {
    return std::nullopt;
  }
  return there;
}

std::optional<Particle> SurfaceBelow::particleBelow(
  const glm::dvec3& point, const Particle& start, double spacing)
{
  const auto below = this->placeBelow(point, start, spacing);
  Evaluated place;
  if (!below || !this->Walker->project(below->location, spacing, place))
  {
    return std::nullopt;
  }
  place = this->Walker->evaluateCurved(place.location);
  return particleAt(
    place.location, place.point, curvature(place.point.gradient, place.hessian), spacing);
}

} // namespace hop
