#include "Surface/SurfaceWalker.h"

#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

/// Slope of a field along a face on which a place lies: length of the part of its gradient in the face's plane.
double slopeAlong(
  const ElementMesh& mesh, const Evaluated& at, int face, const WorldVector& gradient)
{
  const Face& which = mesh.face(at.location.element, face);
  const WorldVector inward{ glm::transpose(at.point.map.inverse) * which.inward.xyz };
  return length(gradient - (dot(gradient, inward) / dot(inward, inward)) * inward);
}

int faceCountOf(const ElementMesh& mesh, const Location& location)
{
  return static_cast<int>(facts(mesh.elements[location.element].domain).faces.size());
}

} // namespace

Evaluated SurfaceWalker::evaluate(const Location& location)
{
  if (this->Curved)
  {
    return this->evaluateCurved(location);
  }
  ++this->Evaluations;
  const Jet jet = exactGradient(*this->Surface.mesh, location);
  return { location, fieldPoint(jet, this->Surface.isovalue) };
}

Evaluated SurfaceWalker::evaluateCurved(const Location& location)
{
  ++this->Evaluations;
  this->LastPlace = location;
  this->LastJet = exactHessian(*this->Surface.mesh, location);
  Evaluated result{ location, fieldPoint(this->LastJet, this->Surface.isovalue) };
  result.hessian = worldHessian(this->LastJet, result.point);
  return result;
}

const Jet& SurfaceWalker::jetAt(const Location& location)
{
  const Location& last = this->LastPlace;
  if (location.element != last.element || location.u.xyz != last.u.xyz)
  {
    this->evaluateCurved(location);
  }
  return this->LastJet;
}

std::optional<LocatedPlace> SurfaceWalker::placeBehind(const Evaluated& here, int face)
{
  const Isosurface& surface = this->Surface;
  const int element = here.location.element;
  const FaceNeighbor& neighbor = surface.mesh->neighbor(element, face);
  if (neighbor.element >= 0)
  {
    return LocatedPlace{ crossFace(*surface.mesh, here.location, face), neighbor.face, 0.0 };
  }
  return surface.locator->locate(
    here.point.map, element, face, surface.jumpTolerance(element, face), this->Evaluations);
}

double SurfaceWalker::jumpBetween(
  const ElementMesh& mesh, const Evaluated& here, const Behind& there)
{
  const WorldVector& before = here.point.gradient;
  const double slope = slopeAlong(mesh, there.at, there.face, there.at.point.gradient);
  const double other = slopeAlong(mesh, there.at, there.face, before);
  // Where a surface lies in the face, its slope along the face is rounding, and the smaller slope says the same from
  // both sides.
  constexpr double inFace = 1e-6; // of the gradient
  const bool isInFace = std::min(slope, other) < inFace * length(before);
  const double jump = std::abs(there.at.point.value - here.point.value);
  return jump > 0.0 ? jump / (isInFace ? std::min(slope, other) : slope) : 0.0;
}

std::optional<SurfaceWalker::Behind> SurfaceWalker::behind(const Evaluated& here, int face)
{
  const Isosurface& surface = this->Surface;
  const int element = here.location.element;
  const bool mayEnd = surface.mayEnd(element, face);
  if (mayEnd && !surface.isOpenToBoth(element, face))
  {
    return std::nullopt;
  }
  const auto place = this->placeBehind(here, face);
  if (!place)
  {
    return std::nullopt;
  }
  const Behind there{ this->evaluate(place->location), place->face };
  return continuesIn(surface, here, face, there) ? std::optional<Behind>(there) : std::nullopt;
}

bool SurfaceWalker::continuesIn(
  const Isosurface& surface, const Evaluated& here, int face, const Behind& there)
{
  const double tolerance = surface.jumpTolerance(here.location.element, face);
  const WorldVector& before = here.point.gradient;
  const WorldVector& after = there.at.point.gradient;
  return !std::isfinite(tolerance) ||
    (tolerance > 0.0 && jumpBetween(*surface.mesh, here, there) <= tolerance &&
      dot(before, after) >= SheetCosine * length(after) * length(before));
}

std::optional<SurfaceWalker::Behind> SurfaceWalker::behind(const Location& here, int face)
{
  const bool matters = this->Surface.isOpenToBoth(here.element, face);
  return this->behind(matters ? this->evaluate(here) : Evaluated{ here, {} }, face);
}

bool SurfaceWalker::endsAt(const Evaluated& here, int face)
{
  return isOnFace(*this->Surface.mesh, here.location, face) &&
    this->Surface.mayEnd(here.location.element, face) &&
    this->Surface.mayMeet(here.location.element, face) && !this->behind(here, face);
}

int SurfaceWalker::endFaceCount(const Location& location)
{
  int count = 0;
  for (int f = 0; f < faceCountOf(*this->Surface.mesh, location); ++f)
  {
    count += isOnFace(*this->Surface.mesh, location, f) &&
      this->Surface.mayEnd(location.element, f) && this->Surface.mayMeet(location.element, f) &&
      !this->behind(location, f);
  }
  return count;
}

/// The face at which the surface ends at a place; -1 if there is none or more than one.
int SurfaceWalker::onlyEnd(const Evaluated& here)
{
  int end = -1;
  for (int f = 0; f < faceCountOf(*this->Surface.mesh, here.location); ++f)
  {
    if (this->endsAt(here, f))
    {
      if (end >= 0)
      {
        return -1;
      }
      end = f;
    }
  }
  return end;
}

Location SurfaceWalker::move(const Evaluated& start, const WorldVector& step)
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const WorldPoint target = start.point.map.position + step;
  Evaluated at = start;
  ActiveFaces active;
  int entry = -1;
  for (int hops = 0; hops < MaximumHops; ++hops)
  {
    if (at.point.map.singular)
    {
      break;
    }
    const Domain domain = mesh.elements[at.location.element].domain;
    const ReferenceVector du =
      pullAlong(domain, active, at.point.map, target - at.point.map.position);
    const Exit exit = findExit(domain, at.location.u, du, active);
    at.location.u = at.location.u + exit.fraction * du;
    if (exit.face < 0)
    {
      break;
    }
    // Where the surface ends at faces of two neighbours that meet in an edge, each element sends the step into the
    // other: straight back through the face by which it came. Then it can only follow that face.
    const bool comesBack = exit.face == entry && exit.fraction == 0.0 && active.count > 0;
    const bool evaluated = this->Surface.mayEnd(at.location.element, exit.face);
    at = evaluated ? this->evaluate(at.location) : at;
    const auto next = comesBack ? std::nullopt : this->behind(at, exit.face);
    if (next)
    {
      entry = next->face;
      at = next->at;
      active = {};
    }
    else if (active.count == 2)
    {
      break;
    }
    else
    {
      active.add(exit.face);
      at = evaluated ? at : this->evaluate(at.location);
    }
  }
  return at.location;
}

/// The step of Newton's method. A step that would leave through a face at which the surface ends seeks the surface
/// along that face instead, and so do the steps after it: an overshoot would otherwise send the next step back inside,
/// past the boundary curve.
/// \param alongFace whether the step before went along a face; receives whether this one does
WorldVector SurfaceWalker::newtonStep(const Evaluated& at, bool& alongFace)
{
  const WorldVector& gradient = at.point.gradient;
  const double slope2 = dot(gradient, gradient);
  WorldVector step = (-at.point.value / slope2) * gradient;
  // Square of the sine of the angle between surface and face below which they are nearly tangent, so that there is no
  // curve to find: sine 1e-3. Smaller: steps along the face may be more than a thousand times as long as Newton's.
  constexpr double tangent = 1e-6;

  const ElementMesh& mesh = *this->Surface.mesh;
  const Domain domain = mesh.elements[at.location.element].domain;
  ActiveFaces active;
  const auto hold = [&](int face)
  {
    active.add(face);
    const WorldVector along = at.point.map.push(pullAlong(domain, active, at.point.map, gradient));
    const double rate = dot(along, gradient);
    step = rate > tangent * slope2 ? (-at.point.value / rate) * along : WorldVector{};
  };
  if (const int face = alongFace ? this->onlyEnd(at) : -1; face >= 0)
  {
    hold(face);
  }
  while (active.count < 2)
  {
    const Exit exit = findExit(domain, at.location.u, at.point.map.pull(step), active);
    if (exit.face < 0 || !this->endsAt(at, exit.face))
    {
      break;
    }
    hold(exit.face);
  }
  alongFace = active.count > 0;
  return step;
}

bool SurfaceWalker::project(
  const Location& start, double maximumTravel, Evaluated& result, bool keepFace)
{
  Evaluated at = this->evaluate(start);
  double travel = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  int stepsInVain = 0;
  bool alongFace = keepFace;
  for (int step = 0; step < MaximumNewtonSteps; ++step)
  {
    const double slope = length(at.point.gradient);
    if (at.point.map.singular || !(slope > 0.0) || !std::isfinite(slope))
    {
      return false;
    }
    if (this->Surface.holds(at.point, maximumTravel) && isNearInReference(at.point))
    {
      result = at;
      return true;
    }
    const double distance = std::abs(at.point.value) / slope;
    stepsInVain = distance <= 0.5 * nearest ? 0 : stepsInVain + 1;
    nearest = stepsInVain == 0 ? distance : nearest;
    if (stepsInVain > MaximumStepsInVain)
    {
      return false;
    }
    const WorldVector motion = this->newtonStep(at, alongFace);
    travel += length(motion);
    if (!(travel > 0.0) || travel > maximumTravel)
    {
      return false;
    }
    at = this->evaluate(this->move(at, motion));
  }
  return false;
}

} // namespace hop
