#include "Edges/BoundaryCurves.h"

#include "Edges/BoundaryTracer.h"
#include "Edges/FaceCrossings.h"
#include "Edges/FacePlanes.h"
#include "Edges/SampleComparison.h"
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

/// Chords of traced boundary curves, in units of the spacing.
constexpr double chordPerSpacing = 0.75;
/// So near to the surface a crossing tells whether it ends there.
constexpr double crossingPerSpacing = 0.2;
/// It does not where, as far as samples tell, the sides miss each other by less than this, in units of the
/// spacing. Other hints lead to a boundary curve that is overlooked.
constexpr double clearJump = 0.25;

/// Particles of one surface are never as near as this, in units of the spacing.
constexpr double sameSurface = 0.6;

/// Chords need not lie on the surface as exactly as particles.
Isosurface roughly(Isosurface surface, double spacing)
{
  surface.tolerance = std::max(surface.tolerance, 1e-2 * spacing);
  return surface;
}

Isosurface seamless(Isosurface surface)
{
  surface.jumpTolerances = nullptr;
  return surface;
}

/// Where the surface may end, as far as the samples on both sides tell.
struct BoundaryHint
{
  FaceCrossing crossing;
  /// The spacing wanted nearby.
  double spacing = 0.0;
};

/// Where a particle is to stand on a boundary curve, nearly.
struct BoundaryPlace
{
  Location location;
  /// Of the element; -1 where it is yet to be found.
  int face = -1;
  /// A spacing wanted nearby.
  double spacing = 0.0;
};

/// Out of the surface along it, at a face of the element; zero where it is parallel to that.
WorldVector outwardAt(const ElementMesh& mesh, const Evaluated& at, int face)
{
  const glm::dvec3 normal = surfaceNormal(at.point.gradient).xyz;
  const glm::dvec3 inward =
    glm::transpose(at.point.map.inverse) * mesh.face(at.location.element, face).inward.xyz;
  const glm::dvec3 along = inward - glm::dot(inward, normal) * normal;
  return { glm::length(along) > 0.0 ? -glm::normalize(along) : glm::dvec3(0.0) };
}

/// Makes particles of such places; one a thread.
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

  /// \return whether there is a boundary curve
  bool finish(const BoundaryPlace& place, BoundaryParticle& boundary);

  std::int64_t evaluations() const
  {
    return this->Exact.evaluations() + this->Passer.evaluations();
  }

private:
  bool lookBehind(const BoundaryPoint& point, double& jump, int& otherWall);
  BoundarySide sideAt(int face, const Evaluated& at, const Jet& jet) const;

  const Isosurface& Surface;
  const FaceJumps& Jumps;
  const SurfaceProxy& Proxy;
  const SizingFunction& Sizing;
  BoundaryTracer Exact;
  /// Goes on wherever there is something to go on in.
  SurfaceWalker Passer;
};

class BoundarySampler
{
public:
  BoundarySampler(const Isosurface& surface, const FaceJumps& jumps, const SurfaceProxy& proxy,
    const SizingFunction& sizing)
    : Surface(surface)
    , Jumps(jumps)
    , Proxy(proxy)
    , Sizing(sizing)
    , Samples(*surface.mesh, proxy)
    , Tracer(roughly(surface, proxy.smallestSpacing()), BoundaryTracer::Points::Rough)
    , Walker(surface.withWalls())
  {
  }

  BoundaryCurves run(const ParallelFor& parallelFor);

private:
  std::vector<std::vector<BoundaryHint>> findHints(const ParallelFor& parallelFor) const;
  void follow(const BoundaryHint& hint);
  void sample(BoundaryTrace trace);
  void sampleStretch(Span<BoundaryVertex> vertices, bool withEnd);
  double spacingAt(const BoundaryPoint& point);
  ReferencePoint between(const BoundaryPoint& from, const BoundaryPoint& to, double t) const;
  void finish(const ParallelFor& parallelFor);
  bool isTooNear(int i, int j) const;
  void thinOut(const ParallelFor& parallelFor);

  Isosurface Surface;
  const FaceJumps& Jumps;
  const SurfaceProxy& Proxy;
  SizingFunction Sizing;
  SampleComparison Samples;
  BoundaryTracer Tracer;
  SurfaceWalker Walker;
  std::vector<BoundaryPlace> Places;
  BoundaryCurves Result;
};

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

/// Those of each box.
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
          if (!this->Samples.meet(crossing, sample, clearJump))
          {
            hints[b].push_back(
              { crossing, sample.found ? sample.patch.spacing : this->Sizing.spacing });
          }
        });
    });
  return hints;
}

void BoundarySampler::follow(const BoundaryHint& hint)
{
  const FaceCrossing& crossing = hint.crossing;
  const double nearby = hint.spacing;
  if (this->Tracer.hasPassed(crossing) ||
    this->Tracer.goesOnAt(crossing, crossingPerSpacing * nearby))
  {
    return;
  }
  const auto start = this->Tracer.project(crossing.location, crossing.face, 4.0 * nearby);
  if (!start || this->Tracer.hasPassed(*start) || !this->Tracer.isOnBoundary(*start))
  {
    return;
  }
  this->sample(this->Tracer.trace(*start, chordPerSpacing * nearby));
}

/// Cuts a boundary curve at its corners, and samples stretch by stretch.
void BoundarySampler::sample(BoundaryTrace trace)
{
  std::vector<BoundaryVertex>& vertices = trace.vertices;
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
    std::size_t last = first + 1;
    while (last + 1 < vertices.size() && !vertices[last].corner)
    {
      ++last;
    }
    const bool end = last + 1 == vertices.size();
    this->sampleStretch({ &vertices[first], last + 1 - first }, end && !trace.closed);
    first = last;
  }
}

/// On the cubic of Hermite between two points of a boundary curve in one element, or on the line where that would leave
/// the face.
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

/// Particles at equal distances, in units of the spacing wanted, from the first vertex on.
void BoundarySampler::sampleStretch(Span<BoundaryVertex> vertices, bool withEnd)
{
  std::vector<double> sums{ 0.0 };
  double spacing = 0.0;
  for (std::size_t v = 1; v < vertices.size(); ++v)
  {
    spacing = this->spacingAt(vertices[v].arriving);
    sums.push_back(
      sums.back() + glm::distance(vertices[v - 1].position(), vertices[v].position()) / spacing);
  }
  const auto count = std::max<std::int64_t>(1, std::llround(sums.back()));
  std::size_t v = 1;
  for (std::int64_t n = 0; n < count + withEnd; ++n)
  {
    const double wanted = sums.back() * static_cast<double>(n) / static_cast<double>(count);
    while (v + 1 < vertices.size() && sums[v] < wanted)
    {
      ++v;
    }
    const BoundaryPoint& from = vertices[v - 1].leaving;
    const BoundaryPoint& to = vertices[v].arriving;
    const double chord = sums[v] - sums[v - 1];
    const double t = chord > 0.0 ? std::clamp((wanted - sums[v - 1]) / chord, 0.0, 1.0) : 0.0;
    if (from.at.location.element == to.at.location.element)
    {
      const ReferencePoint u = this->between(from, to, t);
      this->Places.push_back({ { from.at.location.element, u }, from.face, spacing });
    }
    else
    {
      const WorldVector step = t * (to.at.point.map.position - from.at.point.map.position);
      const Location place = this->Walker.move(from.at, step);
      const bool stays = place.element == from.at.location.element;
      this->Places.push_back({ place, stays ? from.face : -1, spacing });
    }
  }
}

bool BoundaryFinisher::finish(const BoundaryPlace& place, BoundaryParticle& boundary)
{
  const auto point = this->Exact.project(place.location, place.face, place.spacing);
  Anchor anchor;
  double jump = 0.0;
  int otherWall = -1;
  if (!point || !this->lookBehind(*point, jump, otherWall) ||
    !anchorPatch(point->at, anchor, boundary.patch))
  {
    return false;
  }
  const FieldPoint& field = point->at.point;
  boundary.patch.spacing =
    this->Proxy.spacingAt(boundary.patch.position, boundary.patch.curvatureMagnitude());
  boundary.patch.fixed = true;
  boundary.particle =
    particleAt(point->at.location, field, curvature(field.gradient, point->at.hessian),
      this->Sizing.angularDensity == 0.0 ? this->Sizing.spacing : boundary.patch.spacing);
  boundary.particle.jump = jump;
  const Jet& jet = this->Exact.jetAt(*point);
  offerFaces(this->Surface, this->Jumps, jet, field, boundary.particle);
  boundary.side = this->sideAt(point->face, point->at, jet);
  boundary.otherSide = this->sideAt(otherWall, point->at, jet);
  return true;
}

/// Where the surface ends at a face; nothing at no face.
BoundarySide BoundaryFinisher::sideAt(int face, const Evaluated& at, const Jet& jet) const
{
  if (face < 0)
  {
    return {};
  }
  const WorldVector outward = outwardAt(*this->Surface.mesh, at, face);
  const LevelSet field{ at.point.gradient, at.hessian };
  const LevelSet wall =
    faceLevels(jet, at.point.map, this->Surface.mesh->face(at.location.element, face));
  return { face, outward, dot(bendOfCrossing(field, wall), outward) };
}

/// F - c on the other side of the faces on which a point lies; zero where there is no other side.
/// \param otherWall another face with nothing behind it, in corners; else -1
/// \return whether the surface ends there
bool BoundaryFinisher::lookBehind(const BoundaryPoint& point, double& jump, int& otherWall)
{
  const Location& location = point.at.location;
  const ElementMesh& mesh = *this->Surface.mesh;
  const auto& faces = facts(mesh.elements[location.element].domain).faces;
  jump = 0.0;
  otherWall = -1;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
  {
    if (faceMargin(faces[f], location.u) >= OnFace || !this->Surface.mayEnd(location.element, f))
    {
      continue;
    }
    const auto behind = this->Passer.behind(point.at, f);
    jump = behind ? behind->at.point.value : jump;
    otherWall = behind || f == point.face ? otherWall : f;
    if (!behind || f != point.face)
    {
      continue;
    }
    // Behind a face that is not joined it may lie too far off.
    const bool joined = mesh.neighbor(location.element, f).element >= 0;
    if (joined ? SurfaceWalker::goesOn(this->Surface, point.at, f, *behind)
               : !this->Exact.isOnBoundary(point))
    {
      return false;
    }
  }
  return true;
}

void BoundarySampler::finish(const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& boundaries = this->Result.particles;
  boundaries.resize(this->Places.size());
  std::vector<char> found(boundaries.size());
  std::atomic<std::int64_t> evaluations{ 0 };
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(boundaries.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      BoundaryFinisher finisher(this->Surface, this->Jumps, this->Proxy, this->Sizing);
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        found[n] = finisher.finish(this->Places[n], boundaries[n]);
      }
      evaluations += finisher.evaluations();
    });
  keepMarked(boundaries, found);
  this->Result.evaluations += evaluations;
}

/// Whether two particles are as near as particles of one surface never are. Where two sheets meet at a sharp
/// edge they may be nearer.
bool BoundarySampler::isTooNear(int i, int j) const
{
  constexpr double sharpEdge = 0.3;
  const BoundaryParticle& a = this->Result.particles[i];
  const BoundaryParticle& b = this->Result.particles[j];
  const double cosine = dot(a.particle.normal, b.particle.normal);
  const double near = cosine > SameSheet ? sameSurface : sharpEdge;
  return cosine > 0.0 && glm::distance(a.patch.position, b.patch.position) < near * a.patch.spacing;
}

/// Of particles that are too near to each other the first stays. If they look at each other, the surface goes
/// on there.
void BoundarySampler::thinOut(const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& boundaries = this->Result.particles;
  const SpacedPoints points(
    boundaries.size(), [&](std::size_t i) { return boundaries[i].patch.position; },
    [&](std::size_t i) { return boundaries[i].patch.spacing; }, parallelFor);
  const SpacingGrid grid(points.positions, points.spacings, sameSurface, 0.5, parallelFor);
  const auto visitEarlier = [&](int i, const auto& use)
  {
    grid.visit(points.positions[i], points.spacings[i],
      [&](int j)
      {
        if (j < i && this->isTooNear(i, j))
        {
          use(j);
        }
      });
  };
  std::vector<char> kept(boundaries.size(), 1);
  forAll(parallelFor, boundaries.size(),
    [&](std::size_t i) { visitEarlier(static_cast<int>(i), [&](int) { kept[i] = 0; }); });
  std::vector<char> seam(boundaries.size(), 0);
  // The few that are near to another, one by one.
  for (int i = 0; i < static_cast<int>(boundaries.size()); ++i)
  {
    if (!kept[i])
    {
      kept[i] = 1;
      visitEarlier(i,
        [&](int j)
        {
          kept[i] = kept[i] && !kept[j];
          seam[j] = seam[j] ||
            (kept[j] && dot(boundaries[i].side.outward, boundaries[j].side.outward) < -0.5);
        });
    }
  }
  for (std::size_t i = 0; i < boundaries.size(); ++i)
  {
    if (seam[i])
    {
      boundaries[i].side = {};
    }
  }
  keepMarked(boundaries, kept);
}

BoundaryCurves BoundarySampler::run(const ParallelFor& parallelFor)
{
  for (const std::vector<BoundaryHint>& hintsOfBox : this->findHints(parallelFor))
  {
    if (!hintsOfBox.empty())
    {
      askCaller(parallelFor);
    }
    for (const BoundaryHint& hint : hintsOfBox)
    {
      this->follow(hint);
    }
  }
  this->finish(parallelFor);
  this->thinOut(parallelFor);
  this->Result.evaluations += this->Tracer.evaluations() + this->Walker.evaluations();
  return std::move(this->Result);
}

} // namespace

BoundaryCurves findBoundaryCurves(const Isosurface& surface, const FaceJumps& jumps,
  const SurfaceProxy& proxy, const SizingFunction& sizing, const ParallelFor& parallelFor)
{
  return BoundarySampler(surface, jumps, proxy, sizing).run(parallelFor);
}

} // namespace hop
