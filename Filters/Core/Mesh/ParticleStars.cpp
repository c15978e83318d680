#include "Mesh/ParticleStars.h"

#include "Mesh/TangentView.h"

#include <cmath>
#include <limits>

namespace hop
{
namespace
{

/// Least sine of an angle at the middle of a star between two neighbours of one triangle. Smaller: triangles without
/// area; larger: gaps beside particles that stand too close.
constexpr double leastSine = 1e-3;

/// The star of one particle.
class Star
{
public:
  /// \param neighbors places in units of the particle's spacing
  /// \param fan receives the edges opposite to the particle
  Star(const std::vector<FlatNeighbor>& neighbors, std::vector<LinkEdge>& fan)
    : Neighbors(neighbors)
    , Fan(fan)
  {
  }

  /// Triangles all around.
  void close()
  {
    if (this->Neighbors.size() < 2)
    {
      return;
    }
    // The nearest neighbour shares an edge of the Delaunay triangulation.
    const auto nearest = std::min_element(this->Neighbors.begin(), this->Neighbors.end(),
      [](const FlatNeighbor& a, const FlatNeighbor& b)
      { return glm::dot(a.place, a.place) < glm::dot(b.place, b.place); });
    const int start = static_cast<int>(nearest - this->Neighbors.begin());
    this->fill(start, start);
  }

  /// Triangles counterclockwise from one neighbour to another.
  /// \pre all neighbours are between them
  void fill(int start, int end)
  {
    const std::size_t before = this->Fan.size();
    const int reached = this->turn(1.0, start, end);
    if (reached != end || this->Fan.size() == before)
    {
      // From the other side of the gap, and no farther than to where the first turn ended.
      this->turn(-1.0, end, reached);
    }
  }

private:
  /// Adds triangle after triangle, until the end is reached or there is none.
  /// \param sense 1: counterclockwise, -1: clockwise
  /// \return the last neighbour that was reached
  int turn(double sense, int start, int end)
  {
    int at = start;
    // Rounding must not make it run in circles.
    for (std::size_t step = 0; step < this->Neighbors.size(); ++step)
    {
      const int next = this->nextTo(at, sense, end);
      if (next < 0)
      {
        break;
      }
      const int from = this->Neighbors[at].index;
      const int to = this->Neighbors[next].index;
      this->Fan.push_back(sense > 0.0 ? LinkEdge{ from, to } : LinkEdge{ to, from });
      at = next;
      if (next == end)
      {
        break;
      }
    }
    return at;
  }

  /// The neighbour whose circle with the particle and the neighbour `at` is empty on this side: it sees the edge under
  /// the largest angle, which has the least cotangent.
  int nextTo(int at, double sense, int end) const
  {
    const glm::dvec2 q = this->Neighbors[at].place;
    const glm::dvec2 last = this->Neighbors[end].place;
    // Nobody beyond the end, once it is less than half a turn away; nor in the same place, as the beginning is where a
    // crease fades.
    const bool endIsNear = sense * crossOf(q, last) > 0.0;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < this->Neighbors.size(); ++n)
    {
      const glm::dvec2 c = this->Neighbors[n].place;
      const double cross = sense * crossOf(q, c);
      const double inside = glm::dot(c, c - q);
      if (unsigned{ cross > 0.0 } &
        unsigned{ inside < least * cross }) // one jump that can be foretold
      {
        const bool isBeyond = static_cast<int>(n) != end &&
          (c == last || (endIsNear && sense * crossOf(c, last) <= 0.0));
        if (!isBeyond && cross * cross > leastSine * leastSine * glm::dot(q, q) * glm::dot(c, c))
        {
          least = inside / cross;
          best = static_cast<int>(n);
        }
      }
    }
    // The circumradius from the edge and the angle opposite to it.
    const double radiusSquared = 0.25 * glm::dot(q, q) * (1.0 + least * least);
    constexpr double largest = ParticleNeighbors::LargestRadius;
    return radiusSquared <= largest * largest ? best : -1;
  }

  const std::vector<FlatNeighbor>& Neighbors;
  std::vector<LinkEdge>& Fan;
};

/// Drops edges that begin or end where an earlier edge of the same star does: sectors overlap by rounding where edges of
/// the surface leave a particle in the same direction.
void dropOverlaps(std::size_t first, std::vector<LinkEdge>& fan)
{
  std::size_t kept = first;
  for (std::size_t n = first; n < fan.size(); ++n)
  {
    const LinkEdge& edge = fan[n];
    const auto begin = fan.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = fan.begin() + static_cast<std::ptrdiff_t>(kept);
    if (std::none_of(begin, end,
          [&](const LinkEdge& other) { return other.from == edge.from || other.to == edge.to; }))
    {
      fan[kept++] = edge;
    }
  }
  fan.resize(kept);
}

/// Appends the edges opposite to a particle in its star.
void addStar(
  const ParticleNeighbors& neighbors, int particle, TangentView& view, std::vector<LinkEdge>& fan)
{
  const std::size_t before = fan.size();
  view.lookFrom(particle, neighbors.of(particle));
  if (view.sectors().empty())
  {
    Star(view.neighbors(), fan).close();
  }
  for (const TangentView::Sector& sector : view.sectors())
  {
    Star(sector.neighbors, fan).fill(sector.first, sector.last);
  }
  dropOverlaps(before, fan);
}

} // namespace

TriangleFans agreedTriangles(
  const ParticleNeighbors& neighbors, const ConstrainedEdges& edges, const ParallelFor& parallelFor)
{
  TriangleFans fans(
    neighbors.normals.size(), parallelFor, [&]() { return TangentView(neighbors, edges); },
    [&](int particle, std::vector<LinkEdge>& fan, TangentView& view)
    { addStar(neighbors, particle, view, fan); });
  fans.keepAgreed(parallelFor);
  return fans;
}

} // namespace hop
