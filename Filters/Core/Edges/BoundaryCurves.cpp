#include "Edges/BoundaryCurves.h"

#include "Edges/BoundaryTracer.h"
#include "Edges/CellBorders.h"
#include "Edges/CreaseArcs.h"
#include "Edges/CurveSegments.h"
#include "Edges/FaceCrossings.h"
#include "Edges/FacePlanes.h"
#include "Edges/ParticleGrid.h"
#include "Edges/SampleComparison.h"
#include "Support/DisjointSets.h"
#include "Support/KeepFirst.h"
#include "Support/KeepMarked.h"
#include "Support/SpacingGrid.h"
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
};

/// When two particles are too near to each other, in units of the spacing of the later one. Chosen by experiment.
struct Nearness
{
  /// On one sheet. Evenly spaced curves keep nearly one spacing; less than this stand corners that are close to each
  /// other, and curves that run side by side. More drops particles of short stretches between corners, less leaves
  /// pairs.
  static constexpr double OnOneSheet = 0.6;
  /// Largest distance of a corner that serves as well as the place where the curve passes a plane between two workers.
  /// Short stretches are sampled unevenly: a smaller one leaves stretches of less than two spacings; a larger one lets
  /// the two workers' particles beside the plane differ more.
  static constexpr double OfCorner = 1.6;
  /// Where two sheets meet at a sharp edge, and each has a curve of its own.
  static constexpr double AtSharpEdge = 0.3;
  /// Largest distance of places of one corner, far above rounding and far below the distance of different corners.
  static constexpr double OnePlace = 1e-6;
  /// Smallest width of a strip of the surface: less may be a crack between elements, as files write them in single
  /// precision, at which the sides overlap. More draws narrower strips a splat wide.
  static constexpr double LeastStrip = 1e-3;
};

/// The surface for the tracer. Chords need not lie on it as exactly as particles.
Isosurface roughly(Isosurface surface, double spacing, bool isCut)
{
  const double tolerance = isCut ? Tracing::ToleranceOnCut : Tracing::Tolerance;
  surface.tolerance = std::max(surface.tolerance, tolerance * spacing);
  return surface;
}

/// The surface as it would be if it passed every jump.
Isosurface seamless(Isosurface surface)
{
  surface.jumpTolerances = nullptr;
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

/// Where a particle is to stand on a boundary curve, nearly.
struct BoundaryPlace
{
  Location location;
  /// Of the element; -1 where it is yet to be found.
  int face = -1;
  /// Wanted nearby, world units.
  double spacing = 0.0;
};

/// Unit vector along the surface that leaves the element by a face; zero where the surface is parallel to the face.
WorldVector outwardAt(const ElementMesh& mesh, const Evaluated& at, int face)
{
  const glm::dvec3 normal = surfaceNormal(at.point.gradient).xyz;
  const glm::dvec3 inward =
    glm::transpose(at.point.map.inverse) * mesh.face(at.location.element, face).inward.xyz;
  const glm::dvec3 along = inward - glm::dot(inward, normal) * normal;
  return { glm::length(along) > 0.0 ? -glm::normalize(along) : glm::dvec3(0.0) };
}

/// What a place on a boundary curve turns out to be.
enum class PlaceKind
{
  OnCurve,
  /// No point of the surface was found there.
  Lost,
  /// The surface goes on, so that there is no boundary curve.
  Inside
};

/// Makes particles of places; one finisher a thread.
class BoundaryFinisher
{
public:
  BoundaryFinisher(const Isosurface& surface, const FaceJumps& jumps, const SurfaceProxy& proxy,
    const SizingFunction& sizing)
    : Surface(surface)
    , Jumps(jumps)
    , Proxy(proxy)
    , Sizing(sizing)
    , Exact(surface, BoundaryTracer::Points::Exact)
    , Passer(seamless(surface))
  {
  }

  /// \param result written if the place is on a boundary curve
  PlaceKind finish(const BoundaryPlace& place, BoundaryParticle& result);

  std::int64_t evaluations() const
  {
    return this->Exact.evaluations() + this->Passer.evaluations();
  }

private:
  /// What lies behind the boundary faces of a point.
  struct Beyond
  {
    /// F - c on the other side; zero where there is none.
    double jump = 0.0;
    /// In a corner, the other face with nothing behind it; else -1.
    int otherFace = -1;
  };

  std::optional<Beyond> lookBehind(const BoundaryPoint& point);
  BoundarySide sideAt(int face, const Evaluated& at, const Jet& jet) const;

  const Isosurface& Surface;
  const FaceJumps& Jumps;
  const SurfaceProxy& Proxy;
  const SizingFunction& Sizing;
  BoundaryTracer Exact;
  /// Passes every face that has something behind it.
  SurfaceWalker Passer;
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
  BoundaryCurves sample(const ParallelFor& parallelFor);
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
  bool isTooNear(std::size_t i, std::size_t j) const;
  void thinOut(const ParallelFor& parallelFor);
  void connect(const std::vector<char>& kept, const std::vector<int>& standIns);
  void addOtherSides();

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
  if (!start || this->Tracer.isTraced(*start) || !this->Tracer.isOnBoundary(*start))
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
        Nearness::OfCorner * this->spacingAt(*point);
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

PlaceKind BoundaryFinisher::finish(const BoundaryPlace& place, BoundaryParticle& result)
{
  const auto point = this->Exact.project(place.location, place.face, place.spacing);
  const auto beyond = point ? this->lookBehind(*point) : std::nullopt;
  if (point && !beyond)
  {
    return PlaceKind::Inside;
  }
  Anchor anchor;
  if (!point || !anchorPatch(point->at, anchor, result.patch))
  {
    return PlaceKind::Lost;
  }
  const FieldPoint& field = point->at.point;
  result.patch.spacing =
    this->Proxy.spacingAt(result.patch.position, result.patch.curvatureMagnitude());
  result.patch.fixed = true;
  result.particle =
    particleAt(point->at.location, field, curvature(field.gradient, point->at.hessian),
      this->Sizing.angularDensity == 0.0 ? this->Sizing.spacing : result.patch.spacing);
  result.particle.jump = beyond->jump;
  const Jet& jet = this->Exact.jetAt(*point);
  offerFaces(this->Surface, this->Jumps, jet, field, result.particle);
  markCellBorders(*this->Surface.mesh, jet, field.map, result.particle);
  result.side = this->sideAt(point->face, point->at, jet);
  result.otherSide = this->sideAt(beyond->otherFace, point->at, jet);
  if (this->Surface.isCutAt(point->at.location.element, point->face))
  {
    result.side = result.otherSide;
    result.otherSide = {};
  }
  return PlaceKind::OnCurve;
}

/// How the surface ends at a face; nothing for no face.
BoundarySide BoundaryFinisher::sideAt(int face, const Evaluated& at, const Jet& jet) const
{
  if (face < 0)
  {
    return {};
  }
  const WorldVector outward = outwardAt(*this->Surface.mesh, at, face);
  const LevelSet field{ at.point.gradient, at.hessian };
  const LevelSet margin =
    faceLevels(jet, at.point.map, this->Surface.mesh->face(at.location.element, face));
  return { face, outward, dot(curvatureOfCrossing(field, margin), outward) };
}

/// Looks behind all boundary faces on which a point lies.
/// \return nothing where the surface goes on behind the point's own face
std::optional<BoundaryFinisher::Beyond> BoundaryFinisher::lookBehind(const BoundaryPoint& point)
{
  const Location& location = point.at.location;
  const ElementMesh& mesh = *this->Surface.mesh;
  const auto& faces = facts(mesh.elements[location.element].domain).faces;
  Beyond result;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    if (faceMargin(faces[f], location.u) >= OnFace || !this->Surface.mayEnd(location.element, f))
    {
      continue;
    }
    const auto behind = this->Passer.behind(point.at, f);
    const bool isCut = this->Surface.isCutAt(location.element, f);
    result.jump = behind && !isCut ? behind->at.point.value : result.jump;
    result.otherFace = behind || f == point.face ? result.otherFace : f;
    if (!behind || f != point.face)
    {
      continue;
    }
    // What is found behind a face that the mesh does not join may lie too far off to count.
    const bool joined = mesh.neighbor(location.element, f).element >= 0;
    if (joined ? SurfaceWalker::continuesIn(this->Surface, point.at, f, *behind)
               : !this->Exact.isOnBoundary(point))
    {
      return std::nullopt;
    }
  }
  return result;
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

bool BoundarySampler::isTooNear(std::size_t i, std::size_t j) const
{
  const BoundaryParticle& a = this->Result.particles[i];
  const BoundaryParticle& b = this->Result.particles[j];
  if (a.isOnCrease || b.isOnCrease)
  {
    return false; // the other side has one here
  }
  const double cosine = dot(a.particle.normal, b.particle.normal);
  const double near = cosine > SheetCosine ? Nearness::OnOneSheet : Nearness::AtSharpEdge;
  return cosine > 0.0 && glm::distance(a.patch.position, b.patch.position) < near * a.patch.spacing;
}

/// Whether two particles that look away from each other have the surface between them, as on a strip, or are the two
/// sides of one sharp corner. Of two elements that jump they are the sides of a slit, whose sheets may reach over each
/// other.
bool areAcrossSurface(const BoundaryParticle& a, const BoundaryParticle& b)
{
  const WorldVector step = b.particle.position - a.particle.position;
  const double h = a.patch.spacing;
  const bool inOneElement = a.particle.location.element == b.particle.location.element;
  if (inOneElement && length(step) < Nearness::OnePlace * h)
  {
    return true;
  }
  const bool isJump = !inOneElement && a.particle.jump != 0.0 && b.particle.jump != 0.0;
  return !isJump && dot(step, a.side.outward) < -Nearness::LeastStrip * h &&
    dot(step, b.side.outward) > Nearness::LeastStrip * h;
}

/// Of particles that are too near to each other the first stays. If the surface ends at both on the two sides of a
/// slit, it goes on there, and the one that stays ends at no face.
void BoundarySampler::thinOut(const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& particles = this->Result.particles;
  const SpacedPoints points(
    particles.size(), [&](std::size_t i) { return particles[i].patch.position; },
    [&](std::size_t i) { return particles[i].patch.spacing; }, parallelFor);
  const SpacingGrid grid(
    points.positions, points.spacings, Nearness::OnOneSheet, CellsPerReach, parallelFor);
  const auto visitEarlier = [&](std::size_t i, const auto& use)
  {
    grid.visit(points.positions[i], points.spacings[i],
      [&](std::size_t j)
      {
        if (j < i && this->isTooNear(i, j))
        {
          use(j);
        }
      });
  };
  const std::size_t count = particles.size();
  const std::vector<char> kept =
    keepFirst(std::vector<char>(count, 1), count, parallelFor, visitEarlier);
  std::vector<char> closesSlit(count, 0);
  std::vector<int> standIns(count, -1);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!kept[i])
    {
      bool isOnStrip = false;
      visitEarlier(i,
        [&](std::size_t j)
        {
          const bool isOpposite = kept[j] && lookAtEachOther(particles[i].side, particles[j].side);
          const bool isAcross = isOpposite && areAcrossSurface(particles[i], particles[j]);
          const bool isSlit = isOpposite && !isAcross;
          isOnStrip = isOnStrip || isAcross;
          closesSlit[j] = closesSlit[j] || isSlit;
          closesSlit[i] = closesSlit[i] || isSlit;
          const auto distanceTo = [&](std::size_t k)
          { return glm::distance(points.positions[i], points.positions[k]); };
          const bool isNearest = standIns[i] < 0 || distanceTo(j) < distanceTo(standIns[i]);
          standIns[i] = kept[j] && isNearest ? static_cast<int>(j) : standIns[i];
        });
      if ((particles[i].particle.jump == 0.0 || isOnStrip) && !closesSlit[i])
      {
        this->Result.thinned.push_back(particles[i]);
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (closesSlit[i])
    {
      particles[i].side = {};
    }
  }
  this->connect(kept, standIns);
  keepMarked(particles, kept);
}

/// Finds out which particles follow each other on a curve. Two at which the surface ends no more, because a slit was
/// closed, are not the ends of a piece of curve.
/// \param kept marks the particles that stay
/// \param standIns for each of the others the particle that is too near to it
void BoundarySampler::connect(const std::vector<char>& kept, const std::vector<int>& standIns)
{
  const Buffer<BoundaryParticle>& particles = this->Result.particles;
  for (CurvePlace& place : this->Outcomes)
  {
    if (place.particle >= 0 && !kept[place.particle])
    {
      place.standIn = standIns[place.particle];
      place.particle = -1;
    }
  }
  const auto hasNoEnd = [](const BoundaryParticle& particle)
  { return !particle.side.exists() && !particle.isOnCrease; };
  SurfaceEdges& edges = this->Result.edges;
  std::vector<std::array<int, 2>> segments = segmentsOf(this->Outcomes, this->Ranges);
  segments.erase(std::remove_if(segments.begin(), segments.end(),
                   [&](const std::array<int, 2>& pair)
                   { return hasNoEnd(particles[pair[0]]) && hasNoEnd(particles[pair[1]]); }),
    segments.end());
  edges.segments = withoutDropped(segments, kept);
  edges.directed = directedEdgesOf(this->Outcomes, this->Ranges);
  renumber(edges.directed, kept);
  renumber(edges.coincident, kept);
}

/// Corners tell of both curves that meet there.
void BoundarySampler::addOtherSides()
{
  for (const BoundaryParticle& corner : this->Result.particles)
  {
    if (corner.side.exists() && corner.otherSide.exists())
    {
      this->Result.thinned.push_back(corner);
      this->Result.thinned[this->Result.thinned.size() - 1].side = corner.otherSide;
    }
  }
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

BoundaryCurves BoundarySampler::sample(const ParallelFor& parallelFor)
{
  this->dropOneSided();
  this->place(parallelFor);
  this->finish(parallelFor);
  this->thinOut(parallelFor);
  this->addOtherSides();
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
      BoundaryCurves curves = sampler.sample(parallelFor);
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
