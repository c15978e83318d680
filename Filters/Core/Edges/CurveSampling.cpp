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
/// edges of the mesh and comes back, within its tolerance.
constexpr double shortestCurve = 1e-4;

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
  /// A place on a stretch up to which lengths are summed up.
  struct Knot
  {
    /// Number of the vertex at the end of the chord, and share of the chord's length.
    std::size_t chord = 1;
    double share = 0.0;
    /// Length of the stretch up to here, in units of the spacing.
    double sum = 0.0;
    double spacing = 0.0;
  };

  /// A step of a trace.
  struct Chord
  {
    const BoundaryPoint* from = nullptr;
    const BoundaryPoint* to = nullptr;
    /// World units.
    double length = 0.0;
  };

  bool bounds(std::size_t trace) const;
  std::int64_t leastIntervals(std::size_t stretch) const;
  void addKnots(const Chord& chord, const Knot& begin, const Knot& end, std::vector<Knot>& knots);
  double spacingWhereArriving(const BoundaryVertex& vertex);
  std::vector<Knot> knotsOf(Span<BoundaryVertex> vertices);
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
  return length > shortestCurve * curve.vertices.front().spacing;
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

/// Cuts a part of a chord of a trace in two, and again, as long as it is long beside the spacings at its ends: spacings may
/// be smaller in between.
/// \param begin,end of the part
/// \param knots whose last one is where the part begins; receives those behind it
void CurveSampling::addKnots(
  const Chord& chord, const Knot& begin, const Knot& end, std::vector<Knot>& knots)
{
  // Longest part, in units of the spacing. Chosen by experiment. Larger: gaps where spacings are smaller in between;
  // smaller: more evaluations.
  constexpr double longest = 2.2;
  // Parts of a chord that are as short as places can be told apart.
  constexpr double shortest = 1e-6;
  const double spacing = std::min(begin.spacing, end.spacing);
  const double share = end.share - begin.share;
  if (share * chord.length <= longest * spacing || share < shortest)
  {
    knots.push_back(end);
    knots.back().sum = knots[knots.size() - 2].sum + share * chord.length / spacing;
    return;
  }
  Knot middle{ end.chord, 0.5 * (begin.share + end.share), 0.0, 0.0 };
  middle.spacing = this->Between.spacingAt(
    this->Between.placeBetween(*chord.from, *chord.to, middle.share).location);
  this->addKnots(chord, begin, middle, knots);
  this->addKnots(chord, middle, end, knots);
}

/// The spacing at a vertex, where a curve comes to another element in that which it leaves: curvatures of the two differ.
double CurveSampling::spacingWhereArriving(const BoundaryVertex& vertex)
{
  const Location& arriving = vertex.arriving.at.location;
  return arriving.element == vertex.leaving.at.location.element ? vertex.spacing
                                                                : this->Between.spacingAt(arriving);
}

/// The sums of lengths in units of the spacing along a stretch.
std::vector<CurveSampling::Knot> CurveSampling::knotsOf(Span<BoundaryVertex> vertices)
{
  std::vector<Knot> knots{ { 1, 0.0, 0.0, vertices[0].spacing } };
  for (std::size_t v = 1; v < vertices.size(); ++v)
  {
    const Chord chord{ &vertices[v - 1].leaving, &vertices[v].arriving,
      glm::distance(vertices[v - 1].position(), vertices[v].position()) };
    const Knot end{ v, 1.0, 0.0, this->spacingWhereArriving(vertices[v]) };
    if (this->IsCut)
    {
      this->addKnots(chord, { v, 0.0, 0.0, knots.back().spacing }, end, knots);
    }
    else
    {
      const double perSpacing = 0.5 * (1.0 / knots.back().spacing + 1.0 / end.spacing);
      knots.push_back({ v, 1.0, knots.back().sum + perSpacing * chord.length, end.spacing });
    }
  }
  return knots;
}

/// Places along a stretch, at equal distances in units of the spacing wanted there, the first one on the first vertex.
std::vector<BoundaryPlace> CurveSampling::sampleStretch(
  const CurveStretch& stretch, std::int64_t leastIntervals, const ParallelFor& parallelFor)
{
  // Places between two questions whether to end early: fewer cost more calls, more delay an abort. Chosen by experiment.
  constexpr std::int64_t placesAtOnce = 4096;
  // Beyond the chords of a coarser crease particles beside it would stand.
  constexpr double longestInterval = 1.1;
  const Span<BoundaryVertex> vertices(
    &this->Curves.traces[stretch.trace].vertices[stretch.first], stretch.last + 1 - stretch.first);
  const std::vector<Knot> knots = this->knotsOf(vertices);
  const double whole = knots.back().sum;
  const std::int64_t wanted = stretch.creaseFace < 0
    ? std::llround(whole)
    : static_cast<std::int64_t>(std::ceil(whole / longestInterval));
  const std::int64_t count = std::max(leastIntervals, wanted);
  std::vector<BoundaryPlace> places;
  std::size_t k = 1;
  for (std::int64_t n = 0; n < count + stretch.withEnd; ++n)
  {
    if (n % placesAtOnce == placesAtOnce - 1)
    {
      askCaller(parallelFor);
    }
    const double place = whole * static_cast<double>(n) / static_cast<double>(count);
    while (k + 1 < knots.size() && knots[k].sum < place)
    {
      ++k;
    }
    const Knot& end = knots[k];
    const double begin = k > 1 && knots[k - 1].chord == end.chord ? knots[k - 1].share : 0.0;
    const double part = end.sum - knots[k - 1].sum;
    const double t = part > 0.0 ? std::clamp((place - knots[k - 1].sum) / part, 0.0, 1.0) : 0.0;
    places.push_back(this->Between.placeBetween(vertices[end.chord - 1].leaving,
      vertices[end.chord].arriving, begin + t * (end.share - begin)));
    places.back().spacing = this->IsCut ? end.spacing : knots.back().spacing;
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
