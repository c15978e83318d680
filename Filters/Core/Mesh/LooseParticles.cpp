#include "Mesh/LooseParticles.h"

#include "Mesh/ParticlesAround.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace hop
{
namespace
{

/// Largest distance of a triangle's corner from the mean of both tangent planes, in units of the spacing. Larger: the
/// particle may be joined to another sheet; smaller: it is left alone where the surface bends.
constexpr double sheetThickness = 0.5;

/// Whether a loose particle may be joined to triangles with a corner.
bool areOnOneSheet(const ParticleNeighbors& neighbors, int loose, int corner)
{
  const glm::dvec3 normals(neighbors.normals[loose] + neighbors.normals[corner]);
  const glm::dvec3 apart = neighbors.points.positions[corner] - neighbors.points.positions[loose];
  const double spacing =
    std::max(neighbors.points.spacings[loose], neighbors.points.spacings[corner]);
  return neighbors.areOnOnePiece(loose, corner) &&
    std::abs(glm::dot(apart, normals)) <= 2.0 * sheetThickness * spacing;
}

/// The triangles around one particle, as its tangent plane shows them.
class Sight
{
public:
  /// \param around see ParticlesAround
  Sight(const ParticleNeighbors& neighbors, const std::vector<int>& around, int particle)
    : Neighbors(neighbors)
    , Around(around)
    , Middle(particle)
    , Plane(neighbors.points.positions[particle], neighbors.normals[particle],
        neighbors.points.spacings[particle])
  {
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
    const auto mayBeJoined = [this](int corner)
    {
      return static_cast<std::size_t>(corner) < this->Neighbors.seen.size() &&
        areOnOneSheet(this->Neighbors, this->Middle, corner);
    };
    if (!std::all_of(triangle.begin(), triangle.end(), mayBeJoined))
    {
      return {};
    }
    std::array<glm::dvec2, 3> x;
    std::transform(triangle.begin(), triangle.end(), x.begin(),
      [this](int corner) { return this->Plane.flat(this->Neighbors.points.positions[corner]); });
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

  /// A triangle that has the particle inside.
  /// \param mayHave mayHave(corner)
  template <class MayHave>
  std::optional<Triangle> covering(const TriangleFans& fans, const MayHave& mayHave) const
  {
    std::optional<Triangle> found;
    for (const int j : this->Around)
    {
      fans.visit(j,
        [&](const LinkEdge& edge)
        {
          const Triangle triangle{ j, edge.from, edge.to };
          if (!found && std::all_of(triangle.begin(), triangle.end(), mayHave) &&
            this->whereIn(triangle).triangle)
          {
            found = triangle;
          }
        });
    }
    return found;
  }

private:
  const ParticleNeighbors& Neighbors;
  const std::vector<int>& Around;
  int Middle;
  TangentPlane Plane;
};

/// Inserts one particle.
class Insertion
{
public:
  /// \param mayTurn whether triangles may be turned away from one of their corners
  Insertion(const ParticleNeighbors& neighbors, const std::vector<int>& around,
    const ConstrainedEdges& edges, TriangleFans& fans, int particle, bool mayTurn)
    : Neighbors(neighbors)
    , Seen(neighbors, around, particle)
    , Edges(edges)
    , Fans(fans)
    , Middle(particle)
    , MayTurn(mayTurn)
  {
  }

  void run()
  {
    const auto covering = this->Seen.covering(this->Fans, [](int) { return true; });
    if (!covering)
    {
      return;
    }
    this->add(*covering);
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
      const bool isTaken = behind >= 0 && this->Seen.whereIn({ b, a, behind }).circle;
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

  /// Whether a triangle between the particle and an edge of the border faces its corners, or, where the surface bends by
  /// more than a right angle within a spacing, their mean normal.
  bool faces(const std::array<int, 2>& edge) const
  {
    const glm::dvec3 normal = glm::cross(
      this->at(edge[0]) - this->at(this->Middle), this->at(edge[1]) - this->at(this->Middle));
    double sum = 0.0;
    bool isTurned = false;
    for (const int corner : { this->Middle, edge[0], edge[1] })
    {
      const double facing = glm::dot(normal, glm::dvec3(this->Neighbors.normals[corner]));
      sum += facing;
      isTurned = isTurned || facing <= 0.0;
    }
    return sum > 0.0 && (!isTurned || this->MayTurn);
  }

  /// Whether the border surrounds the particle once, through every corner, and no triangle would be turned away.
  bool isGood() const
  {
    std::set<int> corners, begins;
    for (const Triangle& triangle : this->Cavity)
    {
      corners.insert(triangle.begin(), triangle.end());
    }
    for (const std::array<int, 2>& edge : this->Border)
    {
      begins.insert(edge[0]);
    }
    return begins == corners && this->Border.size() == corners.size() &&
      this->Cavity.size() + 2 == corners.size() &&
      std::all_of(this->Border.begin(), this->Border.end(),
        [this](const std::array<int, 2>& edge) { return this->faces(edge); });
  }

  const ParticleNeighbors& Neighbors;
  Sight Seen;
  const ConstrainedEdges& Edges;
  TriangleFans& Fans;
  int Middle;
  bool MayTurn;
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

/// The vertices of a piece of a mesh, if they are few, and none is on a constrained edge or was added to fill a hole.
std::optional<std::set<int>> verticesOfIsland(
  int start, std::size_t known, const ConstrainedEdges& edges, const TriangleFans& fans)
{
  // Larger: larger pieces have borders along which others may be joined to them; smaller: pieces stay double.
  constexpr std::size_t most = 100;
  std::set<int> vertices;
  std::vector<int> pending{ start };
  while (!pending.empty())
  {
    const int vertex = pending.back();
    pending.pop_back();
    if (vertices.size() > most || static_cast<std::size_t>(vertex) >= known ||
      edges.isOnEdge(vertex))
    {
      return std::nullopt;
    }
    if (vertices.insert(vertex).second)
    {
      fans.visit(vertex,
        [&](const LinkEdge& edge) {
          pending.insert(pending.end(), { edge.from, edge.to });
        });
    }
  }
  return vertices;
}

/// Drops the triangles of small pieces that lie on the rest of the mesh: their particles are joined to it, one by one.
void takeIslandsApart(const ParticleNeighbors& neighbors, const ParticlesAround& particlesAround,
  const ConstrainedEdges& edges, const std::vector<OpenLoop>& loops, TriangleFans& fans)
{
  for (const OpenLoop& loop : loops)
  {
    const bool isIsland = loop.isClosed && areaInside(neighbors.particles, loop.particles) < 0.0;
    const auto vertices = isIsland
      ? verticesOfIsland(loop.particles.front(), neighbors.seen.size(), edges, fans)
      : std::nullopt;
    if (!vertices || vertices->empty())
    {
      continue;
    }
    const auto isOther = [&](int corner) { return vertices->count(corner) == 0; };
    const bool isCovered = std::all_of(vertices->begin(), vertices->end(),
      [&](int vertex)
      {
        const std::vector<int> around = particlesAround.of(vertex);
        return Sight(neighbors, around, vertex).covering(fans, isOther).has_value();
      });
    for (const int vertex : isCovered ? *vertices : std::set<int>())
    {
      fans.clear(vertex);
    }
  }
}

/// Particles without triangles that may be joined to some.
std::vector<int> looseParticles(
  const ParticleNeighbors& neighbors, const ConstrainedEdges& edges, const TriangleFans& fans)
{
  std::vector<int> loose;
  for (std::size_t i = 0; i < neighbors.seen.size(); ++i)
  {
    const int particle = static_cast<int>(i);
    if (!fans.hasTriangles(particle) && isOnNoBoundary(edges, particle) &&
      !neighbors.isReplaced(particle))
    {
      loose.push_back(particle);
    }
  }
  return loose;
}

} // namespace

void joinLooseParticles(const ParticleNeighbors& neighbors, const ConstrainedEdges& edges,
  const std::vector<OpenLoop>& loops, TriangleFans& fans)
{
  if (loops.empty() && looseParticles(neighbors, edges, fans).empty())
  {
    return;
  }
  const ParticlesAround particlesAround(neighbors.points);
  takeIslandsApart(neighbors, particlesAround, edges, loops, fans);
  for (const bool mayTurn : { false, true })
  {
    for (const int particle : looseParticles(neighbors, edges, fans))
    {
      const std::vector<int> around = particlesAround.of(particle);
      Insertion(neighbors, around, edges, fans, particle, mayTurn).run();
    }
  }
}

} // namespace hop
