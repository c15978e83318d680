#include "Mesh/TangentView.h"

#include "Kernel/InstructionSet.h"

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
/// \pre a is before b, counterclockwise
bool crosses(const glm::dvec2& place, const glm::dvec2& a, const glm::dvec2& b)
{
  return crossOf(a, place) > 0.0 && crossOf(place, b) > 0.0 && crossOf(b - a, place - a) < 0.0;
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

/// Whether two particles, none of which has another one in its place, are on the two sides of a crease: a little beside each
/// other or over each other, as where the field jumps by less than makes the surface end.
bool areOnTwoSidesOfCrease(const Particle& a, const Particle& b)
{
  // In units of the spacing. Larger: the two sides of a strip do not see each other; smaller: creases bend by more.
  constexpr double onLine = 0.05;
  const glm::dvec3 apart = (b.position - a.position).xyz;
  const auto isOnLine = [&](const Particle& particle, const ClipPlane& plane)
  {
    return plane.exists() && !plane.isBoundary() && plane.distance <= onLine * particle.spacing &&
      std::abs(glm::dot(apart, plane.normal.xyz)) <= onLine * particle.spacing;
  };
  for (const ClipPlane& one : a.clips)
  {
    for (const ClipPlane& other : b.clips)
    {
      if (isOnLine(a, one) && isOnLine(b, other) && dot(one.normal, other.normal) < -0.5)
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

ParticlePlaces::ParticlePlaces(const Distribution& distribution, const ParallelFor& parallelFor)
  : particles(distribution.particles)
  , pieces(distribution.pieces)
  , points(
      particles.size(), [this](std::size_t i) { return this->particles[i].position.xyz; },
      [this](std::size_t i) { return this->particles[i].spacing; }, parallelFor)
  , normals(particles.size())
  , hasJumps(distribution.report.hasJumps())
  , isShared(particles.size(), 0)
{
  forAll(parallelFor, this->normals.size(),
    [&](std::size_t i) { this->normals[i] = this->particles[i].normal.xyz; });
  for (const int replaced : distribution.edges.replaced)
  {
    this->normals[replaced] = glm::vec3(0.0f);
  }
  for (const auto& [a, b] : distribution.edges.coincident)
  {
    this->isShared[a] = this->isShared[b] = 1;
  }
}

ParticleNeighbors::ParticleNeighbors(
  const Distribution& distribution, const ParallelFor& parallelFor)
  : ParticlePlaces(distribution, parallelFor)
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
  return cosine > SameSheet::Cosine && this->Particles.areOnOnePiece(this->Middle, particle) &&
    std::abs(glm::dot(apart, glm::dvec3(normal + this->Normal))) * this->Plane.perSpacing <=
    2.0 * SameSheet::Thickness &&
    (cosine > SameSheet::Alike || this->turnsAsExpected(particle));
}

/// Whether a neighbour and the middle are on the two sides of a slit or of a crease, whose sheets may reach over each other.
/// At the tip an edge joins them.
bool TangentView::isAcrossSlit(const FlatNeighbor& neighbor) const
{
  const Particle& here = this->Particles.particles[this->Middle];
  const Particle& there = this->Particles.particles[neighbor.index];
  const bool areAtJump = here.jump != 0.0 && there.jump != 0.0;
  const auto isAlone = [this](int particle)
  { return this->Particles.hasJumps && !this->Particles.isShared[particle]; };
  return here.location.element != there.location.element && this->Edges.isOnEdge(this->Middle) &&
    this->Edges.isOnEdge(neighbor.index) && !this->Edges.joins(this->Middle, neighbor.index) &&
    (areAtJump
        ? endOppositely(here, there)
        : isAlone(this->Middle) && isAlone(neighbor.index) && areOnTwoSidesOfCrease(here, there));
}

/// Collects the constrained edges that end at a neighbour and have the middle to their left. Others bound the other side
/// of a jump, which reaches over this one.
/// \return whether the middle is on the side of the neighbour's edges on which its surface is: clockwise from the
///   direction to the middle there is first an edge that begins at the neighbour
bool TangentView::collectEdgesOf(const FlatNeighbor& neighbor)
{
  const auto isLeftOf = [](const FlatEdge& edge)
  { return crossOf(edge.from.place, edge.to.place) > 0.0; };
  const auto turnTo = [&](const FlatNeighbor& end)
  { return turnRank(end.place - neighbor.place, -neighbor.place); };
  const Span<int> after = this->Edges.after(neighbor.index);
  const Span<int> before = this->Edges.before(neighbor.index);
  double afterTurn = FullRank;
  double beforeTurn = FullRank;
  bool isSeen = after.empty() || before.empty();
  this->EdgesCollected.push_back(neighbor.index);
  for (const int next : after)
  {
    const FlatEdge edge{ neighbor, this->flat(next) };
    isSeen = isSeen || next == this->Middle;
    afterTurn = isSeen ? afterTurn : std::min(afterTurn, turnTo(edge.to));
    if (isLeftOf(edge))
    {
      this->FlatEdges.push_back(edge);
    }
  }
  for (const int previous : before)
  {
    const FlatEdge edge{ this->flat(previous), neighbor };
    isSeen = isSeen || previous == this->Middle;
    beforeTurn = isSeen ? beforeTurn : std::min(beforeTurn, turnTo(edge.from));
    if (isLeftOf(edge))
    {
      this->IncomingEdges.push_back(edge);
    }
  }
  return isSeen || afterTurn <= beforeTurn;
}

/// Drops the neighbours that constrained edges hide.
void TangentView::lookAtEdges()
{
  this->FlatEdges.clear();
  this->IncomingEdges.clear();
  std::vector<int>& collected = this->EdgesCollected;
  collected.clear();
  std::vector<FlatNeighbor>& neighbors = this->Neighbors;
  const auto isTurnedAway = [this](const FlatNeighbor& neighbor)
  {
    return this->Edges.isOnEdge(neighbor.index) &&
      (this->isAcrossSlit(neighbor) || !this->collectEdgesOf(neighbor));
  };
  neighbors.erase(
    std::remove_if(neighbors.begin(), neighbors.end(), isTurnedAway), neighbors.end());
  for (const FlatEdge& edge : this->IncomingEdges)
  {
    // Edges that begin at a neighbour are there already.
    if (std::find(collected.begin(), collected.end(), edge.from.index) == collected.end())
    {
      this->FlatEdges.push_back(edge);
    }
  }
  this->findCrossed();
  std::size_t kept = 0;
  for (std::size_t n = 0; n < neighbors.size(); ++n)
  {
    if (this->Crossed[n] <= 0.0 || !this->isHidden(neighbors[n]))
    {
      neighbors[kept++] = neighbors[n];
    }
  }
  neighbors.resize(kept);
}

/// Marks the places behind edges as crosses() tells, that is with the ends of edges where these are rounded.
void TangentView::findCrossed()
{
  const std::size_t used = this->Neighbors.size();
  const std::size_t count =
    kernel::MaximumLanes * ((used + kernel::MaximumLanes - 1) / kernel::MaximumLanes);
  this->X.resize(count);
  this->Y.resize(count);
  this->Crossed.resize(count);
  for (std::size_t n = 0; n < used; ++n)
  {
    this->X[n] = this->Neighbors[n].place.x;
    this->Y[n] = this->Neighbors[n].place.y;
  }
  this->Segments.clear();
  for (const auto& [from, to] : this->FlatEdges)
  {
    this->Segments.push_back({ from.place.x, from.place.y, to.place.x, to.place.y });
  }
  kernel::current().hidden({ this->X.data(), this->Y.data(), static_cast<std::ptrdiff_t>(used),
                             static_cast<std::ptrdiff_t>(count) },
    this->Segments.data(), static_cast<std::ptrdiff_t>(this->Segments.size()),
    this->Crossed.data());
}

bool TangentView::isHidden(const FlatNeighbor& neighbor) const
{
  return std::any_of(this->FlatEdges.begin(), this->FlatEdges.end(),
    [&](const FlatEdge& edge)
    {
      return crosses(neighbor.place, edge.from.place, edge.to.place) &&
        edge.from.index != neighbor.index && edge.to.index != neighbor.index;
    });
}

TangentView::Sector& TangentView::nextSector()
{
  if (this->SectorCount == this->Sectors.size())
  {
    this->Sectors.emplace_back();
  }
  Sector& sector = this->Sectors[this->SectorCount++];
  sector.neighbors.clear();
  sector.last = 0;
  return sector;
}

/// From an edge at the particle to the next one counterclockwise.
void TangentView::makeSector(const FlatNeighbor& start)
{
  FlatNeighbor end = start;
  double width = FullRank;
  for (const FlatNeighbor& other : this->Ends)
  {
    const bool isSamePlace = other.place == start.place; // a crease's two sides, where it fades
    const double turn = isSamePlace ? FullRank : turnRank(start.place, other.place);
    if (turn < width)
    {
      width = turn;
      end = other;
    }
  }
  Sector& sector = this->nextSector();
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
}

/// From each edge that begins at the particle to the next edge counterclockwise: one that ends there, unless the edges
/// contradict each other. Where none begins, from the edges that end.
void TangentView::makeSectors()
{
  const Span<int> after = this->Edges.after(this->Middle);
  const Span<int> before = this->Edges.before(this->Middle);
  this->Ends.clear();
  for (const Span<int>& ends : { after, before })
  {
    for (const int end : ends)
    {
      this->Ends.push_back(this->flat(end));
    }
  }
  const std::size_t count = after.empty() ? before.size() : after.size();
  for (std::size_t n = 0; n < count; ++n)
  {
    this->makeSector(this->Ends[n]);
  }
}

void TangentView::lookFrom(int particle, Span<int> near)
{
  this->Middle = particle;
  this->Normal = this->Particles.normals[particle];
  this->Plane = TangentPlane(this->Particles.points.positions[particle], this->Normal,
    this->Particles.points.spacings[particle]);
  this->Neighbors.clear();
  this->SectorCount = 0;
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
    this->lookAtEdges();
  }
  if (this->Edges.isOnEdge(particle))
  {
    this->makeSectors();
  }
}

} // namespace hop
