#include "Mesh/HoleFilling.h"

#include "Mesh/PolygonTriangulation.h"
#include "Mesh/SurfaceBelow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace hop
{
namespace
{

/// Chosen by experiment, lengths in units of the spacing.
struct Hole
{
  /// Largest number of edges: the time grows with its cube. Holes on surfaces that particles can follow have up to some
  /// twenty.
  static constexpr std::size_t MostEdges = 96;
  /// Largest circumradius of a triangle that needs no further particle, see ParticleNeighbors::LargestRadius.
  static constexpr double LargestRadius = ParticleNeighbors::LargestRadius;
  /// Least distance of a further particle from others. Larger: triangles stay large; smaller: narrow strips are filled
  /// with particles that stand too close.
  static constexpr double Room = 0.5;
  /// Cosine between normals up to which a border does not belong to the sheet of a particle. Larger: particles in holes
  /// at sharp rims stay alone; smaller: borders on the other side of a thin body count.
  static constexpr double OtherSheet = -0.5;
  /// Cost of an equilateral triangle, 2 sqrt(3), rounded down: no triangle costs less.
  static constexpr double LeastCost = 3.464;
  /// Times that a triangulation is sought without what was wrong with the last one.
  static constexpr int Attempts = 24;
  /// The same, and the largest number of edges, where triangles may be turned away. Larger: the few holes of surfaces that
  /// particles cannot follow, which stay open all the same, cost a third of the mesh (PyFR's flow, mesh_table).
  static constexpr int AttemptsTurned = 6;
  static constexpr std::size_t MostEdgesTurned = 24;
  /// What a corner from whose normal a triangle is turned away costs, where it may be. Larger: fewer of these corners,
  /// and worse angles; smaller: more of them.
  static constexpr double CostOfTurnedCorner = 20.0;
  /// Twice the area of a triangle, in units of the sum of squares of its sides, below which none costs more: the cost
  /// stays finite where three particles are on a line.
  static constexpr double LeastArea = 1e-6;
};

/// From which normals a triangle may be turned away.
enum class Turned
{
  /// From none of its corners'.
  Never,
  /// From a corner's, though not from the mean of all three: where the surface bends by more than a right angle within a
  /// spacing no triangle suits all corners.
  FromCorners,
  /// From all of them: where the two sides of a jump reach over each other, the border of a hole crosses itself.
  FromAll
};

/// A triangle in space.
struct Shape
{
  glm::dvec3 middle{ 0.0 };
  /// Its length is twice the area.
  glm::dvec3 normal{ 0.0 };
  double sumOfSquares = 0.0;
  double productOfSides = 0.0;

  double circumradius() const { return this->productOfSides / (2.0 * glm::length(this->normal)); }
};

using Pair = std::pair<int, int>;

Pair pairOf(int a, int b)
{
  return std::minmax(a, b);
}

class HoleFiller
{
public:
  HoleFiller(const Isosurface& surface, const ParticleNeighbors& neighbors,
    const ConstrainedEdges& edges, Distribution& distribution, TriangleFans& fans,
    const ParallelFor& parallelFor)
    : Neighbors(neighbors)
    , Edges(edges)
    , Particles(distribution.particles)
    , Fans(fans)
    , Parallel(parallelFor)
    , Surface(surface)
  {
  }

  void fillAll()
  {
    this->Loops = findOpenLoops(this->Particles, this->Edges, this->Fans, this->Parallel);
    cutAtPinches(this->Particles, this->Loops);
    this->sortLoops();
    this->findLoose();
    if (!this->Holes.empty())
    {
      this->Below.emplace(this->Surface, this->Parallel);
    }
    std::vector<std::size_t> open = this->Holes;
    for (const Turned turned : { Turned::Never, Turned::FromCorners, Turned::FromAll })
    {
      this->Allowed = turned;
      std::vector<std::size_t> stillOpen;
      for (const std::size_t hole : open)
      {
        askCaller(this->Parallel);
        const std::size_t before = this->Particles.size();
        if (!this->fill(hole))
        {
          this->dropParticlesBehind(before);
          stillOpen.push_back(hole);
        }
      }
      open = std::move(stillOpen);
    }
  }

private:
  const glm::dvec3& at(int particle) const { return this->Particles[particle].position.xyz; }
  glm::dvec3 normalOf(int particle) const { return this->Particles[particle].normal.xyz; }

  Shape shapeOf(const Triangle& triangle) const
  {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 ab = this->at(b) - this->at(a);
    const glm::dvec3 bc = this->at(c) - this->at(b);
    const glm::dvec3 ca = this->at(a) - this->at(c);
    return { (this->at(a) + this->at(b) + this->at(c)) / 3.0, glm::cross(ab, bc),
      glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca),
      glm::length(ab) * glm::length(bc) * glm::length(ca) };
  }

  double spacingOf(const Triangle& triangle) const
  {
    double sum = 0.0;
    for (const int corner : triangle)
    {
      sum += this->Particles[corner].spacing;
    }
    return sum / 3.0;
  }

  void sortLoops()
  {
    for (std::size_t n = 0; n < this->Loops.size(); ++n)
    {
      const OpenLoop& loop = this->Loops[n];
      if (loop.isClosed && loop.edgeCount() <= Hole::MostEdges)
      {
        const bool isHole = loop.particles.size() >= 3 &&
          (areaInside(this->Particles, loop.particles) > 0.0 || this->isOnBorder(loop));
        (isHole ? this->Holes : this->Islands).push_back(n);
        for (const int particle : isHole ? loop.particles : std::vector<int>())
        {
          this->HolesOf[particle].push_back(n);
        }
      }
    }
  }

  /// Whether all edges of a loop have the surface to their left: it encloses a piece of surface, be that without area.
  bool isOnBorder(const OpenLoop& loop) const
  {
    for (std::size_t n = 0; n < loop.edgeCount(); ++n)
    {
      const int next = loop.particles[(n + 1) % loop.particles.size()];
      if (!this->Edges.has(loop.particles[n], next) || this->Edges.has(next, loop.particles[n]))
      {
        return false;
      }
    }
    return true;
  }

  /// Whether a loop runs around a particle once, counterclockwise, in the particle's tangent plane. It does not run around
  /// what is in the place of its own corners, as the other side of a crease.
  bool surrounds(const std::vector<int>& loop, int particle) const
  {
    const Particle& middle = this->Particles[particle];
    const TangentPlane plane(middle.position.xyz, glm::vec3(middle.normal.xyz), middle.spacing);
    double turn = 0.0;
    glm::dvec2 before = plane.flat(this->at(loop.back()));
    for (const int corner : loop)
    {
      if (this->at(corner) == this->at(particle) ||
        glm::dot(this->normalOf(corner), middle.normal.xyz) <= Hole::OtherSheet)
      {
        return false;
      }
      const glm::dvec2 next = plane.flat(this->at(corner));
      turn += std::atan2(crossOf(before, next), glm::dot(before, next));
      before = next;
    }
    constexpr double halfTurn = 3.14159;
    return turn > halfTurn;
  }

  /// The hole in which a particle lies.
  std::optional<std::size_t> holeAround(int particle) const
  {
    std::optional<std::size_t> found;
    if (static_cast<std::size_t>(particle) >= this->Neighbors.seen.size())
    {
      return found; // it was added to fill a hole
    }
    for (const int* j = this->Neighbors.seen.begin(particle);
         j != this->Neighbors.seen.end(particle); ++j)
    {
      const auto holes = this->HolesOf.find(*j);
      for (const std::size_t hole :
        holes == this->HolesOf.end() ? std::vector<std::size_t>() : holes->second)
      {
        if ((!found || hole < *found) && this->surrounds(this->Loops[hole].particles, particle))
        {
          found = hole;
        }
      }
    }
    return found;
  }

  /// Finds what lies inside of holes: pieces of the mesh, and particles without triangles.
  void findLoose()
  {
    if (this->Holes.empty())
    {
      return;
    }
    for (const std::size_t island : this->Islands)
    {
      const std::vector<int>& loop = this->Loops[island].particles;
      if (const auto hole = this->holeAround(loop.front()))
      {
        this->Loose[*hole].push_back(loop);
      }
    }
    for (std::size_t i = 0; i < this->Particles.size(); ++i)
    {
      const int particle = static_cast<int>(i);
      if (!this->Fans.hasTriangles(particle) && !this->Edges.isOnEdge(particle))
      {
        if (const auto hole = this->holeAround(particle))
        {
          this->Loose[*hole].push_back({ particle });
        }
      }
    }
  }

  bool mayJoin(int a, int b) const
  {
    return a != b && this->Fans.apexOf(a, b) < 0 && this->Fans.apexOf(b, a) < 0 &&
      !this->Edges.joins(a, b);
  }

  /// Whether the side of a loop that is to be filled lies, at one of its corners, towards a place.
  bool opensTowards(const std::vector<int>& loop, std::size_t corner, const glm::dvec3& place) const
  {
    const std::size_t count = loop.size();
    const int before = loop[(corner + count - 1) % count];
    const int after = loop[(corner + 1) % count];
    if (before == after)
    {
      return true;
    }
    const Particle& middle = this->Particles[loop[corner]];
    const TangentPlane plane(middle.position.xyz, glm::vec3(middle.normal.xyz), middle.spacing);
    const glm::dvec2 first = plane.flat(this->at(after));
    return turnFrom(first, plane.flat(place)) < turnAround(first, plane.flat(this->at(before)));
  }

  /// The shortest edge from a hole's border to a loop inside of the hole.
  struct Bridge
  {
    double length = std::numeric_limits<double>::infinity();
    std::size_t here = 0, there = 0;
  };

  Bridge shortestBridge(const std::vector<int>& border, const std::vector<int>& loop) const
  {
    Bridge bridge;
    for (std::size_t i = 0; i < border.size(); ++i)
    {
      for (std::size_t j = 0; j < loop.size(); ++j)
      {
        const glm::dvec3& a = this->at(border[i]);
        const glm::dvec3& b = this->at(loop[j]);
        const double distance = glm::distance(a, b);
        if (distance < bridge.length && this->mayJoin(border[i], loop[j]) &&
          this->opensTowards(border, i, b) && this->opensTowards(loop, j, a))
        {
          bridge = { distance, i, j };
        }
      }
    }
    return bridge;
  }

  /// Lets the border run along a bridge, around a loop, and back.
  static void cross(const Bridge& bridge, const std::vector<int>& loop, std::vector<int>& border)
  {
    const auto start = loop.begin() + static_cast<std::ptrdiff_t>(bridge.there);
    std::vector<int> detour(start, loop.end());
    detour.insert(detour.end(), loop.begin(), start);
    if (loop.size() > 1)
    {
      detour.push_back(*start);
    }
    detour.push_back(border[bridge.here]);
    border.insert(
      border.begin() + static_cast<std::ptrdiff_t>(bridge.here) + 1, detour.begin(), detour.end());
  }

  /// Joins loops inside of a hole to the hole's border, always the nearest one: the edges of a minimum spanning tree do
  /// not cross, and are edges of the Delaunay triangulation.
  void join(std::vector<int>& border, std::vector<std::vector<int>> loops) const
  {
    while (!loops.empty())
    {
      Bridge best;
      std::size_t nearest = 0;
      for (std::size_t n = 0; n < loops.size(); ++n)
      {
        const Bridge bridge = this->shortestBridge(border, loops[n]);
        if (bridge.length < best.length)
        {
          best = bridge;
          nearest = n;
        }
      }
      if (!std::isfinite(best.length))
      {
        return;
      }
      cross(best, loops[nearest], border);
      loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(nearest));
    }
  }

  /// The cost of a triangle: the harmonic index, least for an equilateral one. Among all triangulations of points in a
  /// plane the Delaunay triangulation has the least sum of it (Musin 1997).
  double costOf(const Triangle& triangle) const
  {
    const auto& [a, b, c] = triangle;
    constexpr double forbidden = std::numeric_limits<double>::infinity();
    if (a == b || b == c || c == a ||
      (!this->Rejected.empty() && this->Rejected.count(sorted(triangle)) > 0))
    {
      return forbidden;
    }
    const Shape shape = this->shapeOf(triangle);
    double sum = 0.0;
    double turned = 0.0;
    for (const int corner : triangle)
    {
      const double facing = glm::dot(shape.normal, this->normalOf(corner));
      sum += facing;
      turned += facing <= 0.0 ? 1.0 : 0.0;
    }
    if ((turned > 0.0 && this->Allowed == Turned::Never) ||
      (!(sum > 0.0) && this->Allowed != Turned::FromAll) || shape.productOfSides == 0.0)
    {
      return forbidden;
    }
    const double size = std::max(glm::length(shape.normal), Hole::LeastArea * shape.sumOfSquares);
    return shape.sumOfSquares / size + Hole::CostOfTurnedCorner * turned;
  }

  static Triangle sorted(Triangle triangle)
  {
    std::sort(triangle.begin(), triangle.end());
    return triangle;
  }

  bool isOnSurface(const Triangle& triangle)
  {
    const Shape shape = this->shapeOf(triangle);
    const auto there = this->Below->placeBelow(
      shape.middle, this->Particles[triangle[0]], this->spacingOf(triangle));
    return there &&
      (this->Allowed == Turned::FromAll ||
        glm::dot(surfaceNormal(there->point.gradient).xyz, shape.normal) > 0.0);
  }

  /// Adds the triangles if none of them is wrong; else remembers what is.
  bool accept(const std::vector<Triangle>& triangles)
  {
    std::set<Pair> passed;
    bool isGood = true;
    for (const Triangle& triangle : triangles)
    {
      bool isNew = true;
      for (int n = 0; n < 3; ++n)
      {
        const int a = triangle[n];
        const int b = triangle[(n + 1) % 3];
        isNew = isNew && this->Fans.apexOf(a, b) < 0 && passed.insert({ a, b }).second;
      }
      if (!isNew || !this->isOnSurface(triangle))
      {
        this->Rejected.insert(sorted(triangle));
        isGood = false;
      }
    }
    if (isGood)
    {
      for (const Triangle& triangle : triangles)
      {
        this->Fans.add(triangle);
      }
    }
    return isGood;
  }

  std::vector<Triangle> triangulate(const std::vector<int>& border)
  {
    std::set<Pair> borderEdges;
    for (std::size_t n = 0; n < border.size(); ++n)
    {
      borderEdges.insert(pairOf(border[n], border[n + 1 < border.size() ? n + 1 : 0]));
    }
    return triangulatePolygon(
      border, [this](const Triangle& triangle) { return this->costOf(triangle); }, Hole::LeastCost,
      [&](int a, int b) { return this->mayJoin(a, b) && borderEdges.count(pairOf(a, b)) == 0; });
  }

  /// Whether a particle in the middle of a triangle would not stand too near to a corner, as in the narrow ones beside
  /// creases.
  bool hasRoom(const Triangle& triangle) const
  {
    const glm::dvec3 middle = this->shapeOf(triangle).middle;
    const double least = Hole::Room * this->spacingOf(triangle);
    return std::all_of(triangle.begin(), triangle.end(),
      [&](int corner) { return glm::distance(this->at(corner), middle) > least; });
  }

  /// Adds a particle in the middle of the largest triangle, if that is too large.
  std::optional<int> addParticle(const std::vector<Triangle>& triangles)
  {
    double most = Hole::LargestRadius;
    const Triangle* largest = nullptr;
    for (const Triangle& triangle : triangles)
    {
      const double radius = this->shapeOf(triangle).circumradius() / this->spacingOf(triangle);
      if (radius > most && this->hasRoom(triangle))
      {
        most = radius;
        largest = &triangle;
      }
    }
    if (!largest)
    {
      return std::nullopt;
    }
    const auto particle = this->Below->particleBelow(
      this->shapeOf(*largest).middle, this->Particles[(*largest)[0]], this->spacingOf(*largest));
    if (!particle)
    {
      return std::nullopt;
    }
    this->Particles.push_back(Particle(*particle));
    this->Fans.appendVertex();
    return static_cast<int>(this->Particles.size()) - 1;
  }

  /// \return whether it was filled
  bool fill(std::size_t hole)
  {
    std::vector<int> border = this->Loops[hole].particles;
    this->join(border, this->Loose[hole]);
    this->Rejected.clear();
    const bool isLast = this->Allowed != Turned::Never;
    if (isLast && this->Loops[hole].edgeCount() > Hole::MostEdgesTurned)
    {
      return false;
    }
    const int attempts = isLast ? Hole::AttemptsTurned : Hole::Attempts;
    for (int attempt = 0; attempt < attempts; ++attempt)
    {
      const std::vector<Triangle> triangles = this->triangulate(border);
      if (triangles.empty())
      {
        return false;
      }
      if (const auto added = this->addParticle(triangles))
      {
        this->join(border, { { *added } });
      }
      else if (this->accept(triangles))
      {
        return true;
      }
    }
    return false;
  }

  void dropParticlesBehind(std::size_t count)
  {
    while (this->Particles.size() > count)
    {
      this->Particles.pop_back();
      this->Fans.dropLastVertex();
    }
  }

  const ParticleNeighbors& Neighbors;
  const ConstrainedEdges& Edges;
  Buffer<Particle>& Particles;
  TriangleFans& Fans;
  const ParallelFor& Parallel;
  const Isosurface& Surface;
  std::optional<SurfaceBelow> Below;
  std::vector<OpenLoop> Loops;
  /// Indices of loops around holes, and around pieces of the mesh.
  std::vector<std::size_t> Holes, Islands;
  /// By particle: the holes at whose borders it is.
  std::map<int, std::vector<std::size_t>> HolesOf;
  /// By hole: what lies inside it.
  std::map<std::size_t, std::vector<std::vector<int>>> Loose;
  Turned Allowed = Turned::Never;
  /// Triangles that a triangulation of the present hole must not have, sorted corners.
  std::set<Triangle> Rejected;
};

} // namespace

void fillHoles(const Isosurface& surface, const ParticleNeighbors& neighbors,
  const ConstrainedEdges& edges, Distribution& distribution, TriangleFans& fans,
  const ParallelFor& parallelFor)
{
  HoleFiller(surface, neighbors, edges, distribution, fans, parallelFor).fillAll();
}

} // namespace hop
