#include "Mesh/SurfaceMesh.h"

#include "Kernel/InstructionSet.h"
#include "Mesh/ConvexPolygon.h"
#include "Mesh/TangentView.h"
#include "Support/Interruptible.h"
#include "Support/KeepMarked.h"
#include "Support/SeenPoints.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hop
{
namespace
{

/// How far neighbours are looked for, in units of the spacing.
struct CellReach
{
  /// Neighbours within this (the harmonic mean of both spacings) are found first: all of a cell as a rule, whose corners
  /// are at 0.6 to 0.8. Changes the time alone: larger, more neighbours are looked at; smaller, more cells are made anew.
  static constexpr double First = 1.6;
  /// A cell whose corners are farther away than this is made anew among all neighbours: one that is nearer than twice the
  /// distance of a corner may be missing. Less than half of the first reach, as a neighbour with a smaller spacing is
  /// seen less far.
  static constexpr double Trusted = 0.75;
  /// Cells of the grid in the first reach. Changes the time alone: of 0.5 to 1.6, 0.7 was fastest (mesh_table).
  static constexpr double GridCells = 0.7;
};

/// Makes the cells of one particle after the other.
class AreaMeter
{
public:
  AreaMeter(const ParticlePlaces& places, const ConstrainedEdges& edges)
    : Places(places)
    , View(places, edges)
  {
  }

  /// World units squared.
  /// \param near the particles around, without itself
  double areaOf(int particle, Span<int> near)
  {
    if (this->Places.isReplaced(particle))
    {
      return 0.0;
    }
    this->View.lookFrom(particle, near);
    this->At = &this->Places.particles[particle];
    this->findBend();
    this->ReachSquared = 0.0;
    double area = 0.0;
    if (!this->isAwayFromEdges() || !this->isClosed(area))
    {
      area = this->areaOfPolygons();
    }
    return area * this->At->spacing * this->At->spacing;
  }

  /// Square of the distance of the farthest corner of the last particle's cell, in units of its spacing.
  double reachSquared() const { return this->ReachSquared; }

private:
  /// A plane that is nearer to a particle on an edge of the surface than this, in units of its spacing, is that of the
  /// edge.
  static constexpr double AtEdge = 0.05;

  /// How much larger a piece of the surface at t is than its picture in the plane, less 1. Places stand at their distance
  /// d in space; with the arc length r = d (1 + k^2 d^2/24) along a normal section of curvature k, and the area r (1 - K
  /// r^2/6) dr of a geodesic disk, that is (k^2 - K) d^2/6.
  void findBend()
  {
    const Curvature& curvature = this->At->curvature;
    const glm::dvec3& a = this->View.plane().across;
    const glm::dvec3& b = this->View.plane().along;
    const double unit = this->At->spacing * this->At->spacing / 6.0;
    const double root = std::sqrt(unit);
    const glm::dvec3 bendOfA = root * (curvature.shape * a);
    const glm::dvec3 bendOfB = root * (curvature.shape * b);
    this->Bend = { glm::dot(a, bendOfA), glm::dot(a, bendOfB), glm::dot(b, bendOfB),
      unit * curvature.gauss };
  }

  double areaOfPolygons()
  {
    if (this->View.sectors().empty())
    {
      this->startCell(this->View.neighbors().size());
      return this->areaOfCell(this->View.neighbors(), 0.0);
    }
    double area = 0.0;
    for (const TangentView::Sector& sector : this->View.sectors())
    {
      area += this->areaOf(sector);
    }
    return area;
  }

  bool isAwayFromEdges() const
  {
    // Boundary curves come first.
    return !this->View.isNearEdge() && !this->At->clips[0].isBoundary();
  }

  /// Measures a cell that neighbours alone bound.
  /// \param area receives it, in squares of the spacing
  /// \return whether they do, nearby
  bool isClosed(double& area)
  {
    // The padding: so far away that it bounds no cell.
    constexpr double far = 16.0 * ParticleNeighbors::Reach;
    const std::vector<FlatNeighbor>& neighbors = this->View.neighbors();
    const std::size_t used = neighbors.size();
    const std::size_t count =
      kernel::MaximumLanes * ((used + kernel::MaximumLanes - 1) / kernel::MaximumLanes);
    this->NearX.resize(std::max(count, this->NearX.size()));
    this->NearY.resize(this->NearX.size());
    for (std::size_t n = 0; n < count; ++n)
    {
      this->NearX[n] = n < used ? neighbors[n].place.x : far;
      this->NearY[n] = n < used ? neighbors[n].place.y : 0.0;
    }
    const kernel::PlaneCell cell = kernel::current().planeCell(
      { this->NearX.data(), this->NearY.data(), static_cast<std::ptrdiff_t>(used),
        static_cast<std::ptrdiff_t>(count) },
      this->Bend);
    area = cell.area;
    return cell.reachSquared <= CellReach::Trusted * CellReach::Trusted;
  }

  void startCell(std::size_t neighbors)
  {
    // Holds the cell of a particle whose neighbours surround it.
    this->Whole.start(ParticleNeighbors::LargestRadius, neighbors + this->At->clips.size() + 2);
  }

  /// Cuts the cell off at boundary curves that are not nearer than `nearest`, and half-way to all neighbours. (Creases
  /// have particles of their own where the surface turns much; where it turns little the cells of both sides meet as on a
  /// smooth surface.)
  void cutCell(const std::vector<FlatNeighbor>& neighbors, double nearest)
  {
    for (const ClipPlane& plane : this->At->clips)
    {
      const double distance = plane.distance / this->At->spacing;
      if (plane.isBoundary() && distance >= nearest)
      {
        this->Whole.cut(this->View.plane().directionOf(plane.normal.xyz), distance);
      }
    }
    double reach = this->Whole.reachSquared();
    for (const FlatNeighbor& neighbor : neighbors)
    {
      const double squared = glm::dot(neighbor.place, neighbor.place);
      if (squared < 4.0 * reach)
      {
        this->Whole.cut(neighbor.place, 0.5 * squared);
        reach = this->Whole.reachSquared();
      }
    }
    this->ReachSquared = std::max(this->ReachSquared, reach);
  }

  /// Squares of the spacing.
  double areaOfCell(const std::vector<FlatNeighbor>& neighbors, double nearest)
  {
    this->cutCell(neighbors, nearest);
    const kernel::CellBend& bend = this->Bend;
    return this->Whole.integral(
      [&](const glm::dvec2& t)
      {
        const double squared = glm::dot(t, t);
        const double form = bend.xx * t.x * t.x + 2.0 * bend.xy * t.x * t.y + bend.yy * t.y * t.y;
        return squared > 0.0 ? form * form / squared - bend.gauss * squared : 0.0;
      });
  }

  /// What lies between the half of a constrained edge that belongs to the particle and the curve that the edge stands
  /// for: the integral of k x (l - x)/2 from 0 to l/2.
  double areaBeyond(const glm::dvec2& end, double sense) const
  {
    const double length = glm::length(end);
    const glm::dvec2 outward = sense * glm::dvec2(end.y, -end.x) / length;
    double most = 0.5;
    double bend = 0.0;
    for (const ClipPlane& plane : this->At->clips)
    {
      const double facing = glm::dot(this->View.plane().directionOf(plane.normal.xyz), outward);
      if (plane.distance < AtEdge * this->At->spacing && facing > most)
      {
        most = facing;
        bend = plane.edgeCurvature * this->At->spacing;
      }
    }
    return bend * length * length * length / 24.0;
  }

  /// Counterclockwise from one direction to another.
  /// \pre half a turn at most
  double areaOfWedge(
    const TangentView::Sector& sector, const glm::dvec2& from, const glm::dvec2& to)
  {
    this->startCell(sector.neighbors.size());
    this->Whole.cut({ from.y, -from.x }, 0.0);
    this->Whole.cut({ -to.y, to.x }, 0.0);
    return this->areaOfCell(sector.neighbors, AtEdge);
  }

  double areaOf(const TangentView::Sector& sector)
  {
    const glm::dvec2 first = sector.neighbors[sector.first].place;
    const glm::dvec2 last = sector.neighbors[sector.last].place;
    double area = 0.0;
    if (sector.first == sector.last || crossOf(first, last) < 0.0)
    {
      // More than half a turn: half a turn, and the rest.
      area = this->areaOfWedge(sector, first, -first) + this->areaOfWedge(sector, -first, last);
    }
    else
    {
      area = this->areaOfWedge(sector, first, last);
    }
    return area + this->areaBeyond(first, 1.0) + this->areaBeyond(last, -1.0);
  }

  const ParticlePlaces& Places;
  TangentView View;
  const Particle* At = nullptr;
  ConvexPolygon Whole;
  double ReachSquared = 0.0;
  kernel::CellBend Bend{};
  std::vector<double> NearX, NearY;
};

/// The areas of all particles: first among the nearest neighbours, then once more where these do not tell a cell.
class Areas
{
public:
  Areas(
    const Distribution& distribution, const ConstrainedEdges& edges, const ParallelFor& parallelFor)
    : Places(distribution, parallelFor)
    , Edges(edges)
    , Parallel(parallelFor)
    , Found(distribution.particles.size())
  {
  }

  std::vector<double> find()
  {
    std::vector<char> isDoubtful(this->Found.size(), 0);
    this->findAll(isDoubtful);
    const std::vector<int> doubtful = markedIndices(isDoubtful, isDoubtful.size());
    if (!doubtful.empty())
    {
      this->findAmongAll(doubtful);
    }
    return std::move(this->Found);
  }

private:
  void findAll(std::vector<char>& isDoubtful);
  void findAmongAll(const std::vector<int>& particles);

  ParticlePlaces Places;
  const ConstrainedEdges& Edges;
  const ParallelFor& Parallel;
  std::vector<double> Found;
};

/// \param isDoubtful receives which cells may lack a neighbour
void Areas::findAll(std::vector<char>& isDoubtful)
{
  const auto& positions = this->Places.points.positions;
  const auto& spacings = this->Places.points.spacings;
  const SpacingGrid grid(
    positions, spacings, CellReach::First, CellReach::GridCells, this->Parallel);
  Buffer<double> inverse(spacings.size());
  forAll(this->Parallel, inverse.size(), [&](std::size_t i) { inverse[i] = 1.0 / spacings[i]; });
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(spacings.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      AreaMeter meter(this->Places, this->Edges);
      SeenPoints finder(grid, positions, inverse, CellReach::First);
      std::vector<int> near;
      for (int first = static_cast<int>(begin); first < end; ++first)
      {
        // A cell of the grid is looked at once, when its first point comes.
        const SpacingGrid::Points points = grid.cellMates(first);
        if (*points.begin() != first)
        {
          continue;
        }
        finder.lookAround(points);
        near.resize(std::max(near.size(), finder.most()));
        for (const int i : points)
        {
          const int* last = finder.list(i, near.data());
          this->Found[i] =
            meter.areaOf(i, { near.data(), static_cast<std::size_t>(last - near.data()) });
          isDoubtful[i] = meter.reachSquared() > CellReach::Trusted * CellReach::Trusted;
        }
      }
    });
}

void Areas::findAmongAll(const std::vector<int>& particles)
{
  const auto& positions = this->Places.points.positions;
  const auto& spacings = this->Places.points.spacings;
  const SpacingGrid grid(positions, spacings, ParticleNeighbors::Reach, 1.0, this->Parallel);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(particles.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      AreaMeter meter(this->Places, this->Edges);
      std::vector<int> near;
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        const int i = particles[n];
        near.clear();
        grid.visit(positions[i], spacings[i],
          [&](int j)
          {
            const double reach =
              2.0 * ParticleNeighbors::Reach / (1.0 / spacings[i] + 1.0 / spacings[j]);
            if (j != i && glm::distance(positions[i], positions[j]) <= reach)
            {
              near.push_back(j);
            }
          });
        this->Found[i] = meter.areaOf(i, near);
      }
    });
}

} // namespace

std::vector<double> particleAreas(const Distribution& distribution, const ConstrainedEdges& edges,
  const Monitor& monitor, const ParallelFor& parallelFor)
{
  Interruptible work(monitor, parallelFor);
  const ParallelFor parallel(std::ref(work));
  return Areas(distribution, edges, parallel).find();
}

} // namespace hop
