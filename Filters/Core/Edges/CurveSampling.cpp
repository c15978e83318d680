#include "Edges/CurveSampling.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// Of a closed curve with no more places than this none is left out. Two arcs between two corners have four. More keep
/// particles that crowd.
constexpr std::size_t fewPlaces = 4;

/// Length of a closed curve above which it is one, in units of the spacing. Shorter ones are places where a trace passes
/// edges of the mesh and comes back.
constexpr double shortestCurve = 0.1;

class CurveSampling
{
public:
  CurveSampling(const Isosurface& surface, bool isCut, const TracedCurves& curves,
    CurveInterpolation& interpolation)
    : Surface(surface)
    , IsCut(isCut)
    , Curves(curves)
    , Between(interpolation)
  {
  }

  SampledPlaces place(const ParallelFor& parallelFor);

private:
  bool bounds(std::size_t trace) const;
  std::int64_t leastIntervals(std::size_t stretch) const;
  std::vector<BoundaryPlace> sampleStretch(
    const CurveStretch& stretch, std::int64_t leastIntervals, const ParallelFor& parallelFor);
  BoundaryPlace startOf(const CurveStretch& stretch, const BoundaryPlace& sampled) const;
  std::vector<BoundaryPlace> mirrored(const CurveStretch& stretch, Span<BoundaryPlace> other) const;
  void joinSides(const std::vector<std::size_t>& starts);

  const Isosurface& Surface;
  bool IsCut;
  const TracedCurves& Curves;
  CurveInterpolation& Between;
  SampledPlaces Result;
};

/// Whether the surface is cut, and a curve closed: then the surface beside it has triangles.
bool CurveSampling::bounds(std::size_t trace) const
{
  const BoundaryTrace& curve = this->Curves.traces[trace];
  if (!this->IsCut || !curve.closed)
  {
    return false;
  }
  double length = 0.0;
  for (std::size_t v = 1; v < curve.vertices.size(); ++v)
  {
    length += glm::distance(curve.vertices[v - 1].position(), curve.vertices[v].position());
  }
  return length > shortestCurve * this->Between.spacingAt(curve.vertices.front().leaving);
}

/// So many intervals a stretch needs that the surface beside it is no line: a closed curve through three places.
std::int64_t CurveSampling::leastIntervals(std::size_t stretch) const
{
  const CurveStretch& curve = this->Curves.stretches[stretch];
  if (!this->bounds(curve.trace))
  {
    return 1;
  }
  const auto isOfCurve = [&](std::size_t s)
  { return s < this->Curves.stretches.size() && this->Curves.stretches[s].trace == curve.trace; };
  const bool hasTwo = isOfCurve(stretch + 1) || (stretch > 0 && isOfCurve(stretch - 1));
  const bool hasThree = (isOfCurve(stretch + 1) && isOfCurve(stretch + 2)) ||
    (stretch > 0 && isOfCurve(stretch - 1) && isOfCurve(stretch + 1)) ||
    (stretch > 1 && isOfCurve(stretch - 2));
  return hasThree ? 1 : hasTwo ? 2 : 3;
}

/// The first place of a stretch. Where a boundary curve goes over into a crease, the particle is one of the boundary
/// curve.
BoundaryPlace CurveSampling::startOf(
  const CurveStretch& stretch, const BoundaryPlace& sampled) const
{
  const BoundaryVertex& vertex = this->Curves.traces[stretch.trace].vertices[stretch.first];
  const bool isEndOfBoundary = vertex.corner && isCutAt(this->Surface, vertex.leaving) &&
    !isCutAt(this->Surface, vertex.arriving);
  return isEndOfBoundary
    ? BoundaryPlace{ vertex.arriving.at.location, vertex.arriving.face, sampled.spacing }
    : sampled;
}

/// Places along a stretch, at equal distances in units of the spacing wanted there, the first one on the first vertex.
std::vector<BoundaryPlace> CurveSampling::sampleStretch(
  const CurveStretch& stretch, std::int64_t leastIntervals, const ParallelFor& parallelFor)
{
  // Places between two questions whether to end early: fewer cost more calls, more delay an abort. Chosen by experiment.
  constexpr std::int64_t placesAtOnce = 4096;
  const Span<BoundaryVertex> vertices(
    &this->Curves.traces[stretch.trace].vertices[stretch.first], stretch.last + 1 - stretch.first);
  std::vector<BoundaryPlace> places;
  std::vector<double> sums{ 0.0 };
  std::vector<double> spacings{ 0.0 };
  double spacing = 0.0;
  for (std::size_t v = 1; v < vertices.size(); ++v)
  {
    const double before = v > 1 ? spacing
      : this->IsCut             ? this->Between.spacingAt(vertices[0].leaving)
                                : 0.0;
    spacing = this->Between.spacingAt(vertices[v].arriving);
    spacings.push_back(spacing);
    const double length = glm::distance(vertices[v - 1].position(), vertices[v].position());
    sums.push_back(sums.back() + length / (this->IsCut ? std::min(before, spacing) : spacing));
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
    spacing = this->IsCut ? spacings[v] : spacing;
    const double chord = sums[v] - sums[v - 1];
    const double t = chord > 0.0 ? std::clamp((place - sums[v - 1]) / chord, 0.0, 1.0) : 0.0;
    places.push_back(this->Between.placeBetween(from, to, t));
    places.back().spacing = spacing;
  }
  places.front() = this->startOf(stretch, places.front());
  return places;
}

/// The places of a crease that was sampled from its other side.
/// \param other places in the order of the other side, the one at its end left out
std::vector<BoundaryPlace> CurveSampling::mirrored(
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
  const std::vector<BoundaryVertex>& vertices = this->Curves.traces[stretch.trace].vertices;
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

/// Finds out which places on the two sides of creases are one.
/// \param starts number of the first place of each stretch, and of all places
void CurveSampling::joinSides(const std::vector<std::size_t>& starts)
{
  const std::vector<int>& partners = this->Curves.partners;
  const auto endOf = [&](std::size_t s)
  {
    const CurveStretch& stretch = this->Curves.stretches[s];
    const CurveRange& curve = this->Result.ranges[stretch.trace];
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
    const std::size_t count =
      starts[s + 1] - starts[s] - (this->Curves.stretches[s].withEnd ? 1 : 0);
    add(this->Result.corners, starts[s], endOf(other));
    add(this->Result.corners, endOf(s), starts[other]);
    for (std::size_t n = 1; n < count; ++n)
    {
      add(this->Result.twins, starts[s] + n, starts[other] + count - n);
    }
  }
}

SampledPlaces CurveSampling::place(const ParallelFor& parallelFor)
{
  const std::vector<int>& partners = this->Curves.partners;
  const auto isMirror = [&](std::size_t s)
  { return partners[s] >= 0 && partners[s] < static_cast<int>(s); };
  std::vector<std::size_t> starts;
  std::vector<std::size_t> firsts(this->Curves.traces.size(), this->Curves.stretches.size());
  std::vector<std::size_t> stretchCounts(this->Curves.traces.size(), 0);
  for (std::size_t s = 0; s < this->Curves.stretches.size(); ++s)
  {
    const CurveStretch& stretch = this->Curves.stretches[s];
    firsts[stretch.trace] = std::min(firsts[stretch.trace], s);
    stretchCounts[stretch.trace] += 1;
    starts.push_back(this->Result.places.size());
    std::vector<BoundaryPlace> places;
    if (isMirror(s))
    {
      const std::size_t begin = starts[partners[s]];
      const std::size_t end =
        starts[partners[s] + 1] - (this->Curves.stretches[partners[s]].withEnd ? 1 : 0);
      places = this->mirrored(stretch, { &this->Result.places[begin], end - begin });
    }
    else
    {
      const std::int64_t least = partners[s] < 0
        ? this->leastIntervals(s)
        : std::max(this->leastIntervals(s), this->leastIntervals(partners[s]));
      places = this->sampleStretch(stretch, least, parallelFor);
    }
    this->Result.places.insert(this->Result.places.end(), places.begin(), places.end());
    this->Result.beginsCrease.resize(this->Result.places.size(), stretch.creaseFace >= 0);
    this->Result.isCorner.resize(this->Result.places.size(), 0);
    this->Result.isCorner[starts.back()] = !stretch.isRing;
  }
  starts.push_back(this->Result.places.size());
  for (std::size_t t = 0; t < this->Curves.traces.size(); ++t)
  {
    const std::size_t first = starts[firsts[t]];
    const std::size_t count = starts[firsts[t] + stretchCounts[t]] - first;
    this->Result.ranges.push_back({ first, count, this->Curves.traces[t].closed });
    this->Result.isNeeded.insert(
      this->Result.isNeeded.end(), count, count <= fewPlaces && this->bounds(t));
  }
  this->joinSides(starts);
  return std::move(this->Result);
}

} // namespace

SampledPlaces samplePlaces(const Isosurface& surface, bool isCut, const TracedCurves& curves,
  CurveInterpolation& interpolation, const ParallelFor& parallelFor)
{
  return CurveSampling(surface, isCut, curves, interpolation).place(parallelFor);
}

} // namespace hop
