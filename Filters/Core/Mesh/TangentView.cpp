#include "Mesh/TangentView.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{
namespace
{

/// What belongs to the same sheet of the surface as a particle. Chosen by experiment.
struct SameSheet
{
  /// Least cosine between the normals, 72 degrees. Smaller: neighbours around sharp tips are taken that the tangent
  /// plane does not show in their order; larger: strongly bent places are left open.
  static constexpr float Cosine = 0.3f;
  /// Largest distance of a neighbour from the mean of both tangent planes, in units of the spacing: zero on a surface of
  /// constant curvature. Larger: the next sheet but one of a thin body counts; smaller: neighbours are lost where the
  /// surface bends unevenly.
  static constexpr double Thickness = 0.5;
  /// Cosine between normals, 26 degrees, above which curvature need not explain the angle: changes the time.
  static constexpr float Alike = 0.9f;
  /// Largest difference between the normals' difference and the one that follows from curvature. Larger: sheets that cross
  /// at a jump of the field count as one; smaller: neighbours are lost where curvature varies within a spacing.
  static constexpr double Unexplained = 0.4;
};

/// Whether the line from the origin to a place crosses the segment from a to b between their ends.
bool crosses(const glm::dvec2& place, const glm::dvec2& a, const glm::dvec2& b)
{
  const glm::dvec2 along = b - a;
  return crossOf(place, a) * crossOf(place, b) < 0.0 &&
    crossOf(along, -a) * crossOf(along, place - a) < 0.0;
}

/// The largest angle by which the surface turns at creases between a particle and a place, radians.
/// \param apart from the particle to the place
double creaseBefore(const Particle& particle, const glm::dvec3& apart)
{
  double angle = 0.0;
  for (const ClipPlane& plane : particle.clips)
  {
    if (plane.exists() && !plane.isBoundary() &&
      glm::dot(plane.normal.xyz, apart) >= plane.distance)
    {
      angle = std::max<double>(angle, plane.dihedralAngle);
    }
  }
  return angle;
}

/// Whether the surface ends at two particles at planes that are opposite to each other.
bool endOppositely(const Particle& a, const Particle& b)
{
  const auto endsAt = [](const Particle& particle, const ClipPlane& plane)
  {
    constexpr double rounding = 0.01; // of the planes' distances, in units of the spacing
    return plane.exists() && plane.isBoundary() && plane.distance <= rounding * particle.spacing;
  };
  for (const ClipPlane& one : a.clips)
  {
    for (const ClipPlane& other : b.clips)
    {
      if (endsAt(a, one) && endsAt(b, other) && dot(one.normal, other.normal) < -0.5)
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

ParticlePlaces::ParticlePlaces(const Buffer<Particle>& all, const ParallelFor& parallelFor)
  : particles(all)
  , points(
      all.size(), [&](std::size_t i) { return all[i].position.xyz; },
      [&](std::size_t i) { return all[i].spacing; }, parallelFor)
  , normals(all.size())
{
  forAll(parallelFor, all.size(), [&](std::size_t i) { this->normals[i] = all[i].normal.xyz; });
}

ParticleNeighbors::ParticleNeighbors(const Buffer<Particle>& all, const ParallelFor& parallelFor)
  : ParticlePlaces(all, parallelFor)
  , seen(points.positions, points.spacings, Reach, parallelFor)
{
}

/// Whether the normals of a neighbour and of the middle differ as curvature says: by the mean of both shape operators,
/// times the way between them, to third order in its length. Creases between them add their angle.
bool TangentView::turnsAsExpected(int particle) const
{
  const Particle& here = this->Particles.particles[this->Middle];
  const Particle& there = this->Particles.particles[particle];
  const glm::dvec3 apart = (there.position - here.position).xyz;
  const glm::dvec3 expected = 0.5 * ((here.curvature.shape + there.curvature.shape) * apart);
  const double tolerance =
    SameSheet::Unexplained + std::max(creaseBefore(here, apart), creaseBefore(there, -apart));
  return glm::distance((there.normal - here.normal).xyz, expected) <= tolerance;
}

bool TangentView::isOnSheet(int particle) const
{
  const glm::vec3& normal = this->Particles.normals[particle];
  const glm::dvec3 apart = this->Particles.points.positions[particle] - this->Plane.origin;
  const float cosine = glm::dot(normal, this->Normal);
  return cosine > SameSheet::Cosine &&
    std::abs(glm::dot(apart, glm::dvec3(normal + this->Normal))) * this->Plane.perSpacing <=
    2.0 * SameSheet::Thickness &&
    (cosine > SameSheet::Alike || this->turnsAsExpected(particle));
}

/// The constrained edges that end at a neighbour and have the middle to their left. Others bound the other side of a
/// jump, which reaches over this one.
void TangentView::collectEdges()
{
  this->FlatEdges.clear();
  const auto add = [this](int from, int to)
  {
    const FlatEdge edge{ this->flat(from), this->flat(to) };
    if (from != this->Middle && to != this->Middle && crossOf(edge.from.place, edge.to.place) > 0.0)
    {
      this->FlatEdges.push_back(edge);
    }
  };
  std::vector<int>& collected = this->EdgesCollected;
  collected.clear();
  for (const FlatNeighbor& neighbor : this->Neighbors)
  {
    if (!this->Edges.isOnEdge(neighbor.index) || this->isAcrossSlit(neighbor))
    {
      continue;
    }
    collected.push_back(neighbor.index);
    for (const int next : this->Edges.after(neighbor.index))
    {
      add(neighbor.index, next);
    }
  }
  for (const int end : collected)
  {
    for (const int previous : this->Edges.before(end))
    {
      // Edges that begin at a neighbour are there already.
      if (std::find(collected.begin(), collected.end(), previous) == collected.end())
      {
        add(previous, end);
      }
    }
  }
}

/// Whether a neighbour on constrained edges has the middle on the side of them on which its surface is: clockwise from
/// the direction to the middle there is first an edge that begins at the neighbour.
bool TangentView::isSeenFromTheLeft(const FlatNeighbor& neighbor) const
{
  const Span<int> after = this->Edges.after(neighbor.index);
  const Span<int> before = this->Edges.before(neighbor.index);
  if (after.empty() || before.empty())
  {
    return true;
  }
  const auto leastTurn = [&](const Span<int>& ends)
  {
    double least = FullRank;
    for (const int end : ends)
    {
      const glm::dvec2 place = end == this->Middle ? glm::dvec2(0.0) : this->flat(end).place;
      least = std::min(least, turnRank(place - neighbor.place, -neighbor.place));
    }
    return least;
  };
  return this->Edges.joins(this->Middle, neighbor.index) || leastTurn(after) <= leastTurn(before);
}

/// Whether a neighbour and the middle are on the two sides of a slit, whose sheets may reach over each other. At the
/// slit's tip an edge joins them.
bool TangentView::isAcrossSlit(const FlatNeighbor& neighbor) const
{
  const Particle& here = this->Particles.particles[this->Middle];
  const Particle& there = this->Particles.particles[neighbor.index];
  return here.location.element != there.location.element && here.jump != 0.0 && there.jump != 0.0 &&
    this->Edges.isOnEdge(this->Middle) && this->Edges.isOnEdge(neighbor.index) &&
    !this->Edges.joins(this->Middle, neighbor.index) && endOppositely(here, there);
}

bool TangentView::isHidden(const FlatNeighbor& neighbor) const
{
  return !this->isSeenFromTheLeft(neighbor) || this->isAcrossSlit(neighbor) ||
    std::any_of(this->FlatEdges.begin(), this->FlatEdges.end(),
      [&](const FlatEdge& edge)
      {
        return edge.from.index != neighbor.index && edge.to.index != neighbor.index &&
          crosses(neighbor.place, edge.from.place, edge.to.place);
      });
}

/// From each edge that begins at the particle to the next edge counterclockwise: one that ends there, unless the edges
/// contradict each other. Where none begins, from the edges that end.
void TangentView::makeSectors()
{
  const Span<int> after = this->Edges.after(this->Middle);
  const Span<int> before = this->Edges.before(this->Middle);
  std::vector<int> all(after.begin(), after.end());
  all.insert(all.end(), before.begin(), before.end());
  for (const int first : after.empty() ? before : after)
  {
    const FlatNeighbor start = this->flat(first);
    FlatNeighbor end = start;
    double width = FullRank;
    for (const int last : all)
    {
      const FlatNeighbor other = this->flat(last);
      const bool isSamePlace = other.place == start.place; // a crease's two sides, where it fades
      const double turn = isSamePlace ? FullRank : turnRank(start.place, other.place);
      if (turn < width)
      {
        width = turn;
        end = other;
      }
    }
    Sector sector;
    sector.neighbors.push_back(start);
    if (end.index != start.index)
    {
      sector.neighbors.push_back(end);
      sector.last = 1;
    }
    for (const FlatNeighbor& neighbor : this->Neighbors)
    {
      if (neighbor.index != start.index && neighbor.index != end.index &&
        turnRank(start.place, neighbor.place) < width)
      {
        sector.neighbors.push_back(neighbor);
      }
    }
    this->Sectors.push_back(std::move(sector));
  }
}

void TangentView::lookFrom(int particle, Span<int> near)
{
  this->Middle = particle;
  this->Normal = this->Particles.normals[particle];
  this->Plane = TangentPlane(this->Particles.points.positions[particle], this->Normal,
    this->Particles.points.spacings[particle]);
  this->Neighbors.clear();
  this->Sectors.clear();
  this->IsNearEdge = this->Edges.isOnEdge(particle);
  for (const int j : near)
  {
    if (this->isOnSheet(j))
    {
      const FlatNeighbor neighbor = this->flat(j);
      if (neighbor.place != glm::dvec2(0.0))
      {
        this->Neighbors.push_back(neighbor);
        this->IsNearEdge = this->IsNearEdge || this->Edges.isOnEdge(j);
      }
    }
  }
  if (this->IsNearEdge)
  {
    this->collectEdges();
    this->Neighbors.erase(std::remove_if(this->Neighbors.begin(), this->Neighbors.end(),
                            [this](const FlatNeighbor& n) { return this->isHidden(n); }),
      this->Neighbors.end());
  }
  if (this->Edges.isOnEdge(particle))
  {
    this->makeSectors();
  }
}

} // namespace hop
