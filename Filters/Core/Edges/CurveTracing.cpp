#include "Edges/CurveTracing.h"

#include "Edges/FaceJumps.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// How boundary curves are found and followed: lengths in units of the spacing wanted nearby. Chosen by experiment.
struct Tracing
{
  /// Largest distance from the surface, by which a vertex may miss it: particles are taken to the tolerance later.
  static constexpr double Tolerance = 1e-2;
  /// The same of curves for meshes, whose vertices on edges of the mesh tell which creases meet and where pieces of surface
  /// end. Larger: where the surface passes close to an edge or a corner of the mesh, curves leave a face by the wrong edge;
  /// smaller: more evaluations.
  static constexpr double ToleranceForMesh = 1e-5;
  /// Within this distance of the surface a crossing tells whether the surface ends there. A larger one believes values
  /// and slopes too far off; with a smaller one more starts are put onto the surface in vain.
  static constexpr double CrossingReach = 0.2;
  /// Largest jump, as far as samples tell, at which the two sides of a face are taken to meet: a crossing with less is
  /// no hint of a boundary curve. Curves that begin at such a place are found by their other hints. A smaller one costs
  /// evaluations; a larger one overlooks curves along small jumps.
  static constexpr double MeetingJump = 0.6 * LargestJumpPerSpacing;
  /// Largest distance on the way from a hint to the curve. A larger one may lead to another curve.
  static constexpr double LongestWay = 4.0;
  /// Largest distance of the ends of a crease as its two sides see it. Vertices on edges of the mesh are much nearer to
  /// each other; a larger one may take one crease for another.
  static constexpr double SamePlace = 0.1;
  /// Largest distance of a corner that serves as well as the place where the curve passes a plane between two workers.
  /// Short stretches are sampled unevenly: a smaller one leaves stretches of less than two spacings; a larger one lets
  /// the two workers' particles beside the plane differ more.
  static constexpr double NearCorner = 1.6;
};

/// The surface for the tracer. Chords need not lie on it as exactly as particles.
Isosurface roughly(Isosurface surface, double spacing, bool isForMesh)
{
  const double tolerance = isForMesh ? Tracing::ToleranceForMesh : Tracing::Tolerance;
  surface.tolerance = std::max(surface.tolerance, tolerance * spacing);
  return surface;
}

/// Whether a curve is in one place, as in a corner of the mesh in which it passes from element to element.
bool hasNoLength(const std::vector<BoundaryVertex>& vertices, double tolerance)
{
  return std::all_of(vertices.begin(), vertices.end(),
    [&](const BoundaryVertex& vertex)
    { return glm::distance(vertex.position(), vertices.front().position()) <= tolerance; });
}

/// Whether a curve is at the same corner, and goes on along the same face.
bool isSame(const BoundaryVertex& a, const BoundaryVertex& b, double spacing)
{
  return a.corner && b.corner && a.leaving.at.location.element == b.leaving.at.location.element &&
    a.leaving.face == b.leaving.face &&
    glm::distance(a.position(), b.position()) <= Tracing::Tolerance * spacing;
}

} // namespace

CurveTracing::CurveTracing(const Isosurface& surface, bool isForMesh, const SurfaceProxy& proxy,
  const SizingFunction& sizing, const Slab& slab, const Slab& reach)
  : Surface(surface)
  , Proxy(proxy)
  , Sizing(sizing)
  , Part(slab)
  , Reach(reach)
  , Samples(*surface.mesh, proxy)
  , Tracer(roughly(surface, proxy.smallestSpacing(), isForMesh), BoundaryTracer::Points::Rough)
  , Between(surface, proxy, sizing, this->Tracer)
{
}

/// The hints of each box.
std::vector<std::vector<CurveTracing::Hint>> CurveTracing::findHints(
  const ParallelFor& parallelFor) const
{
  const ElementMesh& mesh = *this->Surface.mesh;
  std::vector<std::vector<Hint>> hints(this->Proxy.boxes().size());
  forAll(parallelFor, hints.size(),
    [&](std::size_t b)
    {
      const SurfaceBox& box = this->Proxy.boxes()[b];
      const SurfaceProxy::Sample& sample = this->Proxy.samples()[b];
      visitFaceCrossings(
        mesh, box, [&](int face) { return this->Surface.mayEnd(box.middle.element, face); },
        [&](const FaceCrossing& crossing)
        {
          // Along all of a face the surface ends where the field does not jump there, too.
          const bool endsAlongFace =
            this->Surface.jumpTolerance(box.middle.element, crossing.face) <= 0.0;
          if (endsAlongFace || !this->Samples.meet(crossing, sample, Tracing::MeetingJump))
          {
            hints[b].push_back(
              { crossing, sample.found ? sample.patch.spacing : this->Sizing.spacing });
          }
        });
    });
  return hints;
}

bool CurveTracing::isInReach(const Location& place) const
{
  return this->Reach.isEverything() ||
    this->Reach.holds(
      glm::dvec3(evaluateGradient(this->Surface.mesh->form(place.element), place.u).value));
}

BoundaryTrace CurveTracing::traceFrom(const BoundaryPoint& start, const ParallelFor& parallelFor)
{
  const auto spacingAt = [this](const BoundaryPoint& point)
  { return this->Between.spacingAt(point.at.location); };
  return this->Tracer.trace(start, spacingAt, parallelFor);
}

/// Traces the curve that a hint leads to, unless there is none or it is traced.
void CurveTracing::follow(const Hint& hint, const ParallelFor& parallelFor)
{
  const FaceCrossing& crossing = hint.crossing;
  const double nearby = hint.spacing;
  if (!this->isInReach(crossing.location) || this->Tracer.isTraced(crossing) ||
    this->Tracer.goesOnAt(crossing, Tracing::CrossingReach * nearby))
  {
    return;
  }
  const auto start =
    this->Tracer.project(crossing.location, crossing.face, Tracing::LongestWay * nearby);
  if (!start || this->Tracer.isTraced(*start) || !this->Tracer.crosses(*start) ||
    !this->Tracer.isOnBoundary(*start))
  {
    return;
  }
  this->keep(this->traceFrom(*start, parallelFor), nearby);
}

/// Where a chord of a boundary curve passes a plane of the slab.
std::optional<BoundaryPoint> CurveTracing::passageBetween(
  const BoundaryVertex& from, const BoundaryVertex& to, double plane)
{
  // The curve departs from the chord by a tenth of it at most, so that each step leaves a hundredth of the error.
  constexpr int steps = 3;
  const double begin = this->Part.placeOf(from.position());
  const double length = this->Part.placeOf(to.position()) - begin;
  double t = (plane - begin) / length;
  std::optional<BoundaryPoint> point;
  for (int n = 0; n < steps; ++n)
  {
    const BoundaryPlace place = this->Between.placeBetween(from.leaving, to.arriving, t);
    point = this->Tracer.project(place.location, place.face, Tracing::LongestWay * from.spacing);
    if (!point)
    {
      break;
    }
    const double missed = plane - this->Part.placeOf(point->at.point.map.position.xyz);
    t = std::clamp(t + missed / length, 0.0, 1.0);
  }
  return point;
}

/// Makes a corner where a boundary curve passes a plane of the slab, unless another one is near, which then serves as
/// well: the stretches on both sides of the plane are sampled by two workers, each of which knows one of them to its end.
void CurveTracing::cutAtPlane(double plane, BoundaryTrace& trace)
{
  std::vector<BoundaryVertex>& vertices = trace.vertices;
  const std::size_t count = vertices.size();
  const auto isCorner = [&](std::size_t v)
  { return vertices[v].corner || (!trace.closed && (v == 0 || v + 1 == count)); };
  std::vector<glm::dvec3> corners;
  for (std::size_t v = 0; v < count; ++v)
  {
    if (isCorner(v))
    {
      corners.push_back(vertices[v].position());
    }
  }
  std::vector<BoundaryVertex> cut;
  for (std::size_t v = 0; v < count; ++v)
  {
    cut.push_back(vertices[v]);
    const BoundaryVertex& next = vertices[(v + 1) % count];
    const double before = this->Part.placeOf(vertices[v].position()) - plane;
    const double after = this->Part.placeOf(next.position()) - plane;
    if ((v + 1 == count && !trace.closed) || (before <= 0.0) == (after <= 0.0))
    {
      continue;
    }
    const auto point = this->passageBetween(vertices[v], next, plane);
    const double spacing = point ? this->Between.spacingAt(point->at.location) : 0.0;
    const auto isNear = [&](const glm::dvec3& corner) {
      return glm::distance(corner, point->at.point.map.position.xyz) <
        Tracing::NearCorner * spacing;
    };
    if (point && std::none_of(corners.begin(), corners.end(), isNear))
    {
      corners.push_back(point->at.point.map.position.xyz);
      cut.push_back({ *point, *point, true, spacing });
    }
  }
  vertices = std::move(cut);
}

/// Traces a crease from its other side, unless it is traced.
void CurveTracing::followOtherSide(std::size_t stretch, const ParallelFor& parallelFor)
{
  const CurveStretch& crease = this->Found.stretches[stretch];
  if (crease.creaseFace < 0)
  {
    return;
  }
  const double nearby = this->Spacings[crease.trace];
  const std::vector<BoundaryVertex>& vertices = this->Found.traces[crease.trace].vertices;
  const std::size_t middle = (crease.first + crease.last) / 2;
  Location place = vertices[middle].leaving.at.location;
  place.u = place.u + 0.5 * (vertices[middle + 1].arriving.at.location.u - place.u);
  const FaceNeighbor& behind = this->Surface.mesh->neighbor(place.element, crease.creaseFace);
  if (behind.element < 0)
  {
    return; // the curve has come to another element, as it may in flat ones
  }
  const auto start = this->Tracer.project(
    crossFace(*this->Surface.mesh, place, crease.creaseFace), behind.face, nearby);
  if (start && !this->Tracer.isTraced(*start))
  {
    this->keep(this->traceFrom(*start, parallelFor), nearby);
  }
}

/// Whether the curve stands still at the place on an edge of the mesh from which it was traced: the next vertex knows how
/// it comes there.
bool CurveTracing::standsStill(const BoundaryTrace& trace, double spacing) const
{
  if (!trace.closed || trace.vertices.size() < 3)
  {
    return false;
  }
  return glm::distance(trace.vertices[0].position(), trace.vertices[1].position()) <=
    Tracing::Tolerance * spacing;
}

/// Takes a boundary curve over. A closed one begins, and ends, at a corner if it has one.
void CurveTracing::keep(BoundaryTrace trace, double spacing)
{
  std::vector<BoundaryVertex>& vertices = trace.vertices;
  // First: such a start would pass for a corner near a plane.
  if (this->standsStill(trace, spacing))
  {
    vertices.erase(vertices.begin());
  }
  for (const double plane : { this->Part.begin, this->Part.end })
  {
    if (std::isfinite(plane))
    {
      this->cutAtPlane(plane, trace);
    }
  }
  if (!trace.closed && hasNoLength(vertices, Tracing::Tolerance * spacing))
  {
    return;
  }
  // A crease of one chord may have been followed several times.
  const auto isBack = [&](const BoundaryVertex& vertex)
  {
    return trace.closed && isCutAt(this->Surface, vertex.leaving) &&
      isSame(vertex, vertices.front(), spacing);
  };
  vertices.erase(std::find_if(vertices.begin() + 1, vertices.end(), isBack), vertices.end());
  if (trace.closed)
  {
    const auto corner = std::find_if(
      vertices.begin(), vertices.end(), [](const BoundaryVertex& vertex) { return vertex.corner; });
    std::rotate(
      vertices.begin(), corner == vertices.end() ? vertices.begin() : corner, vertices.end());
    vertices.push_back(vertices.front());
  }
  this->cutAtCorners(trace);
  this->Found.traces.push_back(std::move(trace));
  this->Spacings.push_back(spacing);
}

/// Cuts a boundary curve into stretches.
void CurveTracing::cutAtCorners(const BoundaryTrace& trace)
{
  const std::vector<BoundaryVertex>& vertices = trace.vertices;
  for (std::size_t first = 0; first + 1 < vertices.size();)
  {
    CurveStretch stretch{ this->Found.traces.size(), first, first + 1 };
    while (stretch.last + 1 < vertices.size() && !vertices[stretch.last].corner)
    {
      ++stretch.last;
    }
    const bool isLast = stretch.last + 1 == vertices.size();
    stretch.withEnd = isLast && !trace.closed;
    stretch.isRing = isLast && first == 0 && trace.closed;
    const BoundaryPoint& start = vertices[first].leaving;
    stretch.creaseFace = isCutAt(this->Surface, start) ? start.face : -1;
    this->Found.stretches.push_back(stretch);
    first = stretch.last;
  }
}

std::vector<int> CurveTracing::findPartners() const
{
  return partnersOf(*this->Surface.mesh, this->Found.traces, this->Found.stretches,
    Tracing::SamePlace * this->Proxy.smallestSpacing());
}

/// Leaves out creases that were seen from one side alone, but for parts of longer curves: where the surface is all but
/// tangent to a face.
void CurveTracing::dropOneSided()
{
  const std::vector<int> partners = this->findPartners();
  std::vector<char> isKept(this->Found.traces.size(), 0);
  for (std::size_t s = 0; s < this->Found.stretches.size(); ++s)
  {
    const CurveStretch& stretch = this->Found.stretches[s];
    isKept[stretch.trace] |= stretch.creaseFace < 0 || partners[s] >= 0;
  }
  this->Found.stretches.erase(
    std::remove_if(this->Found.stretches.begin(), this->Found.stretches.end(),
      [&](const CurveStretch& stretch) { return !isKept[stretch.trace]; }),
    this->Found.stretches.end());
}

std::vector<std::size_t> CurveTracing::trace(const ParallelFor& parallelFor)
{
  for (const std::vector<Hint>& hintsOfBox : this->findHints(parallelFor))
  {
    for (const Hint& hint : hintsOfBox)
    {
      askCaller(parallelFor);
      this->follow(hint, parallelFor);
    }
  }
  for (std::size_t s = 0; s < this->Found.stretches.size(); ++s)
  {
    askCaller(parallelFor);
    this->followOtherSide(s, parallelFor);
  }
  return this->Tracer.overlookedFaces();
}

TracedCurves CurveTracing::takeCurves()
{
  this->dropOneSided();
  this->Found.partners = this->findPartners();
  return std::move(this->Found);
}

} // namespace hop
