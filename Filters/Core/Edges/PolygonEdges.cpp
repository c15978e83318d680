#include "Edges/PolygonEdges.h"

#include "Edges/CellBorders.h"
#include "Edges/CurveSegments.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hop
{
namespace
{

/// Lengths in units of the spacing.
struct PolygonReach
{
  /// How far from a place of an edge a search for it may begin: seeds are about a spacing apart. Smaller: places stay
  /// without a particle where seeds are few; larger: searches take longer.
  static constexpr double Start = 2.0;
  /// Least distance of other particles from the place where an edge leaves the mesh: those on boundary curves, and the
  /// last one on the edge. Half of it would crowd, twice as much leave a gap.
  static constexpr double Least = 0.5;
  /// Largest distance of particles that follow each other around the corner between an edge and a boundary curve.
  static constexpr double Following = 1.6;
};

/// A place on the polygon's edges at which a particle is wanted.
struct EdgePlace
{
  glm::dvec3 position{ 0.0 };
  std::size_t edge = 0;
  bool isCorner = false;
  /// Nothing where the place is not in the mesh.
  std::optional<Evaluated> found;
  /// Whether the edge leaves the mesh here, and how the surface ends there.
  bool isEnd = false;
  BoundarySide meshSide;
};

class EdgeSampler
{
public:
  EdgeSampler(const Isosurface& surface, const PlanePolygon& polygon, double spacing)
    : Surface(surface)
    , Polygon(polygon)
    , Spacing(spacing)
    , Walker(surface, true)
  {
  }

  /// All around the polygon.
  std::vector<EdgePlace> sample(const Buffer<Anchor>& near, const Buffer<Patch>& nearPatches);
  std::optional<BoundaryParticle> particleAt(const EdgePlace& place);
  std::int64_t evaluations() const { return this->Walker.evaluations(); }

private:
  std::optional<Evaluated> reach(const Location& start, const glm::dvec3& target);
  void find(std::vector<EdgePlace>& places, std::size_t edge, const Buffer<Anchor>& near,
    const Buffer<Patch>& nearPatches);
  EdgePlace endBetween(const EdgePlace& inside, const EdgePlace& outside);
  BoundarySide sideOf(std::size_t edge) const
  {
    return { -1, { this->Polygon.outward(edge) }, 0.0 };
  }

  const Isosurface& Surface;
  const PlanePolygon& Polygon;
  double Spacing;
  SurfaceWalker Walker;
};

/// The place of the mesh at a target on the surface, by Newton's method from a place nearby.
std::optional<Evaluated> EdgeSampler::reach(const Location& start, const glm::dvec3& target)
{
  constexpr int mostSteps =
    12; // Newton's method takes some five, from element to element some more
  constexpr double epsilons = 16.0;
  const double rounding = epsilons * std::numeric_limits<double>::epsilon() * glm::length(target);
  const double accuracy = std::max(0.01 * this->Surface.tolerance, rounding);
  Evaluated at = this->Walker.evaluate(start);
  for (int n = 0; n < mostSteps && !at.point.map.singular; ++n)
  {
    const WorldVector rest{ target - at.point.map.position.xyz };
    if (length(rest) <= accuracy)
    {
      return at;
    }
    at = this->Walker.evaluate(this->Walker.move(at, rest));
  }
  return std::nullopt;
}

/// Looks for the places of an edge in the mesh.
void EdgeSampler::find(std::vector<EdgePlace>& places, std::size_t edge, const Buffer<Anchor>& near,
  const Buffer<Patch>& nearPatches)
{
  constexpr std::size_t mostStarts = 4;
  const double farthest = PolygonReach::Start * this->Spacing;
  const glm::dvec3& begin = this->Polygon.corner(edge);
  const double length = glm::distance(begin, this->Polygon.corner(edge + 1));
  const glm::dvec3 along = (this->Polygon.corner(edge + 1) - begin) / length;
  std::vector<std::size_t> beside;
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    const glm::dvec3 step = nearPatches[i].position - begin;
    const double t = std::clamp(glm::dot(step, along), 0.0, length);
    if (glm::length(step - t * along) <= farthest)
    {
      beside.push_back(i);
    }
  }
  for (EdgePlace& place : places)
  {
    if (place.edge != edge)
    {
      continue;
    }
    std::vector<std::pair<double, std::size_t>> starts;
    for (const std::size_t i : beside)
    {
      const double distance = glm::distance(nearPatches[i].position, place.position);
      if (distance <= farthest)
      {
        starts.push_back({ distance, i });
      }
    }
    std::sort(starts.begin(), starts.end());
    for (std::size_t n = 0; n < std::min(starts.size(), mostStarts) && !place.found; ++n)
    {
      place.found = this->reach(near[starts[n].second].place, place.position);
    }
  }
}

/// The place between two of an edge at which it leaves the mesh, by bisection.
EdgePlace EdgeSampler::endBetween(const EdgePlace& inside, const EdgePlace& outside)
{
  constexpr int halvings = 40; // a spacing by 10^12
  EdgePlace end = inside;
  end.isCorner = false;
  end.isEnd = true;
  glm::dvec3 beyond = outside.position;
  for (int n = 0; n < halvings; ++n)
  {
    const glm::dvec3 middle = 0.5 * (end.position + beyond);
    const auto found = this->reach(end.found->location, middle);
    end.found = found ? found : end.found;
    (found ? end.position : beyond) = middle;
  }
  return end;
}

std::vector<EdgePlace> EdgeSampler::sample(
  const Buffer<Anchor>& near, const Buffer<Patch>& nearPatches)
{
  std::vector<EdgePlace> wanted;
  for (std::size_t edge = 0; edge < this->Polygon.corners.size(); ++edge)
  {
    const glm::dvec3& begin = this->Polygon.corner(edge);
    const glm::dvec3& end = this->Polygon.corner(edge + 1);
    const int count =
      std::max(1, static_cast<int>(std::lround(glm::distance(begin, end) / this->Spacing)));
    for (int k = 0; k < count; ++k)
    {
      EdgePlace& place = wanted.emplace_back();
      place.position = begin + (static_cast<double>(k) / count) * (end - begin);
      place.edge = edge;
      place.isCorner = k == 0;
    }
  }
  for (std::size_t edge = 0; edge < this->Polygon.corners.size(); ++edge)
  {
    this->find(wanted, edge, near, nearPatches);
  }
  std::vector<EdgePlace> places;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    const EdgePlace& here = wanted[i];
    const EdgePlace& next = wanted[(i + 1) % wanted.size()];
    places.push_back(here);
    if (here.found.has_value() != next.found.has_value())
    {
      places.push_back(this->endBetween(here.found ? here : next, here.found ? next : here));
      places.back().edge = here.edge;
    }
  }
  return places;
}

std::optional<BoundaryParticle> EdgeSampler::particleAt(const EdgePlace& place)
{
  BoundaryParticle result;
  Anchor anchor;
  if (!place.found || !anchorPatch(*place.found, anchor, result.patch))
  {
    return std::nullopt;
  }
  const Evaluated& at = *place.found;
  result.patch.spacing = static_cast<float>(this->Spacing);
  result.patch.fixed = true;
  result.particle =
    hop::particleAt(at.location, at.point, curvature(at.point.gradient, at.hessian), this->Spacing);
  markCellBorders(
    *this->Surface.mesh, this->Walker.jetAt(at.location), at.point.map, result.particle);
  result.side = this->sideOf(place.edge);
  result.otherSide =
    place.isCorner ? this->sideOf(place.edge + this->Polygon.corners.size() - 1) : place.meshSide;
  return result;
}

/// Drops the particles on boundary curves that are not marked.
void keepOnCurves(const std::vector<char>& kept, BoundaryCurves& curves)
{
  for (auto* pairs : { &curves.edges.segments, &curves.edges.directed, &curves.edges.coincident })
  {
    pairs->erase(
      std::remove_if(pairs->begin(), pairs->end(),
        [&](const std::array<int, 2>& pair) { return !kept[pair[0]] || !kept[pair[1]]; }),
      pairs->end());
    renumber(*pairs, kept);
  }
  keepMarked(curves.particles, kept);
}

/// Drops what boundary curves have outside of a polygon, or in the way of an edge's end.
void cutCurves(const PlanePolygon& polygon, const std::vector<EdgePlace>& places, double spacing,
  BoundaryCurves& curves)
{
  const auto isWanted = [&](const BoundaryParticle& some)
  {
    const glm::dvec3& position = some.particle.position.xyz;
    return polygon.beyond(position) <= 0.0 &&
      std::none_of(places.begin(), places.end(),
        [&](const EdgePlace& place) {
          return place.found &&
            glm::distance(place.position, position) < PolygonReach::Least * spacing;
        });
  };
  std::vector<char> kept(curves.particles.size());
  std::transform(curves.particles.begin(), curves.particles.end(), kept.begin(), isWanted);
  keepOnCurves(kept, curves);
  curves.thinned.erase(std::remove_if(curves.thinned.begin(), curves.thinned.end(),
                         [&](const BoundaryParticle& some)
                         { return polygon.beyond(some.particle.position.xyz) > 0.0; }),
    curves.thinned.end());
}

/// Drops places in the way of an edge's end.
void makeRoomAtEnds(std::vector<EdgePlace>& places, double spacing)
{
  const std::size_t count = places.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    for (const std::size_t j : { (i + 1) % count, (i + count - 1) % count })
    {
      if (places[i].isEnd && places[j].found && !places[j].isEnd && !places[j].isCorner &&
        glm::distance(places[i].position, places[j].position) < PolygonReach::Least * spacing)
      {
        places.erase(places.begin() + static_cast<std::ptrdiff_t>(j));
        makeRoomAtEnds(places, spacing);
        return;
      }
    }
  }
}

/// The nearest of the first particles on boundary curves to an end of an edge; -1 if none follows it.
int nextOnCurve(
  const BoundaryCurves& curves, std::size_t onCurves, const glm::dvec3& end, double spacing)
{
  double nearest = PolygonReach::Following * spacing;
  int result = -1;
  for (std::size_t n = 0; n < onCurves; ++n)
  {
    const double distance = glm::distance(curves.particles[n].particle.position.xyz, end);
    if (distance < nearest)
    {
      nearest = distance;
      result = static_cast<int>(n);
    }
  }
  return result;
}

} // namespace

std::size_t addPolygonEdges(const Isosurface& surface, const PlanePolygon& polygon, double spacing,
  const Buffer<Anchor>& near, const Buffer<Patch>& nearPatches, BoundaryCurves& curves)
{
  EdgeSampler sampler(surface, polygon, spacing);
  std::vector<EdgePlace> places = sampler.sample(near, nearPatches);
  makeRoomAtEnds(places, spacing);
  for (EdgePlace& place : places)
  {
    const int next =
      place.isEnd ? nextOnCurve(curves, curves.particles.size(), place.position, spacing) : -1;
    place.meshSide = next >= 0 ? curves.particles[next].side : BoundarySide{};
  }
  cutCurves(polygon, places, spacing, curves);
  const std::size_t first = curves.particles.size();
  std::vector<int> numbers(places.size(), -1);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (const auto particle = sampler.particleAt(places[i]))
    {
      numbers[i] = static_cast<int>(curves.particles.size());
      curves.particles.push_back(*particle);
      if (particle->otherSide.exists())
      {
        curves.thinned.push_back(*particle);
        curves.thinned[curves.thinned.size() - 1].side = particle->otherSide;
      }
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const std::size_t next = (i + 1) % places.size();
    // Two ends in a row are the two sides of a gap, but where the mesh holds less than a spacing of an edge.
    if (numbers[i] >= 0 && numbers[next] >= 0 && !(places[i].isEnd && places[next].isEnd))
    {
      curves.edges.segments.push_back({ numbers[i], numbers[next] });
    }
    const int other = places[i].isEnd && numbers[i] >= 0
      ? nextOnCurve(curves, first, places[i].position, spacing)
      : -1;
    if (other >= 0)
    {
      curves.edges.segments.push_back({ other, numbers[i] });
    }
  }
  sortPairs(curves.edges.segments);
  curves.evaluations += sampler.evaluations();
  return first;
}

} // namespace hop
