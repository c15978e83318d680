#pragma once

#include "Support/Buffer.h"
#include "Support/SortedBy.h"

#include <array>
#include <vector>

namespace hop
{

/// The other ends of the directed edges at each particle, ascending if the edges are.
class EdgeLinks
{
public:
  /// The end of an edge by which it is found.
  enum class By
  {
    Beginning,
    End
  };

  EdgeLinks() = default;
  EdgeLinks(const std::vector<std::array<int, 2>>& edges, By end, std::size_t particleCount)
  {
    const int own = end == By::Beginning ? 0 : 1;
    Grouping grouping =
      groupedBy(edges, particleCount, [own](const std::array<int, 2>& edge) { return edge[own]; });
    this->Ends = std::move(grouping.order);
    this->Start = std::move(grouping.start);
    for (int& e : this->Ends)
    {
      e = edges[e][1 - own];
    }
  }

  /// Empty for particles that were appended later.
  Span<int> at(int particle) const
  {
    const auto p = static_cast<std::size_t>(particle);
    return p + 1 < this->Start.size()
      ? Span<int>(this->Ends.data() + this->Start[p],
          static_cast<std::size_t>(this->Start[p + 1] - this->Start[p]))
      : Span<int>(nullptr, 0);
  }

private:
  std::vector<int> Ends, Start;
};

} // namespace hop
