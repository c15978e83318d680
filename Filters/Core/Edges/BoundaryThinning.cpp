#include "Edges/BoundaryThinning.h"

#include "Edges/ParticleGrid.h"
#include "Support/KeepFirst.h"
#include "Support/KeepMarked.h"
#include "Support/SpacingGrid.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hop
{
namespace
{

/// When two particles are too near to each other, in units of the spacing of the later one. Chosen by experiment.
struct Nearness
{
  /// On one sheet. Evenly spaced curves keep nearly one spacing; less than this stand corners that are close to each
  /// other, and curves that run side by side. More drops particles of short stretches between corners, less leaves
  /// pairs.
  static constexpr double OnOneSheet = 0.6;
  /// Where two sheets meet at a sharp edge, and each has a curve of its own.
  static constexpr double AtSharpEdge = 0.3;
  /// Largest distance of places of one corner, far above rounding and far below the distance of different corners.
  static constexpr double OnePlace = 1e-6;
  /// On the two sides of a jump, each of which ends by itself; and on those of any slit or strip for meshes, to which each
  /// side is a boundary of its own. Less may be one place that files write twice in single precision; more leaves ends of
  /// sheets without particles, and tips of strips without triangles.
  static constexpr double OnTwoSides = 0.02;
  /// Smallest width of a strip of the surface: less may be a crack between elements, as files write them in single
  /// precision, at which the sides overlap. More draws narrower strips a splat wide.
  static constexpr double LeastStrip = 1e-3;
};

/// Whether two ends of the surface are the two sides of a jump between elements. Their sheets may reach over each other,
/// so that places alone do not tell a jump from the two sides of a strip.
bool areSidesOfJump(const BoundaryParticle& a, const BoundaryParticle& b)
{
  return a.particle.location.element != b.particle.location.element && a.particle.jump != 0.0 &&
    b.particle.jump != 0.0 && lookAtEachOther(a.side, b.side);
}

/// Whether two particles bound two pieces of the surface, or parts of a piece in two elements, at a jump.
bool areOfTwoPieces(
  const ElementMesh& mesh, const SurfacePieces& pieces, const Particle& a, const Particle& b)
{
  return a.location.element != b.location.element &&
    (a.jump != 0.0 || b.jump != 0.0 || !pieces.areSame(a.location, b.location) ||
      pieces.endBetween(mesh, a.location.element, b.location.element));
}

bool areTooNear(const ElementMesh& mesh, const BoundaryParticle& a, const BoundaryParticle& b,
  ThinnedCurves wanted, const SurfacePieces& pieces)
{
  if (a.isOnCrease || b.isOnCrease)
  {
    return false; // the other side has one here
  }
  if (a.isNeeded || b.isNeeded)
  {
    return false;
  }
  if (wanted == ThinnedCurves::OfPieces && areOfTwoPieces(mesh, pieces, a.particle, b.particle))
  {
    return false;
  }
  const bool isForMesh = wanted != ThinnedCurves::OfSplats;
  if (areSidesOfJump(a, b) || (isForMesh && lookAtEachOther(a.side, b.side)))
  {
    return glm::distance(a.patch.position, b.patch.position) <
      Nearness::OnTwoSides * a.patch.spacing;
  }
  const double cosine = dot(a.particle.normal, b.particle.normal);
  const double near = cosine > SheetCosine ? Nearness::OnOneSheet : Nearness::AtSharpEdge;
  return cosine > 0.0 && glm::distance(a.patch.position, b.patch.position) < near * a.patch.spacing;
}

/// The order in which particles stay. Meshes keep corners before all others, lest edges cut them off.
/// \return indices of particles
std::vector<std::size_t> orderOf(const Buffer<BoundaryParticle>& particles, ThinnedCurves wanted)
{
  std::vector<std::size_t> order(particles.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  if (wanted != ThinnedCurves::OfSplats)
  {
    std::stable_partition(
      order.begin(), order.end(), [&](std::size_t i) { return particles[i].isCorner; });
  }
  return order;
}

/// Whether two particles that look away from each other have the surface between them, as on a strip, or are the two
/// sides of one sharp corner.
bool areAcrossSurface(const BoundaryParticle& a, const BoundaryParticle& b)
{
  const WorldVector step = b.particle.position - a.particle.position;
  const double h = a.patch.spacing;
  const bool inOneElement = a.particle.location.element == b.particle.location.element;
  if (inOneElement && length(step) < Nearness::OnePlace * h)
  {
    return true;
  }
  return !areSidesOfJump(a, b) && dot(step, a.side.outward) < -Nearness::LeastStrip * h &&
    dot(step, b.side.outward) > Nearness::LeastStrip * h;
}

/// Finds out which particles follow each other on a curve. Two at which the surface ends no more, because a slit was
/// closed, are not the ends of a piece of curve.
/// \param kept marks the particles that stay
/// \param standIns for each of the others the particle that is too near to it
void connect(const std::vector<char>& kept, const std::vector<int>& standIns,
  std::vector<CurvePlace> places, const std::vector<CurveRange>& ranges, ThinnedCurves wanted,
  BoundaryCurves& curves)
{
  const Buffer<BoundaryParticle>& particles = curves.particles;
  for (CurvePlace& place : places)
  {
    if (place.particle >= 0 && !kept[place.particle])
    {
      place.standIn = standIns[place.particle];
      place.particle = -1;
    }
  }
  const auto hasNoEnd = [](const BoundaryParticle& particle)
  { return !particle.side.exists() && !particle.isOnCrease; };
  SurfaceEdges& edges = curves.edges;
  std::vector<std::array<int, 2>> segments = segmentsOf(places, ranges);
  segments.erase(std::remove_if(segments.begin(), segments.end(),
                   [&](const std::array<int, 2>& pair)
                   { return hasNoEnd(particles[pair[0]]) && hasNoEnd(particles[pair[1]]); }),
    segments.end());
  edges.segments = withoutDropped(segments, kept);
  edges.directed = directedEdgesOf(places, ranges, wanted != ThinnedCurves::OfSplats);
  renumber(edges.directed, kept);
  renumber(edges.coincident, kept);
}

/// Where the next element of a curve begins within a small distance of a corner, the stretch in between is a crack, as
/// between elements that are not curved alike: the surface does not end at it. Nor does it at a curve of one place.
/// \return marks of particles that are a curve of their own
std::vector<char> passCracks(const std::vector<CurvePlace>& places,
  const std::vector<CurveRange>& ranges, Buffer<BoundaryParticle>& particles)
{
  std::vector<char> isAlone(particles.size(), 0);
  for (const CurveRange& range : ranges)
  {
    for (std::size_t n = 0; n < range.count; ++n)
    {
      const int here = places[range.first + n].particle;
      // An open curve may end beside its beginning.
      const int next = places[range.first + (n + 1) % range.count].particle;
      if (here < 0 || next < 0)
      {
        continue;
      }
      BoundaryParticle& a = particles[here];
      BoundaryParticle& b = particles[next];
      isAlone[here] = static_cast<char>(isAlone[here] || here == next);
      if (a.particle.location.element != b.particle.location.element &&
        glm::distance(a.patch.position, b.patch.position) < Nearness::OnTwoSides * a.patch.spacing)
      {
        a.otherSide = {};
        b.otherSide = {};
      }
    }
  }
  return isAlone;
}

/// Corners tell of both curves that meet there.
void addOtherSides(BoundaryCurves& curves)
{
  for (const BoundaryParticle& corner : curves.particles)
  {
    if (corner.side.exists() && corner.otherSide.exists())
    {
      curves.thinned.push_back(corner);
      curves.thinned[curves.thinned.size() - 1].side = corner.otherSide;
    }
  }
}

} // namespace

void thinOut(const ElementMesh& mesh, std::vector<CurvePlace> places,
  const std::vector<CurveRange>& ranges, ThinnedCurves wanted, BoundaryCurves& curves,
  const ParallelFor& parallelFor)
{
  Buffer<BoundaryParticle>& particles = curves.particles;
  const std::vector<char> isAlone = passCracks(places, ranges, particles);
  const SpacedPoints points(
    particles.size(), [&](std::size_t i) { return particles[i].patch.position; },
    [&](std::size_t i) { return particles[i].patch.spacing; }, parallelFor);
  const SpacingGrid grid(
    points.positions, points.spacings, Nearness::OnOneSheet, CellsPerReach, parallelFor);
  const std::size_t count = particles.size();
  const std::vector<std::size_t> order = orderOf(particles, wanted);
  std::vector<std::size_t> ranks(count);
  for (std::size_t rank = 0; rank < count; ++rank)
  {
    ranks[order[rank]] = rank;
  }
  const auto visitEarlier = [&](std::size_t i, const auto& use)
  {
    grid.visit(points.positions[i], points.spacings[i],
      [&](std::size_t j)
      {
        if (ranks[j] < ranks[i] &&
          areTooNear(mesh, particles[i], particles[j], wanted, curves.pieces))
        {
          use(j);
        }
      });
  };
  const std::vector<char> keptInOrder = keepFirst(std::vector<char>(count, 1), count, parallelFor,
    [&](std::size_t rank, const auto& use)
    { visitEarlier(order[rank], [&](std::size_t j) { use(ranks[j]); }); });
  std::vector<char> kept(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    kept[i] = keptInOrder[ranks[i]];
  }
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
      if ((particles[i].particle.jump == 0.0 || isOnStrip) && !closesSlit[i] && !isAlone[i])
      {
        curves.thinned.push_back(particles[i]);
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (closesSlit[i])
    {
      // Of a corner the other curve stays, as where a slit comes to the end of the domain.
      particles[i].side = std::exchange(particles[i].otherSide, {});
    }
  }
  connect(kept, standIns, std::move(places), ranges, wanted, curves);
  keepMarked(particles, kept);
  addOtherSides(curves);
}

} // namespace hop
