#include "RimTracer.h"

#include "ActiveFaces.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// Cosine of the largest turn from chord to chord, and of the turn that makes a corner.
constexpr double smallestTurn = 0.9;
constexpr double cornerTurn = 0.94;
constexpr int maximumHalvings = 8;
/// A chord passes a point that is nearer to it than this, in units of its length.
constexpr double nearness = 0.2;

const Face& faceOf(const ElementMesh& mesh, const Location& location, int face)
{
  return facts(mesh.elements[location.element].domain).faces[face];
}

double distanceToSegment(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b)
{
  const glm::dvec3 d = b - a;
  const double length2 = glm::dot(d, d);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(x - a, d) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(x, a + t * d);
}

} // namespace

void RimChords::add(const RimPoint& from, const RimPoint& to)
{
  this->Chords[keyOf(from)].emplace_back(
    from.at.point.map.position.xyz, to.at.point.map.position.xyz);
}

bool RimChords::pass(const RimPoint& point) const
{
  const auto found = this->Chords.find(keyOf(point));
  const glm::dvec3& x = point.at.point.map.position.xyz;
  return found != this->Chords.end() &&
    std::any_of(found->second.begin(), found->second.end(),
      [&x](const std::pair<glm::dvec3, glm::dvec3>& chord)
      {
        return distanceToSegment(x, chord.first, chord.second) <=
          nearness * glm::distance(chord.first, chord.second);
      });
}

std::int64_t RimChords::keyOf(const RimPoint& point)
{
  return std::int64_t{ MaximumFaces } * point.at.location.element + point.face;
}

/// The face at which the surface may end on which a place lies, the preferred one if it is among them; -1
/// if none.
int RimTracer::wallOf(const Location& location, int preferred) const
{
  const auto onWall = [&](int f)
  {
    return this->Surface.mayEnd(location.element, f) &&
      faceMargin(faceOf(*this->Surface.mesh, location, f), location.u) < OnFace;
  };
  if (preferred >= 0 && onWall(preferred))
  {
    return preferred;
  }
  const auto count =
    static_cast<int>(facts(this->Surface.mesh->elements[location.element].domain).faces.size());
  for (int f = 0; f < count; ++f)
  {
    if (onWall(f))
    {
      return f;
    }
  }
  return -1;
}

std::optional<RimPoint> RimTracer::project(const Location& start, int face, double maximumTravel)
{
  Evaluated at;
  if (!this->Walker.project(start, maximumTravel, at, true))
  {
    return std::nullopt;
  }
  const int wall = this->wallOf(at.location, at.location.element == start.element ? face : -1);
  return wall < 0 ? std::nullopt : std::optional<RimPoint>({ at, wall });
}

WorldVector RimTracer::tangent(const RimPoint& point) const
{
  const LocalMap& map = point.at.point.map;
  const glm::dvec3 inward = glm::transpose(map.inverse) *
    faceOf(*this->Surface.mesh, point.at.location, point.face).inward.xyz;
  const glm::dvec3 along = glm::cross(-point.at.point.gradient.xyz, inward);
  const double size = glm::length(along);
  return { size > 0.0 ? along / size : glm::dvec3(0.0) };
}

/// Newton's method for F = c along the edge between two faces of an element.
std::optional<Evaluated> RimTracer::projectAlongEdge(
  const Location& start, int faceA, int faceB, double maximumTravel)
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const Domain domain = mesh.elements[start.element].domain;
  ActiveFaces edge;
  edge.add(faceA);
  edge.add(faceB);
  const glm::dvec3 direction =
    glm::cross(faceOf(mesh, start, faceA).inward.xyz, faceOf(mesh, start, faceB).inward.xyz);
  Evaluated at = this->Walker.evaluate(start);
  double travel = 0.0;
  for (int n = 0; n < SurfaceWalker::MaximumNewtonSteps; ++n)
  {
    const double slope = length(at.point.gradient);
    if (at.point.map.singular || !(slope > 0.0))
    {
      return std::nullopt;
    }
    if (std::abs(at.point.value) <= this->Surface.tolerance * slope)
    {
      return at;
    }
    const WorldVector along = at.point.map.push({ direction });
    const double rate = dot(along, at.point.gradient);
    const ReferenceVector du{ (-at.point.value / rate) * direction };
    travel += std::abs(at.point.value / rate) * length(along);
    const Exit exit = findExit(domain, at.location.u, du, edge);
    if (!(travel <= maximumTravel) || exit.fraction == 0.0)
    {
      return std::nullopt;
    }
    at = this->Walker.evaluate({ start.element, at.location.u + exit.fraction * du });
  }
  return std::nullopt;
}

std::vector<std::int64_t> RimTracer::cornersOf(const Location& location, int face) const
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const Face& which = faceOf(mesh, location, face);
  std::vector<std::int64_t> numbers;
  for (int c = 0; c < which.cornerCount; ++c)
  {
    numbers.push_back(mesh.elements[location.element].corners[which.corners[c]]);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// The other face of an element that has the corners of an edge; -1 if there is none.
int RimTracer::faceAtEdge(
  const Location& location, int entry, const std::vector<std::int64_t>& edge) const
{
  const auto count =
    static_cast<int>(facts(this->Surface.mesh->elements[location.element].domain).faces.size());
  for (int f = 0; f < count; ++f)
  {
    const auto corners = this->cornersOf(location, f);
    if (f != entry && std::includes(corners.begin(), corners.end(), edge.begin(), edge.end()))
    {
      return f;
    }
  }
  return -1;
}

/// The other face of an element on which a place lies, to what rounding leaves of places that were
/// located; -1 if there is none.
int RimTracer::faceAtPlace(const Location& location, int entry) const
{
  constexpr double rounding = 1e-6;
  const auto count =
    static_cast<int>(facts(this->Surface.mesh->elements[location.element].domain).faces.size());
  for (int f = 0; f < count; ++f)
  {
    if (f != entry && faceMargin(faceOf(*this->Surface.mesh, location, f), location.u) < rounding)
    {
      return f;
    }
  }
  return -1;
}

Location RimTracer::ontoFace(const Location& location, int face) const
{
  const Face& which = faceOf(*this->Surface.mesh, location, face);
  const glm::dvec3& inward = which.inward.xyz;
  return { location.element,
    { location.u.xyz - faceMargin(which, location.u) / glm::dot(inward, inward) * inward } };
}

/// From a wall across an edge to the wall behind it: that of the same element, or that to which the
/// elements around the edge lead, one through the next.
std::optional<RimPoint> RimTracer::turnAroundEdge(const Evaluated& at, int wall, int face)
{
  constexpr int maximumElements = 64;
  const auto edgeBetween = [&](const Location& location, int a, int b)
  {
    const auto first = this->cornersOf(location, a);
    const auto second = this->cornersOf(location, b);
    std::vector<std::int64_t> edge;
    std::set_intersection(
      first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(edge));
    return edge;
  };
  std::vector<std::int64_t> edge = edgeBetween(at.location, wall, face);
  Location location = at.location;
  for (int n = 0; n < maximumElements; ++n)
  {
    const FaceNeighbor& neighbor = this->Surface.mesh->neighbor(location.element, face);
    int entry = neighbor.face;
    if (this->Surface.mayEnd(location.element, face))
    {
      const auto next = this->Passer.behind(location, face);
      if (!next)
      {
        return RimPoint{ n == 0 ? at : this->Walker.evaluate(location), face };
      }
      location = next->at.location;
      entry = next->face;
    }
    else
    {
      location = crossFace(*this->Surface.mesh, location, face);
    }
    const bool joined = neighbor.element >= 0;
    face = joined ? this->faceAtEdge(location, entry, edge) : this->faceAtPlace(location, entry);
    if (face < 0)
    {
      return std::nullopt;
    }
    if (!joined)
    {
      location = this->ontoFace(location, face);
      edge = edgeBetween(location, entry, face);
    }
  }
  return std::nullopt;
}

std::optional<RimVertex> RimTracer::passEdge(
  const RimPoint& from, const ReferencePoint& u, int otherFace, double step)
{
  const auto at =
    this->projectAlongEdge({ from.at.location.element, u }, from.face, otherFace, step);
  if (!at || !this->isOnRim({ *at, from.face }))
  {
    return std::nullopt;
  }
  const auto beyond = this->turnAroundEdge(*at, from.face, otherFace);
  if (!beyond)
  {
    return std::nullopt;
  }
  RimVertex vertex{ { *at, from.face }, *beyond, false };
  vertex.corner = dot(this->tangent(vertex.arriving), this->tangent(vertex.leaving)) < cornerTurn;
  return vertex;
}

/// The next vertex, `step` ahead or on the next edge of the mesh.
std::optional<RimVertex> RimTracer::advance(const RimPoint& from, double step, double direction)
{
  const Domain domain = this->Surface.mesh->elements[from.at.location.element].domain;
  ActiveFaces wall;
  wall.add(from.face);
  const WorldVector ahead = (direction * step) * this->tangent(from);
  const ReferenceVector du = pullAlong(domain, wall, from.at.point.map, ahead);
  const Exit exit = findExit(domain, from.at.location.u, du, wall);
  const ReferencePoint u = from.at.location.u + exit.fraction * du;
  if (exit.face >= 0)
  {
    return this->passEdge(from, u, exit.face, step);
  }
  const auto next = this->project({ from.at.location.element, u }, from.face, step);
  if (!next || dot(this->tangent(*next), this->tangent(from)) < smallestTurn ||
    !this->isOnRim(*next))
  {
    return std::nullopt;
  }
  return RimVertex{ *next, *next, false };
}

/// \return whether the rim came back to its start
bool RimTracer::follow(
  const RimPoint& start, double step, double direction, std::vector<RimVertex>& vertices)
{
  RimPoint here = start;
  std::optional<std::pair<RimPoint, RimPoint>> lastChord;
  double chord = step;
  int stuck = 0;
  while (stuck <= maximumHalvings)
  {
    std::optional<RimVertex> next;
    for (int n = 0; n < maximumHalvings && !next; ++n)
    {
      next = this->advance(here, chord, direction);
      chord *= next ? 1.0 : 0.5;
    }
    if (!next)
    {
      break;
    }
    const double moved = glm::distance(here.at.point.map.position.xyz, next->position());
    stuck = moved < 1e-9 * step ? stuck + 1 : 0;
    // The last chord ends where this one begins: it does not count.
    const bool again = this->Chords.pass(next->leaving);
    if (lastChord)
    {
      this->Chords.add(lastChord->first, lastChord->second);
    }
    lastChord = { here, next->arriving };
    if (again)
    {
      this->Chords.add(lastChord->first, lastChord->second);
      return distanceToSegment(start.at.point.map.position.xyz, here.at.point.map.position.xyz,
               next->position()) < 0.5 * moved;
    }
    vertices.push_back(*next);
    here = next->leaving;
    chord = std::min(step, 1.5 * chord);
  }
  if (lastChord)
  {
    this->Chords.add(lastChord->first, lastChord->second);
  }
  return false;
}

RimTrace RimTracer::trace(const RimPoint& start, double step)
{
  RimTrace result;
  result.vertices.push_back({ start, start, false });
  result.closed = this->follow(start, step, 1.0, result.vertices);
  if (!result.closed)
  {
    std::vector<RimVertex> back;
    this->follow(start, step, -1.0, back);
    for (RimVertex& vertex : back)
    {
      std::swap(vertex.arriving, vertex.leaving);
    }
    result.vertices.insert(result.vertices.begin(), back.rbegin(), back.rend());
  }
  return result;
}

} // namespace hop
