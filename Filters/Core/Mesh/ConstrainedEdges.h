#pragma once

#include "Mesh/EdgeLinks.h"
#include "Surface/Particles.h"

#include <array>
#include <set>
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

  /// \param particleCount more than the indices of all edges' ends
  void change(
    const std::set<Edge>& removed, const std::set<Edge>& added, std::size_t particleCount);

  bool empty() const { return this->IsOnEdge.empty(); }
  /// The ends of the edges that begin at a particle, ascending.
  Span<int> after(int particle) const { return this->Next.at(particle); }
  /// The beginnings of the edges that end at a particle, ascending.
  Span<int> before(int particle) const { return this->Previous.at(particle); }
  /// Whether the surface has to its left an edge from a to b, and ends there to its right.
  bool has(int a, int b) const;
  /// Whether there is an edge in one direction or in both.
  bool joins(int a, int b) const { return this->has(a, b) || this->has(b, a); }
  bool isOnEdge(int particle) const
  {
    const auto p = static_cast<std::size_t>(particle);
    return p < this->IsOnEdge.size() && this->IsOnEdge[p] != 0;
  }

private:
  void set(const std::vector<Edge>& edges, std::size_t particleCount);

  EdgeLinks Next, Previous;
  /// By particle.
  std::vector<char> IsOnEdge;
};

} // namespace hop
