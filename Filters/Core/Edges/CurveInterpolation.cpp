#include "Edges/CurveInterpolation.h"

namespace hop
{

double CurveInterpolation::spacingAt(const Location& location)
{
  if (this->Sizing.angularDensity == 0.0 && this->Proxy.spacingPlaces() == 0)
  {
    return this->Sizing.spacing;
  }
  const Evaluated at = this->Walker.evaluateCurved(location);
  return this->Proxy.spacingAt(at.point.map.position.xyz,
    static_cast<float>(curvature(at.point.gradient, at.hessian).magnitude));
}

/// A place on Hermite's cubic between two points of a boundary curve in one element, or on the line between the points
/// where the cubic would leave the face.
/// \param t share of the way, 0 to 1
ReferencePoint CurveInterpolation::onCubic(
  const BoundaryPoint& from, const BoundaryPoint& to, double t) const
{
  const ReferenceVector chord = to.at.location.u - from.at.location.u;
  const ReferencePoint onLine = from.at.location.u + t * chord;
  const double length = glm::distance(from.at.point.map.position.xyz, to.at.point.map.position.xyz);
  // Boundary curves are traced either way.
  const ReferenceVector start = this->Tracer.velocity(from);
  const ReferenceVector end = this->Tracer.velocity(to);
  const double way = dot(chord, start + end) < 0.0 ? -length : length;
  const ReferenceVector ahead = way * start - chord;
  const ReferenceVector behind = way * end - chord;
  const ReferencePoint bent = onLine + t * (1.0 - t) * ((1.0 - t) * ahead + (-t) * behind);
  const Domain domain = this->Mesh.elements[from.at.location.element].domain;
  return from.face == to.face && insideMargin(domain, bent) > -OnFace ? bent : onLine;
}

BoundaryPlace CurveInterpolation::placeBetween(
  const BoundaryPoint& from, const BoundaryPoint& to, double t)
{
  const int element = from.at.location.element;
  if (element == to.at.location.element)
  {
    return { { element, this->onCubic(from, to, t) }, from.face };
  }
  const WorldVector step = t * (to.at.point.map.position - from.at.point.map.position);
  const Location moved = this->Walker.move(from.at, step);
  return { moved, moved.element == element ? from.face : -1 };
}

} // namespace hop
