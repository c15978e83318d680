#include "Mesh/SurfaceMesh.h"

#include "Mesh/TangentView.h"
#include "Support/Interruptible.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hop
{
namespace
{

/// The part of a particle's tangent plane that is nearer to it than to others: a convex polygon, in units of the
/// spacing. To be reused: its memory only grows.
class Cell
{
public:
  /// A square that holds the cell of a particle whose neighbours surround it.
  void start()
  {
    constexpr double r = ParticleNeighbors::LargestRadius;
    this->Corners = { { -r, -r }, { r, -r }, { r, r }, { -r, r } };
  }

  /// Keeps what lies below a line: normal . t <= offset.
  void cut(const glm::dvec2& normal, double offset)
  {
    this->Rest.clear();
    for (std::size_t c = 0; c < this->Corners.size(); ++c)
    {
      const glm::dvec2& a = this->Corners[c];
      const glm::dvec2& b = this->Corners[c + 1 < this->Corners.size() ? c + 1 : 0];
      const double fa = glm::dot(normal, a) - offset;
      const double fb = glm::dot(normal, b) - offset;
      if (fa <= 0.0)
      {
        this->Rest.push_back(a);
      }
      if ((fa < 0.0 && fb > 0.0) || (fa > 0.0 && fb < 0.0))
      {
        this->Rest.push_back(a + fa / (fa - fb) * (b - a));
      }
    }
    this->Corners.swap(this->Rest);
  }

  /// Largest square of the distance of a corner.
  double reachSquared() const
  {
    double most = 0.0;
    for (const glm::dvec2& corner : this->Corners)
    {
      most = std::max(most, glm::dot(corner, corner));
    }
    return most;
  }

  /// The integral of 1 + stretch(t), where stretch is about a quadratic form: in each triangle with the origin it is
  /// integrated by its values in the middles of the edges.
  template <class Stretch>
  double integral(const Stretch& stretch) const
  {
    double sum = 0.0;
    for (std::size_t c = 0; c < this->Corners.size(); ++c)
    {
      const glm::dvec2& a = this->Corners[c];
      const glm::dvec2& b = this->Corners[c + 1 < this->Corners.size() ? c + 1 : 0];
      const double mean = (stretch(0.5 * a) + stretch(0.5 * b) + stretch(0.5 * (a + b))) / 3.0;
      sum += 0.5 * crossOf(a, b) * (1.0 + mean);
    }
    return sum;
  }

private:
  std::vector<glm::dvec2> Corners, Rest;
};

/// Makes the cells of one particle after the other.
class AreaMeter
{
public:
  AreaMeter(const Buffer<Particle>& particles, const ParticleNeighbors& neighbors,
    const ConstrainedEdges& edges)
    : Particles(particles)
    , View(neighbors, edges)
  {
  }

  /// World units squared.
  double areaOf(int particle)
  {
    this->View.lookFrom(particle);
    this->At = &this->Particles[particle];
    double area = 0.0;
    if (this->View.sectors().empty())
    {
      this->startCell(this->View.neighbors(), 0.0);
      area = this->areaOfCell();
    }
    for (const TangentView::Sector& sector : this->View.sectors())
    {
      area += this->areaOf(sector);
    }
    return area * this->At->spacing * this->At->spacing;
  }

private:
  /// A plane that is nearer to a particle on an edge of the surface than this, in units of its spacing, is that of the
  /// edge.
  static constexpr double AtEdge = 0.05;

  /// The cell, cut off at boundary curves that are not nearer than `nearest`. (Creases have particles of their own where
  /// the surface turns much; where it turns little the cells of both sides meet as on a smooth surface.)
  void startCell(const std::vector<FlatNeighbor>& neighbors, double nearest)
  {
    this->Whole.start();
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
    for (const ClipPlane& plane : this->At->clips)
    {
      const double distance = plane.distance / this->At->spacing;
      if (plane.isBoundary() && distance >= nearest)
      {
        this->Whole.cut(this->View.plane().directionOf(plane.normal.xyz), distance);
      }
    }
  }

  /// How much larger a piece of the surface at t is than its picture in the plane, less 1. Places stand at their distance
  /// d in space; with the arc length r = d (1 + k^2 d^2/24) along a normal section of curvature k, and the area r (1 - K
  /// r^2/6) dr of a geodesic disk, that is (k^2 - K) d^2/6.
  double areaOfCell() const
  {
    const Curvature& curvature = this->At->curvature;
    const glm::dvec3& a = this->View.plane().across;
    const glm::dvec3& b = this->View.plane().along;
    const double xx = glm::dot(a, curvature.shape * a);
    const double xy = glm::dot(a, curvature.shape * b);
    const double yy = glm::dot(b, curvature.shape * b);
    const double unit = this->At->spacing * this->At->spacing / 6.0;
    return this->Whole.integral(
      [&](const glm::dvec2& t)
      {
        const double squared = glm::dot(t, t);
        const double bend = xx * t.x * t.x + 2.0 * xy * t.x * t.y + yy * t.y * t.y;
        return squared > 0.0
          ? std::max(-1.0, unit * (bend * bend / squared - curvature.gauss * squared))
          : 0.0;
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

  double areaOf(const TangentView::Sector& sector)
  {
    const glm::dvec2 first = sector.neighbors[sector.first].place;
    const glm::dvec2 last = sector.neighbors[sector.last].place;
    // Convex parts: less than half a turn each.
    constexpr int parts = 3;
    const double begin = std::atan2(first.y, first.x);
    constexpr double fullTurn = 6.283185307179586;
    const double width = sector.first == sector.last ? fullTurn : turnFrom(first, last);
    double area = 0.0;
    for (int part = 0; part < parts; ++part)
    {
      const double from = begin + width * part / parts;
      const double to = begin + width * (part + 1) / parts;
      this->startCell(sector.neighbors, AtEdge);
      this->Whole.cut({ std::sin(from), -std::cos(from) }, 0.0);
      this->Whole.cut({ -std::sin(to), std::cos(to) }, 0.0);
      area += this->areaOfCell();
    }
    return area + this->areaBeyond(first, 1.0) + this->areaBeyond(last, -1.0);
  }

  const Buffer<Particle>& Particles;
  TangentView View;
  const Particle* At = nullptr;
  Cell Whole;
};

} // namespace

std::vector<double> particleAreas(
  const Distribution& distribution, const Monitor& monitor, const ParallelFor& parallelFor)
{
  Interruptible work(monitor, parallelFor);
  const ParallelFor parallel(std::ref(work));
  const Buffer<Particle>& particles = distribution.particles;
  const ConstrainedEdges edges(distribution);
  const ParticleNeighbors neighbors(particles, parallel);
  std::vector<double> areas(particles.size());
  runParallel(parallel, static_cast<std::ptrdiff_t>(areas.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      AreaMeter meter(particles, neighbors, edges);
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        areas[i] = meter.areaOf(static_cast<int>(i));
      }
    });
  return areas;
}

} // namespace hop
