#include "Edges/BoundaryTracer.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// Cosine of the largest turn from chord to chord, and of the turn that makes a corner.
constexpr double leastCosine = 0.9;
constexpr double cornerCosine = 0.94;
/// A boundary curve that cannot be followed by chords that short, in units of the step, ends: all but tangent to its
/// face it is not known to be there.
constexpr double smallestChord = 1.0 / 32.0;
/// Where the surface goes on beyond its face, a boundary curve ends that near to where it does.
constexpr double fadingChord = 1.0 / 4.0;
constexpr int mostStuck = 8;
/// A chord passes a point that is nearer to it than this, in units of its length.
constexpr double nearness = 0.2;
/// Surface and face turned less against each other than this have no boundary curve: the surface lies in the face, and
/// what crosses is rounding errors.
constexpr double liesInFace = 1e-6;
/// What rounding leaves between a face and places on it that were located.
constexpr double locatedOnFace = 1e-6;

double distanceToSegment(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b)
{
  const glm::dvec3 d = b - a;
  const double length2 = glm::dot(d, d);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(x - a, d) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(x, a + t * d);
}

/// Whether two lines in a plane cross or touch, to what single precision leaves.
bool meet(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b)
{
  constexpr double rounding = 1e-6;
  const auto lieApart =
    [](const std::array<glm::dvec3, 2>& before, const std::array<glm::dvec3, 2>& behind)
  {
    const glm::dvec3 gap = glm::min(behind[0], behind[1]) - glm::max(before[0], before[1]);
    return glm::any(glm::greaterThan(gap, glm::dvec3(10.0 * rounding)));
  };
  if (lieApart(a, b) || lieApart(b, a))
  {
    return false; // boxes around them are apart, as most are
  }
  const glm::dvec3 along = b[1] - b[0];
  const double length = glm::length(along);
  const glm::dvec3 normal = glm::cross(along, a[1] - a[0]);
  const double size = glm::length(normal);
  if (!(size > rounding * rounding))
  {
    return false; // one of them is a point, or they are parallel
  }
  const glm::dvec3 aside = glm::cross(normal, along) / (size * length);
  const double first = glm::dot(aside, a[0] - b[0]);
  const double last = glm::dot(aside, a[1] - b[0]);
  const double t = std::clamp(first / (first - last), 0.0, 1.0);
  const glm::dvec3 nearest = glm::mix(a[0], a[1], t);
  const double reached = glm::dot(nearest - b[0], along) / length;
  return std::abs(glm::dot(aside, nearest - b[0])) <= rounding && reached >= -rounding &&
    reached <= length + rounding;
}

} // namespace

BoundaryChords::Chord::Chord(const BoundaryPoint& from, const BoundaryPoint& to)
  : face(faceSlot(from.at.location.element, from.face))
  , positions{ from.at.point.map.position.xyz, to.at.point.map.position.xyz }
  , gradient(from.at.point.gradient)
{
  const Location& first = from.at.location;
  const Location& last = to.at.location;
  // A chord that leaves its element is known by its first place there.
  this->places = { first.u.xyz, (last.element == first.element ? last : first).u.xyz };
}

bool BoundaryChords::pass(const BoundaryPoint& point) const
{
  const auto found = this->Chords.find(faceSlot(point.at.location.element, point.face));
  const glm::dvec3& x = point.at.point.map.position.xyz;
  return found != this->Chords.end() &&
    std::any_of(found->second.begin(), found->second.end(),
      [&](const Chord& chord)
      {
        const auto& [a, b] = chord.positions;
        return distanceToSegment(x, a, b) <= nearness * glm::distance(a, b) &&
          dot(chord.gradient, point.at.point.gradient) > 0.0;
      });
}

bool BoundaryChords::cross(int element, int face, const std::array<glm::dvec3, 2>& ends) const
{
  const auto found = this->Chords.find(faceSlot(element, face));
  return found != this->Chords.end() &&
    std::any_of(found->second.begin(), found->second.end(),
      [&ends](const Chord& chord) { return meet(chord.places, ends); });
}

/// The face at which the surface may end on which a place lies, the preferred one if it is among them; -1
/// if none.
int BoundaryTracer::wallOf(const Location& location, int preferred) const
{
  const auto onWall = [&](int f) {
    return this->Surface.mayEnd(location.element, f) && isOnFace(*this->Surface.mesh, location, f);
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

bool BoundaryTracer::goesOnAt(const FaceCrossing& crossing, double nearest)
{
  if (!this->Surface.isUndecided(crossing.location.element, crossing.face))
  {
    return false;
  }
  const Evaluated at = this->Passer.evaluate(crossing.location);
  return std::abs(at.point.value) <= nearest * length(at.point.gradient) &&
    !this->Passer.endsAt(at, crossing.face);
}

std::optional<BoundaryPoint> BoundaryTracer::project(
  const Location& start, int face, double maximumTravel)
{
  // Newton's method in all directions would leave the edge of an element, where a corner of the boundary curve may be.
  if (face >= 0 && isOnFace(*this->Surface.mesh, start, face))
  {
    const int other = this->otherFaceAt(start, face, OnFace);
    const auto corner =
      other >= 0 ? this->projectAlongEdge(start, face, other, maximumTravel) : std::nullopt;
    if (corner)
    {
      return BoundaryPoint{ *corner, face };
    }
  }
  Evaluated at;
  if (!this->Walker.project(start, maximumTravel, at, true))
  {
    return std::nullopt;
  }
  const int wall = this->wallOf(at.location, at.location.element == start.element ? face : -1);
  if (wall < 0)
  {
    return std::nullopt;
  }
  ActiveFaces walls;
  walls.add(wall);
  return BoundaryPoint{ this->polished(at, walls), wall };
}

/// Rough points after more of Newton's method along a face or two. Only steps so long that the field may
/// have changed are evaluated at their end: where the surface all but touches the face they can be.
Evaluated BoundaryTracer::polished(Evaluated at, const ActiveFaces& walls)
{
  constexpr double longStep = 2.0; // in units of the tolerance
  constexpr int mostSteps = 4;
  const Domain domain = this->Surface.mesh->elements[at.location.element].domain;
  for (int n = 0; this->IsRough && n < mostSteps; ++n)
  {
    FieldPoint& point = at.point;
    const ReferenceVector steepest = pullAlong(domain, walls, point.map, point.gradient);
    const WorldVector along = point.map.push(steepest);
    const double rate = dot(along, point.gradient);
    const ReferenceVector du = (-point.value / rate) * steepest;
    if (!(rate > 0.0) || findExit(domain, at.location.u, du, walls).face >= 0)
    {
      return at;
    }
    const WorldVector step = (-point.value / rate) * along;
    if (length(step) <= longStep * this->Surface.tolerance)
    {
      at.location.u = at.location.u + du;
      point.map.position = point.map.position + step;
      point.value = 0.0;
      return at;
    }
    at = this->Walker.evaluate({ at.location.element, at.location.u + du });
  }
  return at;
}

WorldVector BoundaryTracer::tangent(const BoundaryPoint& point) const
{
  const LocalMap& map = point.at.point.map;
  const glm::dvec3 inward = glm::transpose(map.inverse) *
    this->Surface.mesh->face(point.at.location.element, point.face).inward.xyz;
  const glm::dvec3 along = glm::cross(-point.at.point.gradient.xyz, inward);
  const double size = glm::length(along);
  const double full = length(point.at.point.gradient) * glm::length(inward);
  return { size > liesInFace * full ? along / size : glm::dvec3(0.0) };
}

ReferenceVector BoundaryTracer::velocity(const BoundaryPoint& point) const
{
  ActiveFaces wall;
  wall.add(point.face);
  return pullAlong(this->Surface.mesh->elements[point.at.location.element].domain, wall,
    point.at.point.map, this->tangent(point));
}

/// Newton's method for F = c along the edge between two faces of an element.
std::optional<Evaluated> BoundaryTracer::projectAlongEdge(
  const Location& start, int faceA, int faceB, double maximumTravel)
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const Domain domain = mesh.elements[start.element].domain;
  ActiveFaces edge;
  edge.add(faceA);
  edge.add(faceB);
  const glm::dvec3 direction = glm::cross(
    mesh.face(start.element, faceA).inward.xyz, mesh.face(start.element, faceB).inward.xyz);
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
      return this->polished(at, edge);
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

std::vector<std::int64_t> BoundaryTracer::cornersOf(const Location& location, int face) const
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const Face& which = mesh.face(location.element, face);
  std::vector<std::int64_t> numbers;
  for (int c = 0; c < which.cornerCount; ++c)
  {
    numbers.push_back(mesh.elements[location.element].corners[which.corners[c]]);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// The other face of an element that has the corners of an edge; -1 if there is none.
int BoundaryTracer::faceAtEdge(
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

/// Another face of an element than one of them on which a place lies; -1 if there is none.
int BoundaryTracer::otherFaceAt(const Location& location, int one, double accuracy) const
{
  const auto count =
    static_cast<int>(facts(this->Surface.mesh->elements[location.element].domain).faces.size());
  for (int f = 0; f < count; ++f)
  {
    if (f != one && isOnFace(*this->Surface.mesh, location, f, accuracy))
    {
      return f;
    }
  }
  return -1;
}

Location BoundaryTracer::ontoFace(const Location& location, int face) const
{
  const Face& which = this->Surface.mesh->face(location.element, face);
  const glm::dvec3& inward = which.inward.xyz;
  return { location.element,
    { location.u.xyz - faceMargin(which, location.u) / glm::dot(inward, inward) * inward } };
}

/// From a wall across an edge to the wall behind it: that of the same element, or that to which the
/// elements around the edge lead, one through the next.
std::optional<BoundaryPoint> BoundaryTracer::turnAroundEdge(const Evaluated& at, int wall, int face)
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
  std::optional<Evaluated> here = at;
  for (int n = 0; n < maximumElements; ++n)
  {
    const FaceNeighbor& neighbor = this->Surface.mesh->neighbor(location.element, face);
    int entry = neighbor.face;
    if (this->Surface.mayEnd(location.element, face))
    {
      here = here ? here : this->Walker.evaluate(location);
      const auto next = this->Passer.behind(*here, face);
      if (!next)
      {
        return BoundaryPoint{ *here, face };
      }
      here = next->at;
      location = next->at.location;
      entry = next->face;
    }
    else
    {
      here.reset();
      location = crossFace(*this->Surface.mesh, location, face);
    }
    const bool joined = neighbor.element >= 0;
    face = joined ? this->faceAtEdge(location, entry, edge)
                  : this->otherFaceAt(location, entry, locatedOnFace);
    if (face < 0)
    {
      return std::nullopt;
    }
    if (!joined)
    {
      here.reset();
      location = this->ontoFace(location, face);
      edge = edgeBetween(location, entry, face);
    }
  }
  return std::nullopt;
}

BoundaryTracer::Ahead BoundaryTracer::passEdge(
  const BoundaryPoint& from, const ReferencePoint& u, int otherFace, double step)
{
  const auto at =
    this->projectAlongEdge({ from.at.location.element, u }, from.face, otherFace, step);
  if (!at)
  {
    return {};
  }
  if (!this->isOnBoundary({ *at, from.face }))
  {
    return { std::nullopt, true };
  }
  const auto beyond = this->turnAroundEdge(*at, from.face, otherFace);
  if (!beyond)
  {
    return {};
  }
  BoundaryVertex vertex{ { *at, from.face }, *beyond, false };
  vertex.corner = dot(this->tangent(vertex.arriving), this->tangent(vertex.leaving)) < cornerCosine;
  return { vertex, false };
}

/// The step in reference space that leads that far ahead: that of Adams and Bashforth, of second order, if
/// the boundary curve came along the same face.
ReferenceVector BoundaryTracer::predict(const Heading& heading, double step) const
{
  const BoundaryPoint& here = heading.here;
  const ReferenceVector& now = heading.velocity;
  const auto& before = heading.before;
  if (!before || before->face != here.face || before->element != here.at.location.element)
  {
    return (heading.direction * step) * now;
  }
  const double come = glm::distance(before->position.xyz, here.at.point.map.position.xyz);
  const ReferenceVector change = now - before->velocity;
  const double weight = std::min(1.0, 0.5 * step / come);
  return (heading.direction * step) * (now + weight * change);
}

/// The next vertex, `step` ahead or on the next edge of the mesh.
BoundaryTracer::Ahead BoundaryTracer::advance(const Heading& heading, double step)
{
  const BoundaryPoint& from = heading.here;
  const Domain domain = this->Surface.mesh->elements[from.at.location.element].domain;
  ActiveFaces wall;
  wall.add(from.face);
  const ReferenceVector du = this->predict(heading, step);
  const Exit exit = findExit(domain, from.at.location.u, du, wall);
  const ReferencePoint u = from.at.location.u + exit.fraction * du;
  if (exit.face >= 0)
  {
    return this->passEdge(from, u, exit.face, step);
  }
  const auto next = this->project({ from.at.location.element, u }, from.face, step);
  if (!next || dot(this->tangent(*next), this->tangent(from)) < leastCosine)
  {
    return {};
  }
  if (!this->isOnBoundary(*next))
  {
    return { std::nullopt, true };
  }
  return { BoundaryVertex{ *next, *next, false }, false };
}

/// The next vertex after chords tried from one length on, each half as long as the one before.
std::optional<BoundaryVertex> BoundaryTracer::advanceAtMost(
  double& chord, double step, const Heading& heading)
{
  for (double shortest = smallestChord * step; chord >= shortest; chord *= 0.5)
  {
    const Ahead ahead = this->advance(heading, chord);
    if (ahead.vertex)
    {
      return ahead.vertex;
    }
    shortest = ahead.fades ? fadingChord * step : shortest;
  }
  return std::nullopt;
}

/// \return whether the boundary curve came back to its start
bool BoundaryTracer::follow(
  const BoundaryPoint& start, double step, double direction, std::vector<BoundaryVertex>& vertices)
{
  BoundaryPoint here = start;
  std::optional<Passed> before;
  std::optional<BoundaryChords::Chord> lastChord;
  const auto addLast = [&]()
  {
    if (lastChord)
    {
      this->Chords.add(*lastChord);
    }
  };
  double chord = step;
  int stuck = 0;
  while (stuck <= mostStuck)
  {
    const ReferenceVector velocity = this->velocity(here);
    const auto next = this->advanceAtMost(chord, step, { here, velocity, direction, before });
    if (!next)
    {
      break;
    }
    const WorldPoint& position = here.at.point.map.position;
    const double moved = glm::distance(position.xyz, next->position());
    stuck = moved < 1e-9 * step ? stuck + 1 : 0;
    // The last chord ends where this one begins: it does not count.
    const bool again = this->Chords.pass(next->leaving);
    addLast();
    lastChord.emplace(here, next->arriving);
    if (again)
    {
      addLast();
      return distanceToSegment(start.at.point.map.position.xyz, position.xyz, next->position()) <
        0.5 * moved;
    }
    vertices.push_back(*next);
    before = Passed{ here.at.location.element, here.face, position, velocity };
    here = next->leaving;
    chord = std::min(step, 1.5 * chord);
  }
  addLast();
  return false;
}

BoundaryTrace BoundaryTracer::trace(const BoundaryPoint& start, double step)
{
  BoundaryTrace result;
  // On an edge of an element the boundary curve may turn; how it comes there is not known yet.
  const bool isOnEdge = this->otherFaceAt(start.at.location, start.face, OnFace) >= 0;
  result.vertices.push_back({ start, start, isOnEdge });
  result.closed = this->follow(start, step, 1.0, result.vertices);
  if (!result.closed)
  {
    std::vector<BoundaryVertex> back;
    this->follow(start, step, -1.0, back);
    for (BoundaryVertex& vertex : back)
    {
      std::swap(vertex.arriving, vertex.leaving);
    }
    result.vertices.insert(result.vertices.begin(), back.rbegin(), back.rend());
  }
  return result;
}

} // namespace hop
