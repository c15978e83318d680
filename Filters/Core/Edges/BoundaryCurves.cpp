#include "Edges/BoundaryCurves.h"

#include "Edges/BoundaryFinisher.h"
#include "Edges/BoundaryThinning.h"
#include "Edges/CreaseArcs.h"
#include "Edges/FaceCrossings.h"
#include "Edges/SampleComparison.h"
#include "Support/DisjointSets.h"
#include "Support/KeepMarked.h"
#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace hop
{
namespace
{

/// How boundary curves are found and followed: lengths in units of the spacing wanted nearby. Chosen by experiment.
struct Tracing
{
  /// Largest chord. Longer ones cost fewer evaluations, but particles are placed on a cubic between the ends of a
  /// chord, and start farther from the curve.
  static constexpr double Chord = 0.75;
  /// Largest distance from the surface, by which a vertex may miss it: particles are taken to the tolerance later.
  static constexpr double Tolerance = 1e-2;
  /// The same of curves along creases, whose vertices on edges of the mesh tell which creases meet. Larger: where the surface
  /// passes close to a corner of the mesh, curves leave a face by the wrong edge; smaller: more evaluations.
  static constexpr double ToleranceOnCut = 1e-5;
  /// Within this distance of the surface a crossing tells whether the surface ends there. A larger one believes values
  /// and slopes too far off; with a smaller one more starts are put onto the surface in vain.
  static constexpr double CrossingReach = 0.2;
  /// Largest jump, as far as samples tell, at which the two sides of a face are taken to meet: a crossing with less is
  /// no hint of a boundary curve. Curves that begin at such a place are found by their other hints. A smaller one costs
  /// evaluations; a larger one overlooks curves along small jumps.
  static constexpr double MeetingJump = 0.25;
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
Isosurface roughly(Isosurface surface, double spacing, bool isCut)
{
  const double tolerance = isCut ? Tracing::ToleranceOnCut : Tracing::Tolerance;
  surface.tolerance = std::max(surface.tolerance, tolerance * spacing);
  return surface;
}

/// Sets jump tolerances with which the surface is cut along creases, unless the field is discontinuous: pieces of surface
/// that end at creases here and at jumps there would not close.
/// \return whether there are creases to cut along
bool cutAlongCreases(
  const ElementMesh& mesh, const FaceJumps& jumps, std::vector<float>& tolerances)
{
  const auto isJoined = [&mesh](std::size_t slot) {
    return mesh.neighbor(static_cast<int>(slot / MaximumFaces), slot % MaximumFaces).element >= 0;
  };
  for (std::size_t slot = 0; slot < tolerances.size(); ++slot)
  {
    if (std::isfinite(tolerances[slot]) && isJoined(slot))
    {
      return false;
    }
  }
  bool isCut = false;
  for (std::size_t slot = 0; slot < tolerances.size(); ++slot)
  {
    if (jumps.dihedralAngles[slot] > CreaseAngle && isJoined(slot))
    {
      tolerances[slot] = -1.0f;
      isCut = true;
    }
  }
  return isCut;
}

/// Where the surface may end, as far as the samples on both sides tell.
struct BoundaryHint
{
  FaceCrossing crossing;
  /// Wanted nearby, world units.
  double spacing = 0.0;
};

/// Whether a curve is at the same corner, and goes on along the same face.
bool isSame(const BoundaryVertex& a, const BoundaryVertex& b, double spacing)
{
  return a.corner && b.corner && a.leaving.at.location.element == b.leaving.at.location.element &&
    a.leaving.face == b.leaving.face &&
    glm::distance(a.position(), b.position()) <= Tracing::Tolerance * spacing;
}

class BoundarySampler
{
public:
  /// \param isCut whether the surface is cut along creases
  BoundarySampler(const Isosurface& surface, bool isCut, const FaceJumps& jumps,
    const SurfaceProxy& proxy, const SizingFunction& sizing, const Slab& slab, const Slab& reach)
    : Surface(surface)
    , Jumps(jumps)
    , Proxy(proxy)
    , Sizing(sizing)
    , Part(slab)
    , Reach(reach)
    , Samples(*surface.mesh, proxy)
    , Tracer(roughly(surface, proxy.smallestSpacing(), isCut), BoundaryTracer::Points::Rough)
    , Walker(surface.endingWhereItMay())
  {
  }

  /// For a surface that is cut along creases.
  /// \param looksForMore whether trace() is to find further ones
  void sampleCreases(bool looksForMore)
  {
    this->HasCuts = true;
    this->Tracer.followCuts(looksForMore);
  }
  /// Traces all curves.
  /// \return slots of faces along which the surface ought to be cut
  std::vector<std::size_t> trace(const ParallelFor& parallelFor);
  /// Places particles on the curves that were traced.
  BoundaryCurves sample(SampledCurves sampled, const ParallelFor& parallelFor);
  std::int64_t evaluations() const
  {
    return this->Tracer.evaluations() + this->Walker.evaluations();
  }

private:
  std::vector<std::vector<BoundaryHint>> findHints(const ParallelFor& parallelFor) const;
  void follow(const BoundaryHint& hint, const ParallelFor& parallelFor);
  bool isInReach(const Location& place) const
  {
    return this->Reach.isEverything() ||
      this->Reach.holds(
        glm::dvec3(evaluateGradient(this->Surface.mesh->form(place.element), place.u).value));
  }
  void cutAtPlane(double plane, BoundaryTrace& trace);
  std::optional<BoundaryPoint> passageBetween(
    const BoundaryPoint& from, const BoundaryPoint& to, double plane);
  void followOtherSide(std::size_t stretch, const ParallelFor& parallelFor);
  bool standsStill(const BoundaryTrace& trace, double spacing) const;
  void keep(BoundaryTrace trace, double spacing);
  bool isCutAt(const BoundaryPoint& point) const
  {
    return this->Surface.isCutAt(point.at.location.element, point.face);
  }
  std::int64_t leastIntervals(std::size_t stretch) const;
  std::vector<BoundaryPlace> sampleStretch(
    const CurveStretch& stretch, std::int64_t leastIntervals, const ParallelFor& parallelFor);
  BoundaryPlace startOf(const CurveStretch& stretch, const BoundaryPlace& sampled) const;
  std::vector<BoundaryPlace> mirrored(const CurveStretch& stretch, Span<BoundaryPlace> other) const;
  std::vector<int> findPartners() const;
  void dropOneSided();
  void place(const ParallelFor& parallelFor);
  void joinSides(const std::vector<std::size_t>& starts, const std::vector<int>& partners);
  double spacingAt(const BoundaryPoint& point);
  ReferencePoint between(const BoundaryPoint& from, const BoundaryPoint& to, double t) const;
  void finish(const ParallelFor& parallelFor);
  void meet(std::vector<char>& found);

  Isosurface Surface;
  const FaceJumps& Jumps;
  const SurfaceProxy& Proxy;
  SizingFunction Sizing;
  Slab Part;
  Slab Reach;
  SampleComparison Samples;
  BoundaryTracer Tracer;
  SurfaceWalker Walker;
  bool HasCuts = false;
  std::vector<BoundaryTrace> Traces;
  /// Wanted near each trace, world units.
  std::vector<double> TraceSpacings;
  std::vector<CurveStretch> Stretches;
  std::vector<BoundaryPlace> Places;
  std::vector<CurveRange> Ranges;
  /// Marks the places that begin a crease; pairs of places that are one, inside creases and at their ends.
  std::vector<char> BeginsCrease;
  std::vector<std::array<int, 2>> Twins, Corners;
  /// What became of the places: at first with the particles before they are thinned out.
  std::vector<CurvePlace> Outcomes;
  BoundaryCurves Result;
};

/// The spacing wanted at a point.
double BoundarySampler::spacingAt(const BoundaryPoint& point)
{
  if (this->Sizing.angularDensity == 0.0)
  {
    return this->Sizing.spacing;
  }
  const Evaluated at = this->Walker.evaluateCurved(point.at.location);
  return this->Proxy.spacingAt(at.point.map.position.xyz,
    static_cast<float>(curvature(at.point.gradient, at.hessian).magnitude));
}

/// The hints of each box.
std::vector<std::vector<BoundaryHint>> BoundarySampler::findHints(
  const ParallelFor& parallelFor) const
{
  const ElementMesh& mesh = *this->Surface.mesh;
  std::vector<std::vector<BoundaryHint>> hints(this->Proxy.boxes().size());
  forAll(parallelFor, hints.size(),
    [&](std::size_t b)
    {
      const SurfaceBox& box = this->Proxy.boxes()[b];
      const SurfaceProxy::Sample& sample = this->Proxy.samples()[b];
      visitFaceCrossings(
        mesh, box, [&](int face) { return this->Surface.mayEnd(box.middle.element, face); },
        [&](const FaceCrossing& crossing)
        {
          if (this->Surface.isCutAt(box.middle.element, crossing.face) ||
            !this->Samples.meet(crossing, sample, Tracing::MeetingJump))
          {
            hints[b].push_back(
              { crossing, sample.found ? sample.patch.spacing : this->Sizing.spacing });
          }
        });
    });
  return hints;
}

/// Traces the curve that a hint leads to, unless there is none or it is traced.
void BoundarySampler::follow(const BoundaryHint& hint, const ParallelFor& parallelFor)
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
  this->keep(this->Tracer.trace(*start, Tracing::Chord * nearby, parallelFor), nearby);
}

/// Where a chord of a boundary curve passes a plane of the slab.
std::optional<BoundaryPoint> BoundarySampler::passageBetween(
  const BoundaryPoint& from, const BoundaryPoint& to, double plane)
{
  // The curve departs from the chord by a tenth of it at most, so that each step leaves a hundredth of the error.
  constexpr int steps = 3;
  const auto placeOf = [&](const BoundaryPoint& point)
  { return this->Part.placeOf(point.at.point.map.position.xyz); };
  const double length = placeOf(to) - placeOf(from);
  double t = (plane - placeOf(from)) / length;
  std::optional<BoundaryPoint> point;
  for (int n = 0; n < steps; ++n)
  {
    const bool isInOneElement = from.at.location.element == to.at.location.element;
    const WorldVector chord = to.at.point.map.position - from.at.point.map.position;
    const Location place = isInOneElement
      ? Location{ from.at.location.element, this->between(from, to, t) }
      : this->Walker.move(from.at, t * chord);
    const int face = place.element == from.at.location.element ? from.face : -1;
    point = this->Tracer.project(place, face, Tracing::LongestWay * this->spacingAt(from));
    if (!point)
    {
      break;
    }
    t = std::clamp(t + (plane - placeOf(*point)) / length, 0.0, 1.0);
  }
  return point;
}

/// Makes a corner where a boundary curve passes a plane of the slab, unless another one is near, which then serves as
/// well: the stretches on both sides of the plane are sampled by two workers, each of which knows one of them to its end.
void BoundarySampler::cutAtPlane(double plane, BoundaryTrace& trace)
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
    const auto point = this->passageBetween(vertices[v].leaving, next.arriving, plane);
    const auto isNear = [&](const glm::dvec3& corner)
    {
      return glm::distance(corner, point->at.point.map.position.xyz) <
        Tracing::NearCorner * this->spacingAt(*point);
    };
    if (point && std::none_of(corners.begin(), corners.end(), isNear))
    {
      corners.push_back(point->at.point.map.position.xyz);
      cut.push_back({ *point, *point, true });
    }
  }
  vertices = std::move(cut);
}

/// Traces a crease from its other side, unless it is traced.
void BoundarySampler::followOtherSide(std::size_t stretch, const ParallelFor& parallelFor)
{
  const CurveStretch& crease = this->Stretches[stretch];
  if (crease.creaseFace < 0)
  {
    return;
  }
  const double nearby = this->TraceSpacings[crease.trace];
  const std::vector<BoundaryVertex>& vertices = this->Traces[crease.trace].vertices;
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
    this->keep(this->Tracer.trace(*start, Tracing::Chord * nearby, parallelFor), nearby);
  }
}

/// Whether the curve stands still at the place on an edge of the mesh from which it was traced, before it goes along a
/// crease.
bool BoundarySampler::standsStill(const BoundaryTrace& trace, double spacing) const
{
  if (!trace.closed || trace.vertices.size() < 3)
  {
    return false;
  }
  const BoundaryVertex& first = trace.vertices[0];
  const BoundaryVertex& second = trace.vertices[1];
  return second.corner && (this->isCutAt(second.arriving) || this->isCutAt(second.leaving)) &&
    glm::distance(first.position(), second.position()) <= Tracing::Tolerance * spacing;
}

/// Cuts a boundary curve at its corners.
void BoundarySampler::keep(BoundaryTrace trace, double spacing)
{
  for (const double plane : { this->Part.begin, this->Part.end })
  {
    if (std::isfinite(plane))
    {
      this->cutAtPlane(plane, trace);
    }
  }
  std::vector<BoundaryVertex>& vertices = trace.vertices;
  if (vertices.size() < 2 && !trace.closed)
  {
    return;
  }
  if (this->standsStill(trace, spacing))
  {
    vertices.erase(vertices.begin());
  }
  // A crease of one chord may have been followed several times.
  const auto isBack = [&](const BoundaryVertex& vertex)
  {
    return trace.closed && this->isCutAt(vertex.leaving) &&
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
  for (std::size_t first = 0; first + 1 < vertices.size();)
  {
    CurveStretch stretch{ this->Traces.size(), first, first + 1 };
    while (stretch.last + 1 < vertices.size() && !vertices[stretch.last].corner)
    {
      ++stretch.last;
    }
    const bool isLast = stretch.last + 1 == vertices.size();
    stretch.withEnd = isLast && !trace.closed;
    stretch.isRing = isLast && first == 0 && trace.closed;
    const BoundaryPoint& start = vertices[first].leaving;
    stretch.creaseFace = this->isCutAt(start) ? start.face : -1;
    this->Stretches.push_back(stretch);
    first = stretch.last;
  }
  this->Traces.push_back(std::move(trace));
  this->TraceSpacings.push_back(spacing);
}

/// A place on Hermite's cubic between two points of a boundary curve in one element, or on the line between the points
/// where the cubic would leave the face.
/// \param t share of the way, 0 to 1
ReferencePoint BoundarySampler::between(
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
  const ReferencePoint onCubic = onLine + t * (1.0 - t) * ((1.0 - t) * ahead + (-t) * behind);
  const Domain domain = this->Surface.mesh->elements[from.at.location.element].domain;
  return from.face == to.face && insideMargin(domain, onCubic) > -OnFace ? onCubic : onLine;
}

/// So many intervals a crease needs that its side of the surface is no line: a closed curve through three places.
std::int64_t BoundarySampler::leastIntervals(std::size_t stretch) const
{
  const CurveStretch& curve = this->Stretches[stretch];
  if (curve.creaseFace < 0 || !this->Traces[curve.trace].closed)
  {
    return 1;
  }
  const auto isOfCurve = [&](std::size_t s)
  { return s < this->Stretches.size() && this->Stretches[s].trace == curve.trace; };
  const bool hasTwo = isOfCurve(stretch + 1) || (stretch > 0 && isOfCurve(stretch - 1));
  const bool hasThree = (isOfCurve(stretch + 1) && isOfCurve(stretch + 2)) ||
    (stretch > 0 && isOfCurve(stretch - 1) && isOfCurve(stretch + 1)) ||
    (stretch > 1 && isOfCurve(stretch - 2));
  return hasThree ? 1 : hasTwo ? 2 : 3;
}

/// Places along a stretch, at equal distances in units of the spacing wanted there, the first one on the first vertex.
std::vector<BoundaryPlace> BoundarySampler::sampleStretch(
  const CurveStretch& stretch, std::int64_t leastIntervals, const ParallelFor& parallelFor)
{
  // Places between two questions whether to end early: fewer cost more calls, more delay an abort. Chosen by experiment.
  constexpr std::int64_t placesAtOnce = 4096;
  const Span<BoundaryVertex> vertices(
    &this->Traces[stretch.trace].vertices[stretch.first], stretch.last + 1 - stretch.first);
  std::vector<BoundaryPlace> places;
  std::vector<double> sums{ 0.0 };
  std::vector<double> spacings{ 0.0 };
  double spacing = 0.0;
  for (std::size_t v = 1; v < vertices.size(); ++v)
  {
    const double before = v > 1 ? spacing
      : this->HasCuts           ? this->spacingAt(vertices[0].leaving)
                                : 0.0;
    spacing = this->spacingAt(vertices[v].arriving);
    spacings.push_back(spacing);
    const double length = glm::distance(vertices[v - 1].position(), vertices[v].position());
    sums.push_back(sums.back() + length / (this->HasCuts ? std::min(before, spacing) : spacing));
  }
  // Beyond the chords of a coarser crease particles beside it would stand.
  constexpr double longestInterval = 1.1;
  const std::int64_t wanted = stretch.creaseFace < 0
    ? std::llround(sums.back())
    : static_cast<std::int64_t>(std::ceil(sums.back() / longestInterval));
  const std::int64_t count = std::max(leastIntervals, wanted);
  std::size_t v = 1;
  for (std::int64_t n = 0; n < count + stretch.withEnd; ++n)
  {
    if (n % placesAtOnce == placesAtOnce - 1)
    {
      askCaller(parallelFor);
    }
    const double place = sums.back() * static_cast<double>(n) / static_cast<double>(count);
    while (v + 1 < vertices.size() && sums[v] < place)
    {
      ++v;
    }
    const BoundaryPoint& from = vertices[v - 1].leaving;
    const BoundaryPoint& to = vertices[v].arriving;
    spacing = this->HasCuts ? spacings[v] : spacing;
    const double chord = sums[v] - sums[v - 1];
    const double t = chord > 0.0 ? std::clamp((place - sums[v - 1]) / chord, 0.0, 1.0) : 0.0;
    if (from.at.location.element == to.at.location.element)
    {
      const ReferencePoint u = this->between(from, to, t);
      places.push_back({ { from.at.location.element, u }, from.face, spacing });
    }
    else
    {
      const WorldVector step = t * (to.at.point.map.position - from.at.point.map.position);
      const Location moved = this->Walker.move(from.at, step);
      const bool stays = moved.element == from.at.location.element;
      places.push_back({ moved, stays ? from.face : -1, spacing });
    }
  }
  places.front() = this->startOf(stretch, places.front());
  return places;
}

/// The first place of a stretch. Where a boundary curve goes over into a crease, the particle is one of the boundary
/// curve.
BoundaryPlace BoundarySampler::startOf(
  const CurveStretch& stretch, const BoundaryPlace& sampled) const
{
  const BoundaryVertex& vertex = this->Traces[stretch.trace].vertices[stretch.first];
  const bool isEndOfBoundary =
    vertex.corner && this->isCutAt(vertex.leaving) && !this->isCutAt(vertex.arriving);
  return isEndOfBoundary
    ? BoundaryPlace{ vertex.arriving.at.location, vertex.arriving.face, sampled.spacing }
    : sampled;
}

/// The places of a crease that was sampled from its other side.
/// \param other places in the order of the other side, the one at its end left out
std::vector<BoundaryPlace> BoundarySampler::mirrored(
  const CurveStretch& stretch, Span<BoundaryPlace> other) const
{
  const ElementMesh& mesh = *this->Surface.mesh;
  const auto behind = [&](const BoundaryPlace& place)
  {
    // A place that has nothing behind it, as at the end of the mesh, is taken as it is.
    if (place.face < 0 || mesh.neighbor(place.location.element, place.face).element < 0)
    {
      return place;
    }
    return BoundaryPlace{ crossFace(mesh, place.location, place.face),
      mesh.neighbor(place.location.element, place.face).face, place.spacing };
  };
  const std::vector<BoundaryVertex>& vertices = this->Traces[stretch.trace].vertices;
  const auto placeOf = [&](const BoundaryPoint& point) {
    return BoundaryPlace{ point.at.location, point.face, other[0].spacing };
  };
  std::vector<BoundaryPlace> places;
  places.push_back(stretch.isRing
      ? behind(other[0])
      : this->startOf(stretch, placeOf(vertices[stretch.first].leaving)));
  for (std::size_t n = other.size() - 1; n > 0; --n)
  {
    places.push_back(behind(other[n]));
  }
  if (stretch.withEnd)
  {
    places.push_back(placeOf(vertices[stretch.last].arriving));
  }
  return places;
}

/// Leaves out creases that were seen from one side alone, but for parts of longer curves: where the surface is all but
/// tangent to a face.
void BoundarySampler::dropOneSided()
{
  const std::vector<int> partners = this->findPartners();
  std::vector<char> isKept(this->Traces.size(), 0);
  for (std::size_t s = 0; s < this->Stretches.size(); ++s)
  {
    const CurveStretch& stretch = this->Stretches[s];
    isKept[stretch.trace] |= stretch.creaseFace < 0 || partners[s] >= 0;
  }
  this->Stretches.erase(std::remove_if(this->Stretches.begin(), this->Stretches.end(),
                          [&](const CurveStretch& stretch) { return !isKept[stretch.trace]; }),
    this->Stretches.end());
}

std::vector<int> BoundarySampler::findPartners() const
{
  return partnersOf(*this->Surface.mesh, this->Traces, this->Stretches,
    Tracing::SamePlace * this->Proxy.smallestSpacing());
}

/// Places particles on all curves.
void BoundarySampler::place(const ParallelFor& parallelFor)
{
  const std::vector<int> partners = this->findPartners();
  const auto isMirror = [&](std::size_t s)
  { return partners[s] >= 0 && partners[s] < static_cast<int>(s); };
  std::vector<std::size_t> starts;
  std::vector<std::size_t> firsts(this->Traces.size(), this->Stretches.size());
  std::vector<std::size_t> stretchCounts(this->Traces.size(), 0);
  for (std::size_t s = 0; s < this->Stretches.size(); ++s)
  {
    const CurveStretch& stretch = this->Stretches[s];
    firsts[stretch.trace] = std::min(firsts[stretch.trace], s);
    stretchCounts[stretch.trace] += 1;
    starts.push_back(this->Places.size());
    std::vector<BoundaryPlace> places;
    if (isMirror(s))
    {
      const std::size_t begin = starts[partners[s]];
      const std::size_t end =
        starts[partners[s] + 1] - (this->Stretches[partners[s]].withEnd ? 1 : 0);
      places = this->mirrored(stretch, { &this->Places[begin], end - begin });
    }
    else
    {
      const std::int64_t least = partners[s] < 0
        ? this->leastIntervals(s)
        : std::max(this->leastIntervals(s), this->leastIntervals(partners[s]));
      places = this->sampleStretch(stretch, least, parallelFor);
    }
    this->Places.insert(this->Places.end(), places.begin(), places.end());
    this->BeginsCrease.resize(this->Places.size(), stretch.creaseFace >= 0);
  }
  starts.push_back(this->Places.size());
  for (std::size_t t = 0; t < this->Traces.size(); ++t)
  {
    const std::size_t first = starts[firsts[t]];
    this->Ranges.push_back(
      { first, starts[firsts[t] + stretchCounts[t]] - first, this->Traces[t].closed });
  }
  this->joinSides(starts, partners);
}

/// Finds out which places on the two sides of creases are one.
/// \param starts number of the first place of each stretch, and of all places
void BoundarySampler::joinSides(
  const std::vector<std::size_t>& starts, const std::vector<int>& partners)
{
  const auto endOf = [&](std::size_t s)
  {
    const CurveStretch& stretch = this->Stretches[s];
    const CurveRange& curve = this->Ranges[stretch.trace];
    const bool isLast = starts[s + 1] == curve.first + curve.count;
    return stretch.withEnd ? starts[s + 1] - 1 : isLast ? curve.first : starts[s + 1];
  };
  const auto add = [](std::vector<std::array<int, 2>>& pairs, std::size_t a, std::size_t b) {
    pairs.push_back({ static_cast<int>(a), static_cast<int>(b) });
  };
  for (std::size_t s = 0; s < partners.size(); ++s)
  {
    if (partners[s] < static_cast<int>(s))
    {
      continue;
    }
    const auto other = static_cast<std::size_t>(partners[s]);
    const std::size_t count = starts[s + 1] - starts[s] - (this->Stretches[s].withEnd ? 1 : 0);
    add(this->Corners, starts[s], endOf(other));
    add(this->Corners, endOf(s), starts[other]);
    for (std::size_t n = 1; n < count; ++n)
    {
      add(this->Twins, starts[s] + n, starts[other] + count - n);
    }
  }
}

/// Makes particles of all places.
void BoundarySampler::finish(const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& particles = this->Result.particles;
  particles.resize(this->Places.size());
  std::vector<PlaceKind> kinds(particles.size());
  std::atomic<std::int64_t> evaluations{ 0 };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(particles.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      BoundaryFinisher finisher(this->Surface, this->Jumps, this->Proxy, this->Sizing);
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        kinds[n] = finisher.finish(this->Places[n], particles[n]);
      }
      evaluations += finisher.evaluations();
    });
  std::vector<char> found(particles.size());
  for (std::size_t n = 0; n < particles.size(); ++n)
  {
    found[n] = kinds[n] == PlaceKind::OnCurve;
    particles[n].isOnCrease = this->BeginsCrease[n] != 0;
  }
  this->meet(found);
  this->Outcomes.resize(particles.size());
  int count = 0;
  for (std::size_t n = 0; n < particles.size(); ++n)
  {
    this->Outcomes[n] = { found[n] ? count++ : -1, -1, kinds[n] == PlaceKind::Inside,
      this->BeginsCrease[n] != 0 };
  }
  keepMarked(particles, found);
  this->Result.evaluations += evaluations;
}

/// Puts the particles of all sides of a place on creases into the same place, to the last bit. Inside a crease there is
/// one on each side or none.
/// \param found marks the places with particles
void BoundarySampler::meet(std::vector<char>& found)
{
  Buffer<BoundaryParticle>& particles = this->Result.particles;
  DisjointSets places(particles.size());
  for (const auto& [a, b] : this->Twins)
  {
    found[a] = found[b] = found[a] && found[b];
    places.unite(a, b);
  }
  for (const auto& [a, b] : this->Corners)
  {
    places.unite(a, b);
    particles[a].isOnCrease = particles[b].isOnCrease = true;
  }
  std::vector<int> first(particles.size(), -1);
  for (std::size_t n = 0; n < particles.size(); ++n)
  {
    int& one = first[places.root(static_cast<int>(n))];
    if (!found[n])
    {
      continue;
    }
    if (one >= 0)
    {
      particles[n].particle.position = particles[one].particle.position;
      particles[n].patch.position = particles[one].patch.position;
      this->Result.edges.coincident.push_back({ one, static_cast<int>(n) });
    }
    one = one < 0 ? static_cast<int>(n) : one;
  }
  renumber(this->Result.edges.coincident, found);
}

std::vector<std::size_t> BoundarySampler::trace(const ParallelFor& parallelFor)
{
  for (const std::vector<BoundaryHint>& hintsOfBox : this->findHints(parallelFor))
  {
    for (const BoundaryHint& hint : hintsOfBox)
    {
      askCaller(parallelFor);
      this->follow(hint, parallelFor);
    }
  }
  for (std::size_t s = 0; s < this->Stretches.size(); ++s)
  {
    askCaller(parallelFor);
    this->followOtherSide(s, parallelFor);
  }
  return this->Tracer.overlookedCreases();
}

BoundaryCurves BoundarySampler::sample(SampledCurves sampled, const ParallelFor& parallelFor)
{
  this->dropOneSided();
  this->place(parallelFor);
  this->finish(parallelFor);
  thinOut(std::move(this->Outcomes), this->Ranges, sampled, this->Result, parallelFor);
  this->Result.evaluations += this->evaluations();
  return std::move(this->Result);
}

} // namespace

BoundaryCurves findBoundaryCurves(const Isosurface& surface, const FaceJumps& jumps,
  const SurfaceProxy& proxy, const SizingFunction& sizing, SampledCurves sampled,
  const ParallelFor& parallelFor, const Slab& slab, const Slab& reach)
{
  Isosurface cut = surface;
  std::vector<float> tolerances = jumps.jumpTolerances;
  const bool isCut = sampled == SampledCurves::BoundaryAndCreases &&
    cutAlongCreases(*surface.mesh, jumps, tolerances);
  if (isCut)
  {
    cut.jumpTolerances = &tolerances;
  }
  // Each time creases may show further ones beside them, where the surface passes corners of faces.
  constexpr int mostTimes = 8;
  std::int64_t evaluations = 0;
  for (int n = 1;; ++n)
  {
    BoundarySampler sampler(cut, isCut, jumps, proxy, sizing, slab, reach);
    if (isCut)
    {
      sampler.sampleCreases(n < mostTimes);
    }
    const std::vector<std::size_t> overlooked = sampler.trace(parallelFor);
    if (overlooked.empty())
    {
      BoundaryCurves curves = sampler.sample(sampled, parallelFor);
      curves.evaluations += evaluations;
      return curves;
    }
    evaluations += sampler.evaluations();
    for (const std::size_t slot : overlooked)
    {
      tolerances[slot] = -1.0f;
    }
  }
}

} // namespace hop
