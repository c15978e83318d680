#include "SurfaceWalker.h"

#include "ActiveFaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

bool isOnFace(const ElementMesh& mesh, const Location& location, int face)
{
  const Domain domain = mesh.elements[location.element].domain;
  return faceMargin(facts(domain).faces[face], location.u) < OnFace;
}

/// Cosine of the largest turn at a face at which the field jumps: particles on sheets that turn more do
/// not keep each other off.
constexpr double sameSheet = 0.5;

int faceCountOf(const ElementMesh& mesh, const Location& location)
{
  return static_cast<int>(facts(mesh.elements[location.element].domain).faces.size());
}

} // namespace

Evaluated SurfaceWalker::evaluate(const Location& location)
{
  ++this->Evaluations;
  const Jet jet = evaluateGradient(this->Surface.mesh->form(location.element), location.u);
  return { location, fieldPoint(jet, this->Surface.isovalue) };
}

Evaluated SurfaceWalker::evaluateCurved(const Location& location)
{
  ++this->Evaluations;
  const Jet jet = evaluateHessian(this->Surface.mesh->form(location.element), location.u);
  Evaluated result{ location, fieldPoint(jet, this->Surface.isovalue) };
  result.hessian = worldHessian(jet, result.point);
  return result;
}

std::optional<SurfaceWalker::Behind> SurfaceWalker::behind(const Location& location, int face)
{
  const Isosurface& surface = this->Surface;
  const int element = location.element;
  const FaceNeighbor& neighbor = surface.mesh->neighbor(element, face);
  const double gap = surface.gap(element, face);
  if (neighbor.element >= 0 && !surface.mayEnd(element, face))
  {
    return Behind{ this->evaluate(crossFace(*surface.mesh, location, face)), neighbor.face };
  }
  const bool located =
    neighbor.element < 0 && surface.locator && surface.locator->mayGoOn(element, face);
  if (surface.walled || (neighbor.element < 0 && !located))
  {
    return std::nullopt;
  }
  const Evaluated here = this->evaluate(location);
  LocatedPlace there{ {}, neighbor.face, 0.0 };
  if (located)
  {
    const auto found =
      surface.locator->locate(here.point.map.position, element, face, gap, this->Evaluations);
    if (!found)
    {
      return std::nullopt;
    }
    there = *found;
  }
  else
  {
    there.location = crossFace(*surface.mesh, location, face);
  }
  const Behind result{ this->evaluate(there.location), there.face };
  const WorldVector& before = here.point.gradient;
  const WorldVector& after = result.at.point.gradient;
  const double slope = length(after);
  const double jump = std::abs(result.at.point.value - here.point.value);
  const bool turned = dot(before, after) < sameSheet * slope * length(before);
  const bool agrees = !std::isfinite(gap) || (jump <= gap * slope && !turned);
  return agrees ? std::optional<Behind>(result) : std::nullopt;
}

bool SurfaceWalker::endsAt(const Location& location, int face)
{
  return isOnFace(*this->Surface.mesh, location, face) &&
    this->Surface.mayEnd(location.element, face) && !this->behind(location, face);
}

int SurfaceWalker::endCount(const Location& location)
{
  int count = 0;
  for (int f = 0; f < faceCountOf(*this->Surface.mesh, location); ++f)
  {
    count += this->endsAt(location, f);
  }
  return count;
}

/// \pre there is one
int SurfaceWalker::firstEnd(const Location& location)
{
  int face = 0;
  while (!this->endsAt(location, face))
  {
    ++face;
  }
  return face;
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
    // Where the walls of two elements meet, each sends the step into the other: straight back
    // through the face it came by. Then it can only follow that face.
    const bool comesBack = exit.face == entry && exit.fraction == 0.0 && active.count > 0;
    const auto next = comesBack ? std::nullopt : this->behind(at.location, exit.face);
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
      at = this->evaluate(at.location);
    }
  }
  return at.location;
}

/// The step of Newton's method. One that would leave through the boundary looks for the surface along
/// the boundary instead, and so do those that follow (`alongWall`): an overshoot would otherwise send
/// the next one back inside, past the rim.
WorldVector SurfaceWalker::newtonStep(const Evaluated& at, bool& alongWall)
{
  const WorldVector& gradient = at.point.gradient;
  const double slope2 = dot(gradient, gradient);
  WorldVector step = (-at.point.value / slope2) * gradient;

  const ElementMesh& mesh = *this->Surface.mesh;
  const Domain domain = mesh.elements[at.location.element].domain;
  ActiveFaces active;
  const auto hold = [&](int face)
  {
    active.add(face);
    const WorldVector along = at.point.map.push(pullAlong(domain, active, at.point.map, gradient));
    const double rate = dot(along, gradient);
    // Where the surface all but touches the boundary there is no curve to find.
    step = rate > 1e-6 * slope2 ? (-at.point.value / rate) * along : WorldVector{};
  };
  if (alongWall && this->endCount(at.location) == 1)
  {
    hold(this->firstEnd(at.location));
  }
  while (active.count < 2)
  {
    const Exit exit = findExit(domain, at.location.u, at.point.map.pull(step), active);
    if (exit.face < 0 || !this->endsAt(at.location, exit.face))
    {
      break;
    }
    hold(exit.face);
  }
  alongWall = active.count > 0;
  return step;
}

bool SurfaceWalker::project(
  const Location& start, double maximumTravel, Evaluated& result, bool keepWall)
{
  Evaluated at = this->evaluate(start);
  // What rounding leaves of F - c, however small the tolerance; nothing is on a surface for it where
  // the gradient itself is rounding.
  const double noise =
    16.0 * std::numeric_limits<double>::epsilon() * std::abs(this->Surface.isovalue);
  constexpr double farFromNoise = 1e-6;
  double travel = 0.0;
  bool alongWall = keepWall;
  for (int step = 0; step < MaximumNewtonSteps; ++step)
  {
    const double slope = length(at.point.gradient);
    if (at.point.map.singular || !(slope > 0.0) || !std::isfinite(slope))
    {
      return false;
    }
    const double floor = noise < farFromNoise * maximumTravel * slope ? noise : 0.0;
    if (std::abs(at.point.value) <= std::max(this->Surface.tolerance * slope, floor) &&
      isNearInReference(at.point))
    {
      result = at;
      return true;
    }
    const WorldVector motion = this->newtonStep(at, alongWall);
    travel += length(motion);
    if (!(travel > 0.0) || travel > maximumTravel)
    {
      return false;
    }
    at = this->evaluate(this->move(at, motion));
  }
  return false;
}

int boundaryFaceCount(const ElementMesh& mesh, const Location& location)
{
  int count = 0;
  for (int f = 0; f < faceCountOf(mesh, location); ++f)
  {
    count += mesh.neighbor(location.element, f).element < 0 && isOnFace(mesh, location, f);
  }
  return count;
}

} // namespace hop
