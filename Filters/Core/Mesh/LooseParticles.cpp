#include "Mesh/LooseParticles.h"

#include <algorithm>
#include <array>
#include <set>

namespace hop
{
namespace
{

/// Largest distance of a triangle's corner from the mean of both tangent planes, in units of the spacing. Larger: the
/// particle may be joined to another sheet; smaller: it is left alone where the surface bends.
constexpr double sheetThickness = 0.5;

/// Inserts one particle.
class Insertion
{
public:
  Insertion(const ParticleNeighbors& neighbors, const ConstrainedEdges& edges, TriangleFans& fans,
    int particle)
    : Neighbors(neighbors)
    , Edges(edges)
    , Fans(fans)
    , Middle(particle)
    , Plane(this->at(particle), neighbors.normals[particle], neighbors.points.spacings[particle])
  {
  }

  void run()
  {
    if (!this->findTriangle())
    {
      return;
    }
    for (std::size_t n = 0; n < this->Cavity.size(); ++n)
    {
      this->grow(this->Cavity[n]);
    }
    if (this->isGood())
    {
      for (const Triangle& triangle : this->Cavity)
      {
        this->Fans.remove(triangle);
      }
      for (const auto& [a, b] : this->Border)
      {
        this->Fans.add({ this->Middle, a, b });
      }
    }
  }

private:
  const glm::dvec3& at(int particle) const { return this->Neighbors.points.positions[particle]; }
  glm::dvec2 flat(int particle) const { return this->Plane.flat(this->at(particle)); }

  bool isOnSheet(int particle) const
  {
    const glm::dvec3 normals(
      this->Neighbors.normals[particle] + this->Neighbors.normals[this->Middle]);
    const glm::dvec3 apart = (this->at(particle) - this->Plane.origin) * this->Plane.perSpacing;
    return std::abs(glm::dot(apart, normals)) <= 2.0 * sheetThickness;
  }

  /// Whether a triangle has the particle inside, and the circle around it.
  struct Inside
  {
    bool triangle = false;
    bool circle = false;
  };

  Inside whereIn(const Triangle& triangle) const
  {
    // Particles that were added to fill holes have no neighbours that are known.
    if (!std::all_of(triangle.begin(), triangle.end(),
          [this](int corner)
          { return static_cast<std::size_t>(corner) < this->Neighbors.seen.size(); }) ||
      !std::all_of(
        triangle.begin(), triangle.end(), [this](int corner) { return this->isOnSheet(corner); }))
    {
      return {};
    }
    std::array<glm::dvec2, 3> x;
    std::transform(triangle.begin(), triangle.end(), x.begin(),
      [this](int corner) { return this->flat(corner); });
    const std::array<double, 3> part{ crossOf(x[1], x[2]), crossOf(x[2], x[0]),
      crossOf(x[0], x[1]) };
    double sum = 0.0;
    for (int n = 0; n < 3; ++n)
    {
      sum += glm::dot(x[n], x[n]) * part[n];
    }
    return { part[0] >= 0.0 && part[1] >= 0.0 && part[2] >= 0.0 &&
        part[0] + part[1] + part[2] > 0.0,
      sum > 0.0 };
  }

  bool findTriangle()
  {
    for (const int* j = this->Neighbors.seen.begin(this->Middle);
         this->Cavity.empty() && j != this->Neighbors.seen.end(this->Middle); ++j)
    {
      this->Fans.visit(*j,
        [&](const LinkEdge& edge)
        {
          const Triangle triangle{ *j, edge.from, edge.to };
          if (this->Cavity.empty() && this->whereIn(triangle).triangle)
          {
            this->add(triangle);
          }
        });
    }
    return !this->Cavity.empty();
  }

  void add(const Triangle& triangle)
  {
    Triangle sorted = triangle;
    std::sort(sorted.begin(), sorted.end());
    if (this->Known.insert(sorted).second)
    {
      this->Cavity.push_back(triangle);
    }
  }

  /// Takes the triangles behind the edges whose circles contain the particle; the other edges are on the border.
  void grow(const Triangle triangle)
  {
    for (int n = 0; n < 3; ++n)
    {
      const int a = triangle[n];
      const int b = triangle[(n + 1) % 3];
      const int behind = this->Edges.joins(a, b) ? -1 : this->Fans.apexOf(b, a);
      const bool isTaken = behind >= 0 && this->whereIn({ b, a, behind }).circle;
      if (isTaken)
      {
        this->add({ b, a, behind });
      }
      else
      {
        this->Border.push_back({ a, b });
      }
    }
  }

  /// Whether the border surrounds the particle once, through every corner, and no triangle would be turned away.
  bool isGood() const
  {
    std::set<int> corners, begins;
    for (const Triangle& triangle : this->Cavity)
    {
      corners.insert(triangle.begin(), triangle.end());
    }
    for (const auto& [a, b] : this->Border)
    {
      const glm::dvec3 normal =
        glm::cross(this->at(a) - this->Plane.origin, this->at(b) - this->Plane.origin);
      for (const int corner : { this->Middle, a, b })
      {
        if (glm::dot(normal, glm::dvec3(this->Neighbors.normals[corner])) <= 0.0)
        {
          return false;
        }
      }
      begins.insert(a);
    }
    return begins == corners && this->Border.size() == corners.size() &&
      this->Cavity.size() + 2 == corners.size();
  }

  const ParticleNeighbors& Neighbors;
  const ConstrainedEdges& Edges;
  TriangleFans& Fans;
  int Middle;
  TangentPlane Plane;
  std::vector<Triangle> Cavity;
  std::set<Triangle> Known;
  std::vector<std::array<int, 2>> Border;
};

/// Whether a particle is on no edge that tells where the surface ends: on edges in both directions alone, of which no side
/// has a triangle, as chains are led back along themselves (EdgeChains.h).
bool isOnNoBoundary(const ConstrainedEdges& edges, int particle)
{
  const Span<int> after = edges.after(particle);
  const Span<int> before = edges.before(particle);
  return std::equal(after.begin(), after.end(), before.begin(), before.end());
}

} // namespace

void joinLooseParticles(
  const ParticleNeighbors& neighbors, const ConstrainedEdges& edges, TriangleFans& fans)
{
  for (std::size_t i = 0; i < neighbors.seen.size(); ++i)
  {
    const int particle = static_cast<int>(i);
    if (!fans.hasTriangles(particle) && isOnNoBoundary(edges, particle))
    {
      Insertion(neighbors, edges, fans, particle).run();
    }
  }
}

} // namespace hop
