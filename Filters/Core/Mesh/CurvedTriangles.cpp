#include "Mesh/CurvedTriangles.h"

#include "Mesh/NodeFinder.h"
#include "Support/SortedBy.h"
#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace hop
{
namespace
{

using Corners = std::array<int, 3>;

/// An edge of a triangle, from its end with the smaller vertex to the other.
struct Edge
{
  /// Particles at the ends, and the vertices that they belong to.
  std::array<int, 2> ends{};
  std::array<int, 2> vertices{};
  /// 3 * triangle + the number of the edge in the triangle.
  std::size_t place = 0;
  /// Number of triangles at the edge.
  int uses = 1;
  /// The triangles at the edge lie on two sides of a crease.
  bool isCrease = false;

  bool isSame(const Edge& other) const { return this->vertices == other.vertices; }
};

/// The edges of a mesh, each once.
struct Edges
{
  std::vector<Edge> all;
  /// Three entries a triangle: the number of the edge 01, 12 and 20, and whether it runs the other way.
  std::vector<int> ofTriangles;
  std::vector<char> reversed;
};

Edge edgeOf(
  const std::vector<Corners>& triangles, const std::vector<int>& vertices, std::size_t place)
{
  const Corners& corners = triangles[place / 3];
  std::array<int, 2> ends{ corners[place % 3], corners[(place + 1) % 3] };
  if (vertices[ends[0]] > vertices[ends[1]])
  {
    std::swap(ends[0], ends[1]);
  }
  return { ends, { vertices[ends[0]], vertices[ends[1]] }, place };
}

/// Whether two uses of an edge lie on two sides of a crease: they have no particle in common.
bool lieApart(const Edge& a, const Edge& b)
{
  return a.ends[0] != b.ends[0] && a.ends[1] != b.ends[1];
}

Edges findEdges(const std::vector<Corners>& triangles, const std::vector<int>& vertices,
  const ParallelFor& parallelFor)
{
  Buffer<Edge> uses(3 * triangles.size());
  forAll(
    parallelFor, uses.size(), [&](std::size_t n) { uses[n] = edgeOf(triangles, vertices, n); });
  const Grouping ofVertices = groupedBy(
    uses, vertices.size(), [](const Edge& edge) { return edge.vertices[0]; }, parallelFor);
  Edges edges;
  edges.ofTriangles.resize(uses.size());
  edges.reversed.resize(uses.size());
  std::vector<int> order;
  for (std::size_t v = 0; v < vertices.size(); ++v)
  {
    order.assign(ofVertices.order.begin() + ofVertices.start[v],
      ofVertices.order.begin() + ofVertices.start[v + 1]);
    std::stable_sort(order.begin(), order.end(),
      [&](int a, int b) { return uses[a].vertices[1] < uses[b].vertices[1]; });
    for (const int n : order)
    {
      const Edge& use = uses[n];
      if (edges.all.empty() || !edges.all.back().isSame(use))
      {
        edges.all.push_back(use);
      }
      else
      {
        ++edges.all.back().uses;
        edges.all.back().isCrease |= lieApart(edges.all.back(), use);
      }
      edges.ofTriangles[n] = static_cast<int>(edges.all.size()) - 1;
      edges.reversed[n] = use.ends[0] != triangles[n / 3][n % 3] ? 1 : 0;
    }
  }
  return edges;
}

class Bender
{
public:
  Bender(const Isosurface& surface, const std::vector<Corners>& triangles,
    const std::vector<int>& vertices, int order, Buffer<Particle>& particles,
    const ParallelFor& parallelFor)
    : Surface(surface)
    , Triangles(triangles)
    , Order(order)
    , Particles(particles)
    , Parallel(parallelFor)
    , Found(findEdges(triangles, vertices, parallelFor))
    , FirstEdgeNode(particles.size())
    , FirstFaceNode(this->FirstEdgeNode + this->Found.all.size() * this->nodesInEdge())
  {
  }

  CurvedTriangles bend();

private:
  std::size_t nodesInEdge() const { return static_cast<std::size_t>(this->Order) - 1; }
  std::size_t nodesInFace() const
  {
    return static_cast<std::size_t>(CurvedTriangles::nodeCount(this->Order)) - 3 * this->Order;
  }
  bool mayBeOnCurve(const Edge& edge) const { return edge.uses == 1 || edge.isCrease; }
  void markEnds();
  void bendEdge(const Edge& edge, NodeFinder& finder, Particle* nodes);
  void bendFace(const Corners& corners, NodeFinder& finder, Particle* nodes);
  void listNodes(std::size_t triangle, int* nodes) const;
  NodeLine lineAt(const Corners& corners, const glm::dvec3& barycentric) const;
  double spacingAt(const Corners& corners, const glm::dvec3& barycentric) const;
  template <class Use>
  void forPieces(std::size_t count, const Use& use);

  const Isosurface& Surface;
  const std::vector<Corners>& Triangles;
  int Order;
  Buffer<Particle>& Particles;
  const ParallelFor& Parallel;
  Edges Found;
  std::size_t FirstEdgeNode;
  std::size_t FirstFaceNode;
  /// As Isosurface::jumpTolerances: zero at faces on which boundary curves and creases run.
  std::vector<float> JumpTolerances;
  Isosurface Ending;
  std::atomic<std::int64_t> Straight{ 0 };
  std::atomic<std::int64_t> Evaluations{ 0 };
};

/// Where on the straight triangle a node stands, and the line to the surface from there.
NodeLine Bender::lineAt(const Corners& corners, const glm::dvec3& barycentric) const
{
  NodeLine line;
  for (int c = 0; c < 3; ++c)
  {
    const Particle& corner = this->Particles[corners[c]];
    line.foot.xyz += barycentric[c] * corner.position.xyz;
    line.direction.xyz += barycentric[c] * corner.normal.xyz;
    line.scale = std::max(
      line.scale, length(corner.position - this->Particles[corners[(c + 1) % 3]].position));
  }
  const double size = length(line.direction);
  line.direction = (size > 0.0 ? 1.0 / size : 0.0) * line.direction;
  return line;
}

double Bender::spacingAt(const Corners& corners, const glm::dvec3& barycentric) const
{
  double spacing = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    spacing += barycentric[c] * this->Particles[corners[c]].spacing;
  }
  return spacing;
}

/// Lets the surface end at the faces on which the ends of edges on curves lie.
void Bender::markEnds()
{
  const ElementMesh& mesh = *this->Surface.mesh;
  this->JumpTolerances.assign(
    MaximumFaces * mesh.elements.size(), std::numeric_limits<float>::infinity());
  const auto mark = [&](const Location& place)
  {
    const int faces = static_cast<int>(facts(mesh.elements[place.element].domain).faces.size());
    for (int f = 0; f < faces; ++f)
    {
      if (isOnFace(mesh, place, f))
      {
        this->JumpTolerances[faceSlot(place.element, f)] = 0.0f;
        const FaceNeighbor& behind = mesh.neighbor(place.element, f);
        if (behind.element >= 0)
        {
          this->JumpTolerances[faceSlot(behind.element, behind.face)] = 0.0f;
        }
      }
    }
  };
  for (const Edge& edge : this->Found.all)
  {
    if (this->mayBeOnCurve(edge))
    {
      mark(this->Particles[edge.ends[0]].location);
      mark(this->Particles[edge.ends[1]].location);
    }
  }
  this->Ending = this->Surface;
  this->Ending.jumpTolerances = &this->JumpTolerances;
}

/// Calls use(finder, n) for all n in [0, count) with a finder for each piece.
template <class Use>
void Bender::forPieces(std::size_t count, const Use& use)
{
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(count),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      NodeFinder finder(this->Surface, this->Ending);
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        use(finder, static_cast<std::size_t>(n));
      }
      this->Evaluations += finder.evaluations();
    });
}

void Bender::bendEdge(const Edge& edge, NodeFinder& finder, Particle* nodes)
{
  const Corners ends{ edge.ends[0], edge.ends[1], edge.ends[1] };
  const auto& [first, last] = edge.ends;
  const WorldVector chord = this->Particles[last].position - this->Particles[first].position;
  for (int i = 1; i < this->Order; ++i)
  {
    const double share = static_cast<double>(i) / this->Order;
    const glm::dvec3 barycentric(1.0 - share, share, 0.0);
    const NodeLine line = this->lineAt(ends, barycentric);
    const double spacing = this->spacingAt(ends, barycentric);
    const Location& start = this->Particles[2 * i <= this->Order ? first : last].location;
    std::optional<Evaluated> found;
    if (this->mayBeOnCurve(edge))
    {
      found = finder.onCurve(start, line, (1.0 / length(chord)) * chord);
    }
    if (!found)
    {
      found = finder.onLine(start, line);
    }
    Particle& node = *nodes++;
    node = found ? finder.particleOf(found->location, spacing)
                 : finder.straightParticle(start, line, spacing);
    if (found && edge.isCrease)
    {
      node.normal = finder.meanNormal(found->location);
    }
    this->Straight += found ? 0 : 1;
  }
}

/// Nodes inside a triangle: one of order 3, three of order 4, each nearest to one corner.
void Bender::bendFace(const Corners& corners, NodeFinder& finder, Particle* nodes)
{
  for (int n = 0; n < static_cast<int>(this->nodesInFace()); ++n)
  {
    glm::dvec3 barycentric(1.0 / this->Order);
    barycentric[n] = 1.0 - 2.0 / this->Order;
    const NodeLine line = this->lineAt(corners, barycentric);
    const double spacing = this->spacingAt(corners, barycentric);
    const Location& start = this->Particles[corners[n]].location;
    const std::optional<Evaluated> found = finder.onLine(start, line);
    nodes[n] = found ? finder.particleOf(found->location, spacing)
                     : finder.straightParticle(start, line, spacing);
    this->Straight += found ? 0 : 1;
  }
}

void Bender::listNodes(std::size_t triangle, int* nodes) const
{
  nodes = std::copy_n(this->Triangles[triangle].begin(), 3, nodes);
  const auto inEdge = static_cast<int>(this->nodesInEdge());
  for (std::size_t e = 3 * triangle; e < 3 * triangle + 3; ++e)
  {
    const int first = static_cast<int>(this->FirstEdgeNode) + this->Found.ofTriangles[e] * inEdge;
    for (int i = 0; i < inEdge; ++i)
    {
      *nodes++ = first + (this->Found.reversed[e] ? inEdge - 1 - i : i);
    }
  }
  const std::size_t first = this->FirstFaceNode + triangle * this->nodesInFace();
  for (std::size_t i = 0; i < this->nodesInFace(); ++i)
  {
    *nodes++ = static_cast<int>(first + i);
  }
}

CurvedTriangles Bender::bend()
{
  askCaller(this->Parallel);
  this->markEnds();
  askCaller(this->Parallel);
  this->Particles.resize(this->FirstFaceNode + this->Triangles.size() * this->nodesInFace());
  Particle* const edgeNodes = this->Particles.data() + this->FirstEdgeNode;
  this->forPieces(this->Found.all.size(),
    [&](NodeFinder& finder, std::size_t e)
    { this->bendEdge(this->Found.all[e], finder, edgeNodes + e * this->nodesInEdge()); });
  Particle* const faceNodes = this->Particles.data() + this->FirstFaceNode;
  this->forPieces(this->Triangles.size(),
    [&](NodeFinder& finder, std::size_t t)
    { this->bendFace(this->Triangles[t], finder, faceNodes + t * this->nodesInFace()); });
  CurvedTriangles result;
  const std::size_t ofTriangle = CurvedTriangles::nodeCount(this->Order);
  result.nodes.resize(ofTriangle * this->Triangles.size());
  forAll(this->Parallel, this->Triangles.size(),
    [&](std::size_t t) { this->listNodes(t, result.nodes.data() + t * ofTriangle); });
  result.straightNodes = this->Straight;
  result.evaluations = this->Evaluations;
  return result;
}

} // namespace

CurvedTriangles bendTriangles(const Isosurface& surface, const std::vector<Corners>& triangles,
  const std::vector<int>& vertices, int order, Buffer<Particle>& particles,
  const ParallelFor& parallelFor)
{
  return Bender(surface, triangles, vertices, order, particles, parallelFor).bend();
}

} // namespace hop
