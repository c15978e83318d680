#pragma once

#include "Surface/Particles.h"

#include <array>
#include <vector>

namespace hop
{

/// The segments of boundary curves and creases as directed edges, with the surface to the left as seen from where the
/// normals point to. Where the particles do not tell on which side of a segment the surface is, both directions count.
class ConstrainedEdges
{
public:
  using Edge = std::array<int, 2>;

  explicit ConstrainedEdges(const Distribution& distribution);

  /// \pre the first edge is there
  /// \param particleCount more than the indices of the second edge's ends
  void replace(const Edge& edge, const Edge& by, std::size_t particleCount);

  bool empty() const { return this->Next.empty(); }
  /// The ends of the edges that begin at a particle, ascending.
  Span<int> after(int particle) const { return ofParticle(this->Next, this->NextStart, particle); }
  /// The beginnings of the edges that end at a particle, ascending.
  Span<int> before(int particle) const
  {
    return ofParticle(this->Previous, this->PreviousStart, particle);
  }
  /// Whether the surface has to its left an edge from a to b, and ends there to its right.
  bool has(int a, int b) const;
  /// Whether there is an edge in one direction or in both.
  bool joins(int a, int b) const { return this->has(a, b) || this->has(b, a); }
  bool isOnEdge(int particle) const
  {
    return !this->after(particle).empty() || !this->before(particle).empty();
  }

private:
  void set(const std::vector<Edge>& edges, std::size_t particleCount);

  static Span<int> ofParticle(
    const std::vector<int>& particles, const std::vector<int>& start, int particle)
  {
    // Particles that were appended have no edges.
    const auto p = static_cast<std::size_t>(particle);
    return p + 1 < start.size()
      ? Span<int>(particles.data() + start[p], static_cast<std::size_t>(start[p + 1] - start[p]))
      : Span<int>(nullptr, 0);
  }

  std::vector<int> Next, NextStart;
  std::vector<int> Previous, PreviousStart;
};

} // namespace hop
