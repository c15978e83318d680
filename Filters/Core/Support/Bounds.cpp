#include "Support/Bounds.h"

#include <algorithm>
#include <vector>

namespace hop
{

Bounds boundsOf(Span<glm::dvec3> points, const ParallelFor& parallelFor)
{
  // Points that a thread takes at a time: so many that taking them costs nothing beside reading them, so few that some
  // 100,000 points keep several threads busy. Bounds do not depend on it.
  constexpr std::size_t pointsPerPiece = 16384;
  if (points.empty())
  {
    return {};
  }
  std::vector<Bounds> pieces(
    (points.size() + pointsPerPiece - 1) / pointsPerPiece, { points[0], points[0] });
  forAll(parallelFor, pieces.size(),
    [&](std::size_t piece)
    {
      const std::size_t end = std::min(points.size(), (piece + 1) * pointsPerPiece);
      for (std::size_t i = piece * pointsPerPiece; i < end; ++i)
      {
        pieces[piece].include({ points[i], points[i] });
      }
    });
  Bounds all = pieces.front();
  for (const Bounds& bounds : pieces)
  {
    all.include(bounds);
  }
  return all;
}

} // namespace hop
