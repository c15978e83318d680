#include "Edges/BoundaryTracer.h"

#include "Edges/FaceJumps.h"
#include "Edges/FacesAtEdges.h"
#include "Edges/TraceLimits.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hop
{
namespace
{

/// Which angles a trace tells apart. The cosines were chosen by experiment.
struct TraceAngles
{
  /// Cosine of the largest angle between the tangents at the two ends of a chord: 26 degrees. A chord that bends more
  /// is tried again at half its length. Nearer to 1 chords are shorter and cost more evaluations; farther from 1
  /// vertices and tangents tell less of the curve between them.
  static constexpr double LeastCosine = 0.9;
  /// Cosine of the smallest angle at an edge of the mesh that makes a corner: 20 degrees. A particle stands on every
  /// corner. Nearer to 1 slight corners tie particles down where they stand less evenly; farther from 1 corners are
  /// cut off.
  static constexpr double CornerCosine = 0.94;
  /// Sine of the smallest angle between the surface and a face that it leaves. With less the surface lies in the face,
  /// and what crosses is rounding errors. A larger one loses boundary curves where surface and face are nearly tangent.
  static constexpr double LeastSine = 1e-6;
};

/// How long chords are: lengths in units of the longest one, unless it is said otherwise. Chosen by experiment.
struct ChordLengths
{
  /// Largest chord, in units of the spacing wanted where it begins. Longer ones cost fewer
  /// evaluations, but particles are placed on a cubic between the ends of a chord, and start farther from the curve.
  static constexpr double Longest = 0.75;
  /// A boundary curve that cannot be followed by chords this short ends: all but tangent to its face it is not known to
  /// be there. Shorter ones cost evaluations at every dead end; longer ones give up at sharp bends.
  static constexpr double Shortest = 1.0 / 32.0;
  /// The same where curves end nowhere, as on surfaces that are cut and at the end of the mesh: they may bend within far
  /// less than the spacing at the place where the trace began.
  static constexpr double ShortestOnEndless = 1.0 / 16384.0;
  /// Where the surface goes on beyond its face, a boundary curve ends within this distance of the place at which the
  /// surface begins to go on. Shorter ones cost evaluations.
  static constexpr double ShortestAtFade = 1.0 / 4.0;
  /// A chord is tried at this many times the length of the chord before. More leads to more failed tries.
  static constexpr double Growth = 1.5;
  /// A chord shorter than this does not move: it passes from element to element in a corner of the mesh.
  static constexpr double Standstill = 1e-9;
  /// After so many chords in a row that do not move, a trace ends: it would go round for ever. Fewer than the elements
  /// around a corner could end a trace that gets on.
  static constexpr int MostStandstills = 8;
  /// Largest distance between the curve and the cubic of a chord, in units of the chord's length. Larger: where two parts
  /// of a curve turn back close to each other, a chord leads across; smaller: more evaluations.
  static constexpr double Unevenness = 0.01;
};

/// What rounding leaves between a face and places on it that the locator found, in half-space values of the face
/// (faceMargin(), of order one).
constexpr double locatedOnFace = 1e-6;

/// The least value between 0 and 1 of a cubic: from `first` to `last`, whose slopes there exceed the straight line's by
/// `ahead` and, at the end, `behind`.
double leastOf(double first, double last, double ahead, double behind)
{
  double least = std::min(first, last);
  // Where its derivative a t^2 - 2 b t + c is zero.
  const double a = 3.0 * (ahead + behind);
  const double b = 2.0 * ahead + behind;
  const double c = last - first + ahead;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  const double q = b < 0.0 ? b - root : b + root;
  for (const double t : { a != 0.0 ? q / a : 0.0, q != 0.0 ? c / q : 0.0 })
  {
    if (t > 0.0 && t < 1.0)
    {
      least = std::min(
        least, first + t * (last - first) + t * (1.0 - t) * ((1.0 - t) * ahead - t * behind));
    }
  }
  return least;
}

} // namespace

/// The boundary face on which a place lies, the preferred one if the place lies on several; -1 if there is none.
int BoundaryTracer::boundaryFaceOf(const Location& location, int preferred) const
{
  const auto liesOn = [&](int f) {
    return this->Surface.mayEnd(location.element, f) && isOnFace(*this->Surface.mesh, location, f);
  };
  if (preferred >= 0 && liesOn(preferred))
  {
    return preferred;
  }
  for (int f = 0; f < faceCount(*this->Surface.mesh, location); ++f)
  {
    if (liesOn(f))
    {
      return f;
    }
  }
  return -1;
}

bool BoundaryTracer::goesOnAt(const FaceCrossing& crossing, double farthest)
{
  if (!this->Surface.isOpenToBoth(crossing.location.element, crossing.face))
  {
    return false;
  }
  const Evaluated at = this->Passer.evaluate(crossing.location);
  return std::abs(at.point.value) <= farthest * length(at.point.gradient) &&
    !this->Passer.endsAt(at, crossing.face);
}

std::optional<BoundaryPoint> BoundaryTracer::project(
  const Location& start, int face, double maximumTravel)
{
  // Newton's method in all directions would leave the edge of an element, where a corner of the boundary curve may be.
  if (face >= 0 && isOnFace(*this->Surface.mesh, start, face))
  {
    const int other = otherFaceAt(*this->Surface.mesh, start, face, OnFace);
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
  const int found =
    this->boundaryFaceOf(at.location, at.location.element == start.element ? face : -1);
  if (found < 0)
  {
    return std::nullopt;
  }
  ActiveFaces held;
  held.add(found);
  return BoundaryPoint{ this->polished(at, held, maximumTravel), found };
}

/// A rough point after more of Newton's method along the faces that hold it. Steps are long where the surface is nearly
/// tangent to a face, and the field may have changed there: only at the end of a long step it is evaluated. Where the
/// surface all but lies in the face, all of the edge is within the tolerance, and such a step would lead to another
/// place of the curve.
/// \param farthest length of the chord that led to the point
Evaluated BoundaryTracer::polished(Evaluated at, const ActiveFaces& held, double farthest)
{
  constexpr double longStep =
    2.0; // in units of the tolerance; chosen by experiment, a smaller one costs evaluations
  // Of the chord. With a larger one curves along edges of elements end where F is c to the last bit; a smaller one
  // leaves rough points where chords are short.
  constexpr double longestShare = 1.0;
  constexpr int mostSteps = 4; // where that is not enough, the point stays as it is
  const Domain domain = this->Surface.mesh->elements[at.location.element].domain;
  for (int n = 0; this->IsRough && n < mostSteps; ++n)
  {
    FieldPoint& point = at.point;
    const ReferenceVector steepest = pullAlong(domain, held, point.map, point.gradient);
    const WorldVector along = point.map.push(steepest);
    const double rate = dot(along, point.gradient);
    const ReferenceVector du = (-point.value / rate) * steepest;
    if (!(rate > 0.0) || findExit(domain, at.location.u, du, held).face >= 0)
    {
      return at;
    }
    const WorldVector step = (-point.value / rate) * along;
    if (length(step) > longestShare * farthest)
    {
      return at;
    }
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
  return { size > TraceAngles::LeastSine * full ? along / size : glm::dvec3(0.0) };
}

ReferenceVector BoundaryTracer::velocity(const BoundaryPoint& point) const
{
  ActiveFaces held;
  held.add(point.face);
  return pullAlong(this->Surface.mesh->elements[point.at.location.element].domain, held,
    point.at.point.map, this->tangent(point));
}

/// Newton's method for F = c along the edge between two faces of an element.
/// \return nothing where the surface does not meet the edge; with ends of the surface at faces, however close it comes
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
      at = this->polished(at, edge, maximumTravel);
      const bool comesClose = this->IsRough && this->HasEnds && at.point.value != 0.0;
      return comesClose ? std::nullopt : std::optional<Evaluated>(at);
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

/// Crosses the face of a walk into the element behind it, and finds the face at the edge by which to leave that
/// element.
/// \return the place on the face if the surface ends there instead
std::optional<BoundaryPoint> BoundaryTracer::crossAtEdge(EdgeWalk& walk)
{
  const FaceNeighbor& neighbor = this->Surface.mesh->neighbor(walk.location.element, walk.face);
  int entry = neighbor.face;
  if (this->Surface.mayEnd(walk.location.element, walk.face))
  {
    walk.here = walk.here ? walk.here : this->Walker.evaluate(walk.location);
    const auto next = this->Passer.behind(*walk.here, walk.face);
    if (!next)
    {
      return BoundaryPoint{ *walk.here, walk.face };
    }
    walk.here = next->at;
    walk.location = next->at.location;
    entry = next->face;
  }
  else
  {
    walk.here.reset();
    const Location next = crossFace(*this->Surface.mesh, walk.location, walk.face);
    if (this->LooksForCreases || this->LooksForEnds)
    {
      this->lookBehind(walk.location, walk.face, next);
    }
    walk.location = next;
  }
  if (neighbor.element >= 0)
  {
    walk.face = faceAtEdge(*this->Surface.mesh, walk.location, entry, walk.corners);
    return std::nullopt;
  }
  walk.face = otherFaceAt(*this->Surface.mesh, walk.location, entry, locatedOnFace);
  if (walk.face >= 0)
  {
    walk.here.reset();
    walk.location = ontoFace(*this->Surface.mesh, walk.location, walk.face);
    walk.corners = edgeBetween(*this->Surface.mesh, walk.location, entry, walk.face);
  }
  return std::nullopt;
}

/// Remembers a face at which the surface turns, or ought to end: where it passes a corner of the face, no box need show
/// that.
/// \param there the place behind the face
void BoundaryTracer::lookBehind(const Location& here, int face, const Location& there)
{
  const Evaluated before = this->Walker.evaluate(here);
  const FaceNeighbor& neighbor = this->Surface.mesh->neighbor(here.element, face);
  const SurfaceWalker::Behind behind{ this->Walker.evaluate(there), neighbor.face };
  const double largestTurn = this->LooksForCreases ? CreaseAngle : std::acos(SheetCosine);
  const bool turns = angleBetween(before.point.gradient, behind.at.point.gradient) > largestTurn;
  const bool jumps = this->LooksForEnds &&
    !(SurfaceWalker::jumpBetween(*this->Surface.mesh, before, behind) <= this->PassedJump);
  if (turns || jumps)
  {
    this->OverlookedFaces.push_back(faceSlot(here.element, face));
    this->OverlookedFaces.push_back(faceSlot(neighbor.element, neighbor.face));
  }
}

/// From a boundary face across an edge to the next boundary face: that of the same element, or the one to which the
/// elements around the edge lead.
/// \param face the element's other face at the edge
std::optional<BoundaryPoint> BoundaryTracer::walkAroundEdge(
  const Evaluated& at, int boundaryFace, int face)
{
  constexpr int maximumElements =
    64; // more than meshes have around an edge: a walk that is longer goes round
  EdgeWalk walk{ at.location, at, face,
    edgeBetween(*this->Surface.mesh, at.location, boundaryFace, face) };
  for (int n = 0; n < maximumElements && walk.face >= 0; ++n)
  {
    if (const auto end = this->crossAtEdge(walk))
    {
      return end;
    }
  }
  return std::nullopt;
}

/// Moves a point along an edge of the mesh to where the surface of the point's own element meets the edge: faces that the
/// surface passes on the way around the edge may have small jumps. Without it no chord would begin on the surface. Where it
/// does not meet the edge within a spacing it ought to end at the face by which the walk has come.
void BoundaryTracer::findOwnPlace(BoundaryPoint& point)
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const int element = point.at.location.element;
  const double spacing = this->PassedJump / LargestJumpPerSpacing;
  const int entry = otherFaceAt(mesh, point.at.location, point.face, OnFace);
  if (entry < 0 || this->Surface.holds(point.at.point, spacing))
  {
    return;
  }
  if (const auto place = this->projectAlongEdge(point.at.location, point.face, entry, spacing))
  {
    point.at = *place;
  }
  else if (this->LooksForEnds && mesh.neighbor(element, entry).element >= 0)
  {
    const FaceNeighbor& neighbor = mesh.neighbor(element, entry);
    this->OverlookedFaces.push_back(faceSlot(element, entry));
    this->OverlookedFaces.push_back(faceSlot(neighbor.element, neighbor.face));
  }
}

/// The vertex on an edge of the mesh that a boundary curve comes to.
/// \param u a place near the vertex, on the edge between the curve's face and another one
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
  auto beyond = this->walkAroundEdge(*at, from.face, otherFace);
  if (!beyond)
  {
    return {};
  }
  if (this->HasEnds)
  {
    this->findOwnPlace(*beyond);
  }
  BoundaryVertex vertex{ { *at, from.face }, *beyond, false };
  vertex.corner = isCutAt(this->Surface, vertex.arriving) ||
    isCutAt(this->Surface, vertex.leaving) ||
    dot(this->tangent(vertex.arriving), this->tangent(vertex.leaving)) < TraceAngles::CornerCosine;
  return { vertex, false };
}

/// The step in reference space that leads a world distance ahead: Adams and Bashforth's of second order, if the
/// boundary curve came along the same face, else Euler's.
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

/// Whether a curve keeps to the face between two points: the distances from the face's edges are cubics, by
/// their values and slopes at both points. A curve that leaves the face and comes back has two vertices more, which its
/// other side may see. A chord leads past a corner to another face or element only where the surface is not cut, nor ends
/// along faces.
bool BoundaryTracer::staysOnFace(const BoundaryPoint& from, const BoundaryPoint& to) const
{
  if (to.at.location.element != from.at.location.element || to.face != from.face)
  {
    return !this->HasCuts && !this->HasEnds;
  }
  const ReferenceVector chord = to.at.location.u - from.at.location.u;
  const double length = glm::distance(from.at.point.map.position.xyz, to.at.point.map.position.xyz);
  const ReferenceVector start = this->velocity(from);
  const ReferenceVector end = this->velocity(to);
  const double way = dot(chord, start + end) < 0.0 ? -length : length;
  const auto& faces = facts(this->Surface.mesh->elements[from.at.location.element].domain).faces;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    const ReferenceVector inward{ faces[f].inward };
    const double first = faceMargin(faces[f], from.at.location.u);
    const double last = faceMargin(faces[f], to.at.location.u);
    const double ahead = way * dot(inward, start) - (last - first);
    const double behind = way * dot(inward, end) - (last - first);
    if (f != from.face && leastOf(first, last, ahead, behind) < -OnFace)
    {
      return false;
    }
  }
  return true;
}

/// Whether a curve comes back from behind an edge of its face, where it was to leave the face: it passed the edge before.
bool BoundaryTracer::entersAt(const BoundaryPoint& point, int edge, double direction) const
{
  constexpr double along = 1e-9; // rounding
  const ReferenceVector velocity = direction * this->velocity(point);
  const ReferenceVector& inward = this->Surface.mesh->face(point.at.location.element, edge).inward;
  return dot(inward, velocity) > along * std::sqrt(dot(velocity, velocity) * dot(inward, inward));
}

/// Whether a curve bends between two points as its tangents there say. Where it turns back close to another part of it, at
/// a saddle of the field on the face, a chord may lead across to that part, with nearly the same tangent.
bool BoundaryTracer::bendsEvenly(const BoundaryPoint& from, const BoundaryPoint& to)
{
  const ReferenceVector chord = to.at.location.u - from.at.location.u;
  const double length = glm::distance(from.at.point.map.position.xyz, to.at.point.map.position.xyz);
  const ReferenceVector start = this->velocity(from);
  const ReferenceVector end = this->velocity(to);
  const double way = dot(chord, start + end) < 0.0 ? -length : length;
  // The middle of the cubic by places and slopes at both ends.
  const ReferencePoint middle{ 0.5 * (from.at.location.u.xyz + to.at.location.u.xyz) +
    0.125 * way * (start.xyz - end.xyz) };
  const auto point = this->Walker.evaluate({ from.at.location.element, middle }).point;
  const glm::dvec3 aside = glm::cross(point.gradient.xyz,
    glm::normalize(glm::transpose(point.map.inverse) *
      this->Surface.mesh->face(from.at.location.element, from.face).inward.xyz));
  // Vertices lie on the surface to the tolerance.
  return std::abs(point.value) <= ChordLengths::Unevenness * length * glm::length(aside) +
    2.0 * this->Surface.tolerance * hop::length(point.gradient);
}

/// Whether a step keeps its distance from a face, to rounding.
bool BoundaryTracer::runsAlong(int element, int face, const ReferenceVector& step) const
{
  return std::abs(dot(this->Surface.mesh->face(element, face).inward, step)) < OnFace;
}

/// The face of a point, and another one that holds the point and that a step leaves by no more than rounding: where the
/// surface all but lies in that face, the curve runs along it. Where the surface lies in the face, the edge is passed,
/// but for a curve that has just passed an edge without moving: the element behind might send it back.
ActiveFaces BoundaryTracer::facesAlong(const Heading& heading, const ReferenceVector& step) const
{
  constexpr double inFace = 1e-14; // half-space value: rounding of places on a face
  const BoundaryPoint& from = heading.here;
  const Location& here = from.at.location;
  ActiveFaces faces;
  faces.add(from.face);
  for (int f = 0; f < faceCount(*this->Surface.mesh, here) && faces.count < 2; ++f)
  {
    if (f != from.face && isOnFace(*this->Surface.mesh, here, f) &&
      (heading.standsStill ||
        faceMargin(this->Surface.mesh->face(here.element, f), here.u) > inFace) &&
      this->runsAlong(here.element, f, step))
    {
      faces.add(f);
    }
  }
  return faces;
}

/// The next vertex, `step` ahead or on the next edge of the mesh.
BoundaryTracer::Ahead BoundaryTracer::advance(const Heading& heading, double step)
{
  const BoundaryPoint& from = heading.here;
  const Domain domain = this->Surface.mesh->elements[from.at.location.element].domain;
  const ReferenceVector du = this->predict(heading, step);
  ActiveFaces held = this->facesAlong(heading, du);
  const auto endOfStep = [&]()
  {
    const Exit exit = findExit(domain, from.at.location.u, du, held);
    return std::pair{ exit.face, from.at.location.u + exit.fraction * du };
  };
  auto [edge, u] = endOfStep();
  Ahead passed = edge >= 0 ? this->passEdge(from, u, edge, step) : Ahead{};
  if (passed.vertex && !this->crosses(passed.vertex->leaving) && held.count == 1 &&
    this->runsAlong(from.at.location.element, edge, du))
  {
    // The surface lies in the face behind the edge, and no curve goes on there, but one may along the edge.
    held.add(edge);
    std::tie(edge, u) = endOfStep();
    passed = edge >= 0 ? this->passEdge(from, u, edge, step) : Ahead{};
  }
  if (edge >= 0)
  {
    // At a saddle of the field on the face, a chord may lead across to another part of the curve, which runs the other way.
    const bool isAcross = passed.vertex &&
      (dot(this->tangent(passed.vertex->arriving), this->tangent(from)) < 0.0 ||
        (this->HasEnds && this->entersAt(passed.vertex->arriving, edge, heading.direction)) ||
        (this->HasCuts && !this->bendsEvenly(from, passed.vertex->arriving)));
    return isAcross ? Ahead{} : passed;
  }
  const auto next = this->project({ from.at.location.element, u }, from.face, step);
  if (!next || dot(this->tangent(*next), this->tangent(from)) < TraceAngles::LeastCosine ||
    ((this->HasCuts || this->HasEnds) && !this->staysOnFace(from, *next)) ||
    (this->HasCuts && !this->bendsEvenly(from, *next)))
  {
    return {};
  }
  if (!this->isOnBoundary(*next))
  {
    return { std::nullopt, true };
  }
  return { BoundaryVertex{ *next, *next, false }, false };
}

/// The next vertex. Chords are tried from a length on, each half as long as the one before.
/// \param chord length of the first try; on return that of the last
std::optional<BoundaryVertex> BoundaryTracer::advanceAtMost(
  double& chord, double step, const Heading& heading)
{
  const BoundaryPoint& here = heading.here;
  const bool isEndless =
    this->HasCuts || !this->Surface.isOpenToBoth(here.at.location.element, here.face);
  // A step of zero, where single precision has no spacing as small, would be halved for ever.
  const double least = isEndless ? ChordLengths::ShortestOnEndless : ChordLengths::Shortest;
  for (double shortest = least * step; chord > 0.0 && chord >= shortest; chord *= 0.5)
  {
    const Ahead ahead = this->advance(heading, chord);
    if (ahead.vertex)
    {
      return ahead.vertex;
    }
    shortest = ahead.surfaceGoesOn ? ChordLengths::ShortestAtFade * step : shortest;
  }
  return std::nullopt;
}

/// Whether the last vertex of a closed curve knows better than the first one how the curve comes there: the start lies on
/// an edge of the mesh, or right behind a corner.
/// \param start of which `corner` tells that it lies on an edge
bool BoundaryTracer::replacesStart(const BoundaryVertex& last, const BoundaryVertex& start) const
{
  const BoundaryPoint& to = start.leaving;
  const bool leadsToStart =
    last.leaving.at.location.element == to.at.location.element && last.leaving.face == to.face;
  const bool isCut = isCutAt(this->Surface, last.arriving) || isCutAt(this->Surface, last.leaving);
  return leadsToStart ? last.corner || start.corner : last.corner && isCut;
}

/// Remembers what is traced. A chord may lead past a corner of an element to another one, which has the rest of it. (Two
/// elements whose surfaces jump have curves of their own.)
/// \param way of both ends, see BoundaryChords::Chord
void BoundaryTracer::addChord(
  const BoundaryPoint& from, const BoundaryPoint& to, const std::array<double, 2>& way)
{
  BoundaryChords::Chord chord(from, to, this->tangent(from));
  chord.way = way;
  chord.trace = this->Trace;
  const auto isLast = [this](const BoundaryPoint& end)
  {
    return this->HasEnds &&
      otherFaceAt(*this->Surface.mesh, end.at.location, end.face, OnFace) >= 0;
  };
  chord.isLast = { isLast(from), isLast(to) };
  this->Chords.add(chord);
  const int there = to.at.location.element;
  if (there != from.at.location.element && this->Surface.mesh->neighbor(there, to.face).element < 0)
  {
    BoundaryChords::Chord back(to, from, this->tangent(to));
    back.way = { way[1], way[0] };
    back.trace = this->Trace;
    this->Chords.add(back);
  }
}

/// Follows a boundary curve in one direction, and adds its vertices behind the start.
/// \param direction 1 or -1, of velocity()
/// \return whether the boundary curve came back to its start
bool BoundaryTracer::follow(const BoundaryVertex& start, const SpacingAt& spacingAt,
  double direction, std::vector<BoundaryVertex>& vertices, const ParallelFor& parallelFor)
{
  BoundaryPoint here = start.leaving;
  std::optional<Passed> before;
  std::optional<std::array<BoundaryPoint, 2>> lastChord;
  std::array<double, 2> lastWay{};
  const auto addLast = [&]()
  {
    if (lastChord)
    {
      this->addChord((*lastChord)[0], (*lastChord)[1], lastWay);
    }
  };
  double spacing = start.spacing;
  double step = ChordLengths::Longest * spacing;
  double chord = step;
  double firstChord = 0.0;
  int standstills = 0;
  TraceLimits limits(*this->Surface.mesh);
  bool isPossible = true;
  while (isPossible && standstills <= ChordLengths::MostStandstills)
  {
    askCaller(parallelFor);
    this->PassedJump = LargestJumpPerSpacing * spacing;
    const ReferenceVector velocity = this->velocity(here);
    auto next =
      this->advanceAtMost(chord, step, { here, velocity, direction, before, standstills > 0 });
    if (!next)
    {
      break;
    }
    const WorldPoint& position = here.at.point.map.position;
    const double moved = glm::distance(position.xyz, next->position());
    firstChord = lastChord ? firstChord : moved;
    standstills = moved < ChordLengths::Standstill * step ? standstills + 1 : 0;
    isPossible = limits.admit(here.at.location, here.face, next->arriving.at.location);
    // The last chord ends where this one begins, and is added only now: it would be met at once.
    const double way = lastWay[1] + direction * moved;
    // Elsewhere a trace would go on in ever shorter chords at a point in which the surface is singular.
    const BoundaryChords::Tip tip{ next->leaving, this->tangent(next->leaving), way, this->Trace };
    const bool again = this->HasEnds ? this->Chords.meet(tip) : this->Chords.pass(tip);
    addLast();
    lastChord = { here, next->arriving };
    lastWay = { lastWay[1], way };
    if (again)
    {
      addLast();
      // A trace that meets another boundary curve, not its own start, is open.
      const glm::dvec3& begin = start.position();
      const bool isClosed = distanceToSegment(begin, position.xyz, next->position()) <
        (this->HasCuts || this->HasEnds
            ? std::max(0.5 * moved, BoundaryChords::PassShare * firstChord)
            : 0.5 * moved);
      if (isClosed && direction > 0.0 && this->replacesStart(*next, vertices.front()))
      {
        next->spacing = start.spacing;
        vertices.front() = *next;
      }
      return isClosed;
    }
    spacing = spacingAt(next->leaving);
    next->spacing = spacing;
    vertices.push_back(*next);
    before = Passed{ here.at.location.element, here.face, position, velocity };
    here = next->leaving;
    step = ChordLengths::Longest * spacing;
    chord = std::min(step, ChordLengths::Growth * chord);
  }
  addLast();
  return false;
}

BoundaryTrace BoundaryTracer::trace(
  const BoundaryPoint& start, const SpacingAt& spacingAt, const ParallelFor& parallelFor)
{
  BoundaryTrace result;
  ++this->Trace;
  // On an edge of an element the boundary curve may have a corner: how it comes there is not known yet.
  const bool isOnEdge =
    otherFaceAt(*this->Surface.mesh, start.at.location, start.face, OnFace) >= 0;
  const BoundaryVertex first{ start, start, isOnEdge, spacingAt(start) };
  result.vertices.push_back(first);
  result.closed = this->follow(first, spacingAt, 1.0, result.vertices, parallelFor);
  if (!result.closed)
  {
    std::vector<BoundaryVertex> back;
    this->follow(first, spacingAt, -1.0, back, parallelFor);
    for (BoundaryVertex& vertex : back)
    {
      std::swap(vertex.arriving, vertex.leaving);
    }
    result.vertices.insert(result.vertices.begin(), back.rbegin(), back.rend());
  }
  return result;
}

} // namespace hop
