#include "DistributionMeasures.h"

#include "PointGrid.h"
#include "Support/KeepMarked.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degreesPerRadian = 57.295779513082321;
/// Largest distance of a neighbour on the same sheet from the mean of both tangent planes, in spacings. On a surface of
/// constant curvature it is zero. Larger: the next sheet of a thin body may count; smaller: neighbours at creases are
/// lost.
constexpr double sheetThickness = 0.5;

PointGrid gridOf(const Buffer<Particle>& particles)
{
  std::vector<glm::dvec3> points;
  double sum = 0.0;
  for (const Particle& p : particles)
  {
    points.push_back(p.position.xyz);
    sum += p.spacing;
  }
  const double cellSize = particles.empty() ? 1.0 : 2.0 * sum / static_cast<double>(points.size());
  return PointGrid(std::move(points), cellSize);
}

/// Diagonal of the particles' bounding box: no particle is farther from another.
double diameter(const Buffer<Particle>& particles)
{
  glm::dvec3 lower(infinity), upper(-infinity);
  for (const Particle& p : particles)
  {
    lower = glm::min(lower, p.position.xyz);
    upper = glm::max(upper, p.position.xyz);
  }
  return particles.empty() ? 0.0 : glm::distance(lower, upper);
}

/// A neighbour of a particle, in its tangent plane, in spacings.
struct FlatNeighbor
{
  glm::dvec2 place{ 0.0 };
  int index = -1;
};

/// Neighbours that may share a triangle with the particle, the nearest first.
std::vector<FlatNeighbor> flatNeighbors(
  const Buffer<Particle>& particles, const PointGrid& grid, std::size_t i)
{
  const Particle& p = particles[i];
  const glm::dvec3 n = p.normal.xyz;
  const glm::dvec3 aside = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 e1 = glm::normalize(glm::cross(n, aside));
  const glm::dvec3 e2 = glm::cross(n, e1);
  // The corners of the square that cells begin with are sqrt(2) OpenRadius away.
  const double reach = 2.0 * std::sqrt(2.0) * Star::OpenRadius * p.spacing;
  std::vector<FlatNeighbor> neighbors;
  for (const int j : grid.within(p.position.xyz, reach))
  {
    const Particle& q = particles[j];
    const glm::dvec3 d = q.position.xyz - p.position.xyz;
    const glm::dvec2 flat(glm::dot(d, e1), glm::dot(d, e2));
    const double offset = 0.5 * glm::dot(d, n + q.normal.xyz);
    if (static_cast<std::size_t>(j) != i && glm::dot(n, q.normal.xyz) > 0.0 &&
      std::abs(offset) <= sheetThickness * p.spacing && glm::length(flat) > 0.0)
    {
      neighbors.push_back({ glm::length(d) / p.spacing * glm::normalize(flat), j });
    }
  }
  std::stable_sort(neighbors.begin(), neighbors.end(),
    [](const FlatNeighbor& a, const FlatNeighbor& b)
    { return glm::length(a.place) < glm::length(b.place); });
  return neighbors;
}

/// A corner of a Voronoi cell, and the particle behind the edge that starts there, counterclockwise;
/// -1: none.
struct CellCorner
{
  glm::dvec2 place{ 0.0 };
  int neighbor = -1;
};

/// The part of a convex cell that is nearer to the origin than to a neighbour.
std::vector<CellCorner> clip(const std::vector<CellCorner>& cell, const FlatNeighbor& neighbor)
{
  // Bisectors that pass through a corner cut nothing off, whatever the rounding; square of spacings.
  constexpr double rounding = 1e-9;
  const auto beyond = [&](const CellCorner& corner)
  { return glm::dot(corner.place - 0.5 * neighbor.place, neighbor.place) - rounding; };
  std::vector<CellCorner> rest;
  for (std::size_t c = 0; c < cell.size(); ++c)
  {
    const CellCorner& a = cell[c];
    const CellCorner& b = cell[(c + 1) % cell.size()];
    const double fa = beyond(a), fb = beyond(b);
    if (fa <= 0.0)
    {
      rest.push_back(a);
    }
    if ((fa <= 0.0) != (fb <= 0.0))
    {
      const glm::dvec2 cut = a.place + fa / (fa - fb) * (b.place - a.place);
      rest.push_back({ cut, fa <= 0.0 ? neighbor.index : a.neighbor });
    }
  }
  return rest;
}

/// The particles around one particle, counterclockwise; -1 for a side on which its cell is open.
std::vector<int> voronoiNeighbors(const std::vector<FlatNeighbor>& neighbors)
{
  constexpr double r = Star::OpenRadius;
  std::vector<CellCorner> cell{ { { -r, -r } }, { { r, -r } }, { { r, r } }, { { -r, r } } };
  for (const FlatNeighbor& neighbor : neighbors)
  {
    const bool reaches = std::any_of(cell.begin(), cell.end(),
      [&](const CellCorner& corner)
      { return 2.0 * glm::length(corner.place) > glm::length(neighbor.place); });
    if (!reaches)
    {
      break;
    }
    cell = clip(cell, neighbor);
  }
  std::vector<int> indices;
  for (const CellCorner& corner : cell)
  {
    indices.push_back(corner.neighbor);
  }
  return indices;
}

struct Triangle
{
  double circumradius = 0.0;
  double minAngle = 0.0;
};

Triangle measure(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  std::array<double, 3> sides{ glm::distance(a, b), glm::distance(b, c), glm::distance(c, a) };
  std::sort(sides.begin(), sides.end());
  const double twiceArea = glm::length(glm::cross(b - a, c - a));
  // The smallest angle lies opposite the shortest side, between the other two.
  const double sine = std::min(1.0, twiceArea / (sides[1] * sides[2]));
  return { 0.5 * sides[0] * sides[1] * sides[2] / twiceArea, degreesPerRadian * std::asin(sine) };
}

Star starOf(const Buffer<Particle>& particles, const PointGrid& grid, std::size_t i)
{
  const std::vector<int> ring = voronoiNeighbors(flatNeighbors(particles, grid, i));
  Star star;
  star.valence = static_cast<int>(
    std::count_if(ring.begin(), ring.end(), [](int neighbor) { return neighbor >= 0; }));
  star.closed = star.valence >= 3 && star.valence == static_cast<int>(ring.size());
  if (!star.closed)
  {
    return star;
  }
  star.worstMinAngle = infinity;
  for (std::size_t n = 0; n < ring.size(); ++n)
  {
    const Triangle triangle = measure(particles[i].position.xyz, particles[ring[n]].position.xyz,
      particles[ring[(n + 1) % ring.size()]].position.xyz);
    star.circumradius = std::max(star.circumradius, triangle.circumradius / particles[i].spacing);
    star.meanMinAngle += triangle.minAngle / static_cast<double>(ring.size());
    star.worstMinAngle = std::min(star.worstMinAngle, triangle.minAngle);
  }
  return star;
}

/// Standard deviation over mean, without distances beyond two spacings: particles that stand alone.
double variationOf(const std::vector<double>& nearest)
{
  constexpr double alone = 2.0;
  double count = 0.0, sum = 0.0, squares = 0.0;
  for (const double value : nearest)
  {
    if (value <= alone)
    {
      count += 1.0;
      sum += value;
      squares += value * value;
    }
  }
  const double mean = sum / std::max(1.0, count);
  return mean > 0.0 ? std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean : 0.0;
}

void addStars(const std::vector<Star>& stars, Evenness& evenness)
{
  double angles = 0.0;
  int triangles = 0, closed = 0, sixValent = 0;
  evenness.worstMinAngle = infinity;
  for (const Star& star : stars)
  {
    if (!star.closed)
    {
      ++evenness.openStars;
      continue;
    }
    ++closed;
    sixValent += star.valence == 6;
    triangles += star.valence;
    angles += star.valence * star.meanMinAngle;
    evenness.circumradius = std::max(evenness.circumradius, star.circumradius);
    evenness.worstMinAngle = std::min(evenness.worstMinAngle, star.worstMinAngle);
  }
  evenness.sixValentShare = static_cast<double>(sixValent) / std::max(1, closed);
  evenness.meanMinAngle = angles / std::max(1, triangles);
  evenness.worstMinAngle = closed > 0 ? evenness.worstMinAngle : 0.0;
}

} // namespace

std::vector<double> nearestSpacings(const Buffer<Particle>& particles)
{
  const PointGrid grid = gridOf(particles);
  const double farthest = diameter(particles);
  std::vector<double> nearest;
  for (const Particle& p : particles)
  {
    double distance = infinity;
    double radius = 0.75 * p.spacing;
    do
    {
      radius *= 2.0;
      for (const int j : grid.within(p.position.xyz, radius))
      {
        const Particle& q = particles[j];
        if (&p != &q && dot(p.normal, q.normal) > 0.0)
        {
          distance = std::min(distance, length(p.position - q.position));
        }
      }
    } while (distance > radius && radius < farthest);
    nearest.push_back(distance / p.spacing);
  }
  return nearest;
}

double hexagonalCount(double area, double spacing)
{
  return area / (0.5 * std::sqrt(3.0) * spacing * spacing);
}

std::vector<Star> delaunayStars(const Buffer<Particle>& particles)
{
  const PointGrid grid = gridOf(particles);
  std::vector<Star> stars;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    stars.push_back(starOf(particles, grid, i));
  }
  return stars;
}

Evenness measureEvenness(
  const Buffer<Particle>& particles, const std::function<bool(const Particle&)>& counts)
{
  std::vector<double> nearest = nearestSpacings(particles);
  std::vector<Star> stars = delaunayStars(particles);
  std::vector<char> kept(particles.size());
  std::transform(particles.begin(), particles.end(), kept.begin(), counts);
  keepMarked(nearest, kept);
  keepMarked(stars, kept);
  if (particles.size() < 2 || nearest.empty())
  {
    return {};
  }
  Evenness evenness;
  evenness.minSpacing = *std::min_element(nearest.begin(), nearest.end());
  evenness.variation = variationOf(nearest);
  addStars(stars, evenness);
  return evenness;
}

double coverageRadius(const Buffer<Particle>& particles, const std::vector<glm::dvec3>& probes)
{
  if (particles.empty())
  {
    return probes.empty() ? 0.0 : infinity;
  }
  const PointGrid grid = gridOf(particles);
  const double largest = std::max_element(particles.begin(), particles.end(),
    [](const Particle& a, const Particle& b) {
      return a.spacing < b.spacing;
    })->spacing;
  double coverage = 0.0;
  for (const glm::dvec3& probe : probes)
  {
    std::vector<int> around;
    for (double radius = largest; around.empty(); radius *= 2.0)
    {
      around = grid.within(probe, radius);
    }
    double nearest = infinity;
    for (const int i : around)
    {
      nearest =
        std::min(nearest, glm::distance(particles[i].position.xyz, probe) / particles[i].spacing);
    }
    coverage = std::max(coverage, nearest);
  }
  return coverage;
}

} // namespace hop::testing
