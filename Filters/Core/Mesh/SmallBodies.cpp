#include "Mesh/SmallBodies.h"

#include "Mesh/ConvexHull.h"
#include "Mesh/TriangleNormal.h"

#include <algorithm>
#include <set>
#include <utility>

namespace hop
{
namespace
{

/// Chosen by experiment.
struct Body
{
  /// Particles. Larger: the hull, whose time grows with the square, of what stars can close; smaller: long bodies stay open.
  static constexpr std::size_t Most = 100;
  /// Largest height of a particle over the tangent plane of another one, in units of the larger spacing. Larger: bodies
  /// with dents, which the hull bridges; smaller: rounding.
  static constexpr double Height = 0.05;
};

class SmallBody
{
public:
  SmallBody(const ParticleNeighbors& neighbors, const ConstrainedEdges& edges, TriangleFans& fans)
    : Neighbors(neighbors)
    , Edges(edges)
    , Fans(fans)
  {
  }

  /// Closes the component with a particle.
  /// \param seen receives the particles that need not be looked at again
  /// \return whether it is a convex body
  bool close(int start, std::set<int>& seen)
  {
    const double side = this->collect(start, seen) ? this->sideOfNormals() : 0.0;
    if (side == 0.0)
    {
      return false;
    }
    const std::vector<Triangle> hull = this->hullOn(side);
    // Euler's formula: all particles are corners of a closed surface. The hull of a patch has a back, which is turned.
    const bool isBody = hull.size() + 4 == 2 * this->Particles.size() &&
      std::none_of(hull.begin(), hull.end(),
        [this](const Triangle& t) { return isTurnedFromMean(this->Neighbors.particles, t); });
    if (isBody)
    {
      std::for_each(
        this->Particles.begin(), this->Particles.end(), [this](int p) { this->Fans.clear(p); });
      std::for_each(hull.begin(), hull.end(), [this](const Triangle& t) { this->Fans.add(t); });
    }
    return isBody;
  }

private:
  const glm::dvec3& at(int particle) const
  {
    return this->Neighbors.particles[particle].position.xyz;
  }

  /// Collects all particles that are near each other, or have triangles together.
  /// \return whether they are few, and of no other surface
  bool collect(int start, std::set<int>& seen)
  {
    std::set<int> found{ start };
    std::vector<int> pending{ start };
    bool isAlone = true;
    const auto take = [&](int p)
    {
      if (found.insert(p).second)
      {
        pending.push_back(p);
      }
    };
    while (isAlone && !pending.empty())
    {
      const int p = pending.back();
      pending.pop_back();
      this->Fans.visit(p,
        [&](const LinkEdge& edge)
        {
          take(edge.from);
          take(edge.to);
        });
      // Particles that were added to fill holes have no neighbours that are known.
      const bool isKnown = static_cast<std::size_t>(p) < this->Neighbors.seen.size();
      for (const int other : isKnown ? this->Neighbors.of(p) : Span<int>{ nullptr, 0 })
      {
        if (this->Neighbors.areOnOnePiece(p, other))
        {
          take(other);
        }
      }
      isAlone = found.size() <= Body::Most && !this->Edges.isOnEdge(p);
    }
    seen.insert(found.begin(), found.end());
    this->Particles.assign(found.begin(), found.end());
    return isAlone;
  }

  /// 1: the normals of a convex body point outward; -1: inward; 0: it is none.
  double sideOfNormals() const
  {
    bool areAllBehind = true, areAllBefore = true;
    for (const int p : this->Particles)
    {
      const Particle& particle = this->Neighbors.particles[p];
      for (const int other : this->Particles)
      {
        const double height =
          glm::dot(particle.normal.xyz, this->at(other) - particle.position.xyz);
        const double most = Body::Height *
          std::max<double>(particle.spacing, this->Neighbors.particles[other].spacing);
        areAllBehind = areAllBehind && height <= most;
        areAllBefore = areAllBefore && height >= -most;
      }
    }
    return areAllBehind == areAllBefore ? 0.0 : areAllBehind ? 1.0 : -1.0;
  }

  /// The convex hull, seen from where the normals point to.
  std::vector<Triangle> hullOn(double side) const
  {
    std::vector<glm::dvec3> points;
    for (const int p : this->Particles)
    {
      points.push_back(this->at(p));
    }
    std::vector<Triangle> hull = convexHull(points);
    for (Triangle& triangle : hull)
    {
      if (side < 0.0)
      {
        std::swap(triangle[1], triangle[2]);
      }
      for (int& corner : triangle)
      {
        corner = this->Particles[corner];
      }
    }
    return hull;
  }

  const ParticleNeighbors& Neighbors;
  const ConstrainedEdges& Edges;
  TriangleFans& Fans;
  std::vector<int> Particles;
};

} // namespace

bool closeSmallBodies(const ParticleNeighbors& neighbors, const ConstrainedEdges& edges,
  const std::vector<OpenLoop>& loops, TriangleFans& fans)
{
  std::set<int> seen;
  bool isAnyClosed = false;
  const auto closeAt = [&](int p)
  {
    if (seen.count(p) == 0)
    {
      isAnyClosed = SmallBody(neighbors, edges, fans).close(p, seen) || isAnyClosed;
    }
  };
  for (const OpenLoop& loop : loops)
  {
    closeAt(loop.particles.front());
  }
  for (int p = 0; p < static_cast<int>(neighbors.seen.size()); ++p)
  {
    if (!fans.hasTriangles(p) && !edges.isOnEdge(p) && !neighbors.isReplaced(p))
    {
      closeAt(p);
    }
  }
  return isAnyClosed;
}

} // namespace hop
