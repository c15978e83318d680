#include "Mesh/EdgeChains.h"

#include "Mesh/EdgeLinks.h"
#include "Support/SpacedPoints.h"
#include "Support/SpacingGrid.h"

#include <algorithm>
#include <tuple>

namespace hop
{
namespace
{

/// Where chains of edges end in the midst of the surface. Chosen by experiment.
struct ChainEnds
{
  /// Largest distance between the end of one chain and a particle of the next, in units of the spacing. Larger: ends are
  /// joined across surface; smaller: a chain goes back along itself, though the other side of the jump has one.
  static constexpr double Reach = 2.0;
  /// Least cosine between the normals there: those of one sheet in a star.
  static constexpr double Cosine = 0.3;
  /// What the way along a chain costs beside that through the surface. Larger: long edges through the surface, which no
  /// star has; smaller: slits without width where two ends are near.
  static constexpr double CostOfWayBack = 0.6;
};

using Edge = std::array<int, 2>;

/// A way from the end of a chain to the beginning of a chain: one edge through the surface, or none, and edges back
/// along one of the two chains.
struct Closure
{
  double cost = 0.0;
  int end = -1, beginning = -1;
  /// Which way along a chain, and how many of its edges are followed.
  std::size_t way = 0, steps = 0;

  bool operator<(const Closure& other) const
  {
    return std::tie(this->cost, this->end, this->beginning, this->way, this->steps) <
      std::tie(other.cost, other.end, other.beginning, other.way, other.steps);
  }
};

class ChainCloser
{
public:
  ChainCloser(const Distribution& distribution, std::vector<Edge>& edges)
    : Particles(distribution.particles)
    , Pieces(distribution.pieces)
    , Edges(edges)
    , Next(edges, EdgeLinks::By::Beginning, Particles.size())
    , Previous(edges, EdgeLinks::By::End, Particles.size())
    , Surplus(Particles.size())
  {
    const auto countOf = [&](const EdgeLinks& links, std::size_t p)
    { return static_cast<int>(links.at(static_cast<int>(p)).size()); };
    for (std::size_t p = 0; p < this->Surplus.size(); ++p)
    {
      this->Surplus[p] = countOf(this->Previous, p) - countOf(this->Next, p);
    }
  }

  void run()
  {
    this->findWays();
    std::vector<Closure> closures = this->findClosures();
    std::sort(closures.begin(), closures.end());
    for (const Closure& closure : closures)
    {
      if (this->Surplus[closure.end] > 0 && this->Surplus[closure.beginning] < 0)
      {
        --this->Surplus[closure.end];
        ++this->Surplus[closure.beginning];
        this->add(closure);
      }
    }
  }

private:
  /// The particles of a chain from one of its ends to the other, or to where chains meet.
  static std::vector<int> follow(int particle, const EdgeLinks& ahead, const EdgeLinks& behind)
  {
    std::vector<int> way{ particle };
    while (
      ahead.at(way.back()).size() == 1 && (way.size() == 1 || behind.at(way.back()).size() == 1))
    {
      const int next = ahead.at(way.back())[0];
      if (next == particle)
      {
        break;
      }
      way.push_back(next);
    }
    return way;
  }

  /// From ends of chains backwards, and from beginnings forwards.
  void findWays()
  {
    for (std::size_t p = 0; p < this->Surplus.size(); ++p)
    {
      const int particle = static_cast<int>(p);
      if (this->Surplus[p] != 0)
      {
        this->Ways.push_back(this->Surplus[p] > 0 ? follow(particle, this->Previous, this->Next)
                                                  : follow(particle, this->Next, this->Previous));
      }
    }
  }

  /// The closures by which a way and the other end of a chain come together, one for each particle of the way that is
  /// near that end.
  std::vector<Closure> findClosures() const
  {
    std::vector<std::array<std::size_t, 2>> reached; // ways, and steps on them
    for (std::size_t w = 0; w < this->Ways.size(); ++w)
    {
      for (std::size_t n = 0; n < this->Ways[w].size(); ++n)
      {
        reached.push_back({ w, n });
      }
    }
    const auto particleAt = [&](std::size_t r) -> const Particle&
    { return this->Particles[this->Ways[reached[r][0]][reached[r][1]]]; };
    const SpacedPoints points(
      reached.size(), [&](std::size_t r) { return particleAt(r).position.xyz; },
      [&](std::size_t r) { return particleAt(r).spacing; }, {});
    const SpacingGrid grid(points.positions, points.spacings, ChainEnds::Reach);
    std::vector<Closure> closures;
    for (const std::vector<int>& from : this->Ways)
    {
      const Particle& here = this->Particles[from.front()];
      grid.visit(here.position.xyz, here.spacing,
        [&](std::size_t r) { this->offer(from.front(), reached[r][0], reached[r][1], closures); });
    }
    return closures;
  }

  /// \param particle at the end of a chain, if the way begins at a beginning; or the other way round
  void offer(int particle, std::size_t way, std::size_t steps, std::vector<Closure>& closures) const
  {
    const Particle& here = this->Particles[particle];
    const Particle& there = this->Particles[this->Ways[way][steps]];
    const int start = this->Ways[way].front();
    const bool isFromEnd = this->Surplus[start] > 0;
    const double h = std::min(here.spacing, there.spacing);
    const double distance = length(there.position - here.position) / h;
    if (isFromEnd == (this->Surplus[particle] > 0) || distance > ChainEnds::Reach ||
      !this->Pieces.areSame(here.location, there.location) ||
      dot(here.normal, there.normal) < ChainEnds::Cosine)
    {
      return;
    }
    const double cost = distance + ChainEnds::CostOfWayBack * static_cast<double>(steps);
    closures.push_back(
      { cost, isFromEnd ? start : particle, isFromEnd ? particle : start, way, steps });
  }

  void add(const Closure& closure)
  {
    std::vector<int> particles = this->Ways[closure.way];
    const bool isFromEnd = particles.front() == closure.end;
    const int last = isFromEnd ? closure.beginning : closure.end;
    particles.resize(closure.steps + 1);
    if (particles.back() != last)
    {
      particles.push_back(last);
    }
    if (!isFromEnd)
    {
      std::reverse(particles.begin(), particles.end());
    }
    for (std::size_t n = 0; n + 1 < particles.size(); ++n)
    {
      this->Edges.push_back({ particles[n], particles[n + 1] });
    }
  }

  const Buffer<Particle>& Particles;
  const SurfacePieces& Pieces;
  std::vector<Edge>& Edges;
  EdgeLinks Next, Previous;
  /// Edges that end at a particle less edges that begin there.
  std::vector<int> Surplus;
  /// From each end of a chain along the chain.
  std::vector<std::vector<int>> Ways;
};

/// Whether as many edges end at each particle as begin there, as where no field jumps.
bool areClosed(const std::vector<Edge>& edges, std::size_t particleCount)
{
  std::vector<int> surplus(particleCount, 0);
  for (const auto& [from, to] : edges)
  {
    --surplus[from];
    ++surplus[to];
  }
  return std::all_of(surplus.begin(), surplus.end(), [](int more) { return more == 0; });
}

} // namespace

void closeChains(const Distribution& distribution, std::vector<Edge>& edges)
{
  if (!areClosed(edges, distribution.particles.size()))
  {
    ChainCloser(distribution, edges).run();
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }
}

} // namespace hop
