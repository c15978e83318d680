#include "SurfaceWalker.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

/// Half-space values below this count as 'on the face' (reference coordinates are of order one).
constexpr double onFace = 1e-11;

/// Faces that hold a point back, at most two: with three it cannot move.
struct ActiveFaces
{
  std::array<int, 2> face{};
  int count = 0;

  bool holds(int f) const
  {
    return (this->count > 0 && this->face[0] == f) || (this->count > 1 && this->face[1] == f);
  }
  void add(int f) { this->face[this->count++] = f; }
};

double margin(const Face& face, const ReferencePoint& u)
{
  return glm::dot(face.inward.xyz, u.xyz) + face.offset;
}

/// Directions in reference space along all active faces: two of them for one face, one for two.
int freeDirections(Domain domain, const ActiveFaces& active, glm::dvec3 (&directions)[2])
{
  const auto& faces = facts(domain).faces;
  const glm::dvec3 a = faces[active.face[0]].inward.xyz;
  if (active.count == 2)
  {
    directions[0] = glm::cross(a, faces[active.face[1]].inward.xyz);
    return 1;
  }
  const glm::dvec3 other =
    std::abs(a.x) < 0.5 * glm::length(a) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  directions[0] = glm::cross(a, other);
  directions[1] = glm::cross(a, directions[0]);
  return 2;
}

/// The reference vector along the active faces whose world image is nearest to v.
ReferenceVector pullAlong(
  Domain domain, const ActiveFaces& active, const LocalMap& map, const WorldVector& v)
{
  if (active.count == 0)
  {
    return map.pull(v);
  }
  glm::dvec3 e[2]{};
  const int count = freeDirections(domain, active, e);
  const glm::dvec3 a = map.jacobian * e[0];
  if (count == 1)
  {
    return { e[0] * (glm::dot(a, v.xyz) / glm::dot(a, a)) };
  }
  const glm::dvec3 b = map.jacobian * e[1];
  const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
  const double av = glm::dot(a, v.xyz), bv = glm::dot(b, v.xyz);
  const double determinant = aa * bb - ab * ab;
  return { e[0] * ((bb * av - ab * bv) / determinant) +
    e[1] * ((aa * bv - ab * av) / determinant) };
}

struct Exit
{
  double fraction = 1.0;
  int face = -1;
};

/// Where the step leaves the domain, if it does: at fraction zero where u lies on that face.
Exit findExit(
  Domain domain, const ReferencePoint& u, const ReferenceVector& du, const ActiveFaces& active)
{
  const auto& faces = facts(domain).faces;
  Exit exit;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    const double rate = glm::dot(faces[f].inward.xyz, du.xyz);
    const double distance = margin(faces[f], u);
    const double inside = distance < onFace ? 0.0 : distance;
    if (rate < 0.0 && inside < -rate * exit.fraction && !active.holds(f))
    {
      exit = { inside / -rate, f };
    }
  }
  return exit;
}

/// Whether the field is near the isovalue in reference space too. Where an element folds over (det J = 0)
/// the world gradient is infinite, and any residual over it small.
bool isNearInReference(const FieldPoint& point)
{
  constexpr double near = 1e-3; // of the element
  const glm::dvec3 slope = glm::transpose(point.map.jacobian) * point.gradient.xyz;
  return std::abs(point.value) <= near * glm::length(slope);
}

bool onBoundary(const ElementMesh& mesh, const Location& location, int face)
{
  return mesh.neighbor(location.element, face).element < 0 &&
    margin(facts(mesh.elements[location.element].domain).faces[face], location.u) < onFace;
}

/// \pre the place lies on one
int firstBoundaryFace(const ElementMesh& mesh, const Location& location)
{
  int face = 0;
  while (!onBoundary(mesh, location, face))
  {
    ++face;
  }
  return face;
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
    const FaceNeighbor& neighbor = mesh.neighbor(at.location.element, exit.face);
    // Where the walls of two elements meet, each sends the step into the other: straight back
    // through the face it came by. Then it can only follow that face.
    const bool comesBack = exit.face == entry && exit.fraction == 0.0 && active.count > 0;
    if (neighbor.element >= 0 && !comesBack)
    {
      entry = neighbor.face;
      at.location = crossFace(mesh, at.location, exit.face);
      active = {};
    }
    else if (active.count == 2)
    {
      break;
    }
    else
    {
      active.add(exit.face);
    }
    at = this->evaluate(at.location);
  }
  return at.location;
}

/// The step of Newton's method. One that would leave through the boundary looks for the surface along
/// the boundary instead, and so do those that follow (`alongWall`): an overshoot would otherwise send
/// the next one back inside, past the rim.
WorldVector SurfaceWalker::newtonStep(const Evaluated& at, bool& alongWall) const
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
  if (alongWall && boundaryFaceCount(mesh, at.location) == 1)
  {
    hold(firstBoundaryFace(mesh, at.location));
  }
  while (active.count < 2)
  {
    const Exit exit = findExit(domain, at.location.u, at.point.map.pull(step), active);
    if (exit.face < 0 || !onBoundary(mesh, at.location, exit.face))
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
  const auto& faces = facts(mesh.elements[location.element].domain).faces;
  int count = 0;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    count += onBoundary(mesh, location, f);
  }
  return count;
}

} // namespace hop
