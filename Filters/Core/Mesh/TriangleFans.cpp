#include "Mesh/TriangleFans.h"

#include <algorithm>
#include <numeric>

namespace hop
{
namespace
{

bool isSame(const LinkEdge& edge, int from, int to)
{
  return edge.from == from && edge.to == to;
}

} // namespace

bool TriangleFans::has(int vertex, int from, int to) const
{
  return std::any_of(this->begin(vertex), this->end(vertex),
    [&](const LinkEdge& edge) { return isSame(edge, from, to); });
}

void TriangleFans::keepAgreed(const ParallelFor& parallelFor)
{
  std::vector<std::vector<char>> agreed(this->Chunks.size());
  const auto verticesOf = [this](std::size_t chunk, const auto& use)
  {
    const std::size_t last = std::min(this->Places.size(), (chunk + 1) * VerticesPerChunk);
    for (std::size_t vertex = chunk * VerticesPerChunk; vertex < last; ++vertex)
    {
      use(static_cast<int>(vertex));
    }
  };
  forAll(parallelFor, this->Chunks.size(),
    [&](std::size_t chunk)
    {
      agreed[chunk].reserve(this->Chunks[chunk].size());
      verticesOf(chunk,
        [&](int vertex)
        {
          this->visit(vertex,
            [&](const LinkEdge& edge)
            {
              agreed[chunk].push_back(
                this->has(edge.from, edge.to, vertex) && this->has(edge.to, vertex, edge.from));
            });
        });
    });
  forAll(parallelFor, this->Chunks.size(),
    [&](std::size_t chunk)
    {
      Fan& fans = this->Chunks[chunk];
      int kept = 0;
      verticesOf(chunk,
        [&](int vertex)
        {
          Place& place = this->Places[vertex];
          const int end = place.first + place.count;
          int n = place.first;
          place.first = kept;
          for (; n < end; ++n)
          {
            if (agreed[chunk][n])
            {
              fans[kept++] = fans[n];
            }
          }
          place.count = kept - place.first;
        });
      fans.resize(kept);
    });
}

int TriangleFans::apexOf(int a, int b) const
{
  const LinkEdge* found = std::find_if(
    this->begin(a), this->end(a), [&](const LinkEdge& edge) { return edge.from == b; });
  return found == this->end(a) ? -1 : found->to;
}

bool TriangleFans::hasTriangles(int vertex) const
{
  return this->begin(vertex) != this->end(vertex);
}

bool TriangleFans::isRing(int vertex) const
{
  const LinkEdge* const last = this->end(vertex);
  const LinkEdge* edge = this->begin(vertex);
  if (edge == last)
  {
    return false;
  }
  const int start = edge->from;
  int reached = start;
  for (; edge != last && edge->from == reached; ++edge)
  {
    reached = edge->to;
  }
  return edge == last && reached == start;
}

TriangleFans::Fan& TriangleFans::changed(int vertex)
{
  Place& place = this->Places[vertex];
  if (place.count >= 0)
  {
    this->Changed[vertex] = place.count > 0 ? Fan(this->begin(vertex), this->end(vertex)) : Fan();
    place.count = -1;
  }
  return this->Changed.at(vertex);
}

void TriangleFans::appendVertex()
{
  this->Changed[static_cast<int>(this->Places.size())];
  this->Places.push_back({ 0, -1 });
}

void TriangleFans::dropLastVertex()
{
  this->Places.pop_back();
  this->Changed.erase(static_cast<int>(this->Places.size()));
}

void TriangleFans::add(const Triangle& triangle)
{
  for (int corner = 0; corner < 3; ++corner)
  {
    this->changed(triangle[corner])
      .push_back({ triangle[(corner + 1) % 3], triangle[(corner + 2) % 3] });
  }
}

void TriangleFans::remove(const Triangle& triangle)
{
  for (int corner = 0; corner < 3; ++corner)
  {
    Fan& fan = this->changed(triangle[corner]);
    fan.erase(std::find_if(fan.begin(), fan.end(),
      [&](const LinkEdge& edge)
      { return isSame(edge, triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]); }));
  }
}

void TriangleFans::clear(int vertex)
{
  const Fan own(this->begin(vertex), this->end(vertex));
  for (const LinkEdge& edge : own)
  {
    this->remove({ vertex, edge.from, edge.to });
  }
}

std::vector<Triangle> TriangleFans::triangles(const ParallelFor& parallelFor) const
{
  const std::size_t chunkCount = (this->Places.size() + VerticesPerChunk - 1) / VerticesPerChunk;
  const auto visitChunk = [this](std::size_t chunk, const auto& use)
  {
    const std::size_t last = std::min(this->Places.size(), (chunk + 1) * VerticesPerChunk);
    for (std::size_t v = chunk * VerticesPerChunk; v < last; ++v)
    {
      const int vertex = static_cast<int>(v);
      this->visit(vertex,
        [&](const LinkEdge& edge)
        {
          if (vertex < edge.from && vertex < edge.to)
          {
            use(Triangle{ vertex, edge.from, edge.to });
          }
        });
    }
  };
  std::vector<std::size_t> start(chunkCount + 1, 0);
  forAll(parallelFor, chunkCount,
    [&](std::size_t chunk) { visitChunk(chunk, [&](const Triangle&) { ++start[chunk + 1]; }); });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Triangle> result(start.back());
  forAll(parallelFor, chunkCount,
    [&](std::size_t chunk)
    {
      std::size_t next = start[chunk];
      visitChunk(chunk, [&](const Triangle& triangle) { result[next++] = triangle; });
    });
  return result;
}

} // namespace hop
