#pragma once

#include "Common/Monitor.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace hop
{

/// Corners of a triangle, counterclockwise as seen from where the normals point to.
using Triangle = std::array<int, 3>;

/// The edge of a triangle that is opposite to one of its corners, counterclockwise around the corner.
struct LinkEdge
{
  int from = -1;
  int to = -1;
};

/// Triangles, as each vertex sees them: the edges opposite to it. Every triangle is known to its three corners.
class TriangleFans
{
public:
  using Fan = std::vector<LinkEdge>;

  /// \param fanOf fanOf(vertex, fan, worker) appends the edges that a vertex wants opposite to it; `worker` is what
  ///   makeWorker() returned, one a thread
  template <class MakeWorker, class FanOf>
  TriangleFans(std::size_t vertexCount, const ParallelFor& parallelFor,
    const MakeWorker& makeWorker, const FanOf& fanOf);

  /// Drops the edges that stand for no triangle because one of its other two corners does not want it.
  void keepAgreed(const ParallelFor& parallelFor);

  std::size_t vertexCount() const { return this->Places.size(); }

  /// Calls use(edge) for every triangle of a vertex, with its opposite edge.
  template <class Use>
  void visit(int vertex, const Use& use) const;

  /// The third corner of the triangle to the left of the edge from a to b; -1: there is none.
  int apexOf(int a, int b) const;
  bool hasTriangles(int vertex) const;
  /// Whether a vertex has triangles all around it, one fan that is stored in order: no edge at it is open. Quick, and
  /// true of nearly all vertices inside a surface; of others, other ways must tell.
  bool isRing(int vertex) const;

  /// \pre no triangle is to the left of any of its edges
  void add(const Triangle& triangle);
  /// \pre the triangle is there
  void remove(const Triangle& triangle);
  /// Removes all triangles of a vertex.
  void clear(int vertex);
  /// For a vertex that was appended to the particles.
  void appendVertex();
  /// \pre the last vertex was appended, and has no triangle
  void dropLastVertex();

  /// All triangles, each once, the least corner first, in ascending order of this corner.
  std::vector<Triangle> triangles(const ParallelFor& parallelFor) const;

private:
  struct Place
  {
    int first = 0;
    /// -1: the fan has been changed, and stands in Changed.
    int count = 0;
  };

  static constexpr std::size_t VerticesPerChunk = 256;
  const LinkEdge* begin(int vertex) const;
  const LinkEdge* end(int vertex) const;
  bool has(int vertex, int from, int to) const;
  Fan& changed(int vertex);

  std::vector<Place> Places;
  std::vector<Fan> Chunks;
  std::unordered_map<int, Fan> Changed;
};

template <class MakeWorker, class FanOf>
TriangleFans::TriangleFans(std::size_t vertexCount, const ParallelFor& parallelFor,
  const MakeWorker& makeWorker, const FanOf& fanOf)
  : Places(vertexCount)
  , Chunks((vertexCount + VerticesPerChunk - 1) / VerticesPerChunk)
{
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Chunks.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      auto worker = makeWorker();
      for (std::ptrdiff_t chunk = begin; chunk < end; ++chunk)
      {
        Fan& fans = this->Chunks[chunk];
        const std::size_t last = std::min(vertexCount, (chunk + 1) * VerticesPerChunk);
        for (std::size_t vertex = chunk * VerticesPerChunk; vertex < last; ++vertex)
        {
          const std::size_t before = fans.size();
          fanOf(static_cast<int>(vertex), fans, worker);
          this->Places[vertex] = { static_cast<int>(before),
            static_cast<int>(fans.size() - before) };
        }
      }
    });
}

inline const LinkEdge* TriangleFans::begin(int vertex) const
{
  const Place& place = this->Places[vertex];
  return place.count < 0 ? this->Changed.at(vertex).data()
                         : this->Chunks[vertex / VerticesPerChunk].data() + place.first;
}

inline const LinkEdge* TriangleFans::end(int vertex) const
{
  const Place& place = this->Places[vertex];
  return this->begin(vertex) + (place.count < 0 ? this->Changed.at(vertex).size() : place.count);
}

template <class Use>
void TriangleFans::visit(int vertex, const Use& use) const
{
  for (const LinkEdge* edge = this->begin(vertex); edge != this->end(vertex); ++edge)
  {
    use(*edge);
  }
}

} // namespace hop
