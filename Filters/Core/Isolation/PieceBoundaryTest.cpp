#include "Isolation/PieceBoundaryTest.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

/// Steps on the lattice from one corner to another.
struct Walk
{
  LatticePoint start;
  LatticePoint step;
  int count = 0;
};

Walk walkBetween(Domain domain, const Degrees& degrees, int from, int to)
{
  const LatticePoint a = cornerLatticePoint(domain, degrees, from);
  const LatticePoint b = cornerLatticePoint(domain, degrees, to);
  const int n = std::max({ std::abs(b.i - a.i), std::abs(b.j - a.j), std::abs(b.k - a.k) });
  return { a, { (b.i - a.i) / n, (b.j - a.j) / n, (b.k - a.k) / n }, n };
}

/// Whether all values at some lattice points have one sign, up to the slack.
bool areOneSided(
  const std::vector<double>& values, const std::vector<int>& points, bool positive, double slack)
{
  return std::all_of(points.begin(), points.end(),
    [&](int point) { return positive ? values[point] >= -slack : values[point] <= slack; });
}

/// Whether values along an edge only rise, or only fall, up to the slack.
bool areMonotone(
  const std::vector<double>& values, const std::vector<int>& points, bool rising, double slack)
{
  for (std::size_t n = 1; n < points.size(); ++n)
  {
    const double change = values[points[n]] - values[points[n - 1]];
    if ((rising ? change : -change) < -slack)
    {
      return false;
    }
  }
  return true;
}

} // namespace

PieceBoundaryTest::PieceBoundaryTest(Domain domain, const Degrees& degrees)
  : ItsDomain(domain)
  , ItsDegrees(degrees)
{
  for (const Face& face : facts(domain).faces)
  {
    const Walk across = walkBetween(domain, degrees, face.corners[0], face.corners[1]);
    const Walk up =
      walkBetween(domain, degrees, face.corners[0], face.corners[face.cornerCount - 1]);
    const Domain flat = face.cornerCount == 4 ? Domain::Hexahedron : Domain::Wedge;
    const Degrees flatDegrees{ across.count, up.count, 1 };
    FaceLattice lattice{ MonotoneTest(flat, flatDegrees), {}, {} };
    for (const LatticePoint& p : latticePoints(flat, flatDegrees))
    {
      lattice.points.push_back(coefficientIndex(domain, degrees,
        { across.start.i + p.i * across.step.i + p.j * up.step.i,
          across.start.j + p.i * across.step.j + p.j * up.step.j,
          across.start.k + p.i * across.step.k + p.j * up.step.k }));
    }
    this->addEdges(face, lattice);
    this->Faces.push_back(std::move(lattice));
  }
}

/// Lists the edges of a face, and adds the unknown ones to all edges.
void PieceBoundaryTest::addEdges(const Face& face, FaceLattice& lattice)
{
  for (int c = 0; c < face.cornerCount; ++c)
  {
    const int next = face.corners[(c + 1) % face.cornerCount];
    const std::array<int, 2> corners{ std::min(face.corners[c], next),
      std::max(face.corners[c], next) };
    const auto known = std::find_if(this->Edges.begin(), this->Edges.end(),
      [&](const EdgeLattice& edge) { return edge.corners == corners; });
    lattice.edges.push_back(static_cast<int>(known - this->Edges.begin()));
    if (known != this->Edges.end())
    {
      continue;
    }
    EdgeLattice edge{ corners, {} };
    const Walk walk = walkBetween(this->ItsDomain, this->ItsDegrees, corners[0], corners[1]);
    for (int n = 0; n <= walk.count; ++n)
    {
      edge.points.push_back(coefficientIndex(this->ItsDomain, this->ItsDegrees,
        { walk.start.i + n * walk.step.i, walk.start.j + n * walk.step.j,
          walk.start.k + n * walk.step.k }));
    }
    this->Edges.push_back(std::move(edge));
  }
}

bool PieceBoundaryTest::isCrossedOnce(const std::vector<double>& values, double slack) const
{
  const std::optional<std::vector<char>> crossed = this->crossedEdges(values, slack);
  if (!crossed)
  {
    return false;
  }
  DisjointSets curves(this->Edges.size());
  for (const FaceLattice& face : this->Faces)
  {
    if (!uniteEdges(face, *crossed, values, slack, curves))
    {
      return false;
    }
  }
  int count = 0;
  for (int e = 0; e < static_cast<int>(this->Edges.size()); ++e)
  {
    count += (*crossed)[e] && curves.root(e) == e;
  }
  return count <= 1;
}

/// Marks the edges that hold one zero.
/// \return nothing if an edge may hold more than one
std::optional<std::vector<char>> PieceBoundaryTest::crossedEdges(
  const std::vector<double>& values, double slack) const
{
  std::vector<char> crossed(this->Edges.size(), 0);
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    const std::vector<int>& points = this->Edges[e].points;
    const bool start = values[points.front()] >= 0.0;
    const bool end = values[points.back()] >= 0.0;
    crossed[e] = start != end;
    if (crossed[e] ? !areMonotone(values, points, end, slack)
                   : !areOneSided(values, points, end, slack))
    {
      return std::nullopt;
    }
  }
  return crossed;
}

/// Unites the two edges of a face in which its curve of zeros ends.
/// \return whether the face holds one curve of zeros at most, and no closed one
bool PieceBoundaryTest::uniteEdges(const FaceLattice& face, const std::vector<char>& crossed,
  const std::vector<double>& values, double slack, DisjointSets& curves)
{
  std::array<int, 4> ends{};
  int count = 0;
  for (const int edge : face.edges)
  {
    ends[count] = edge;
    count += crossed[edge];
  }
  if (count == 0 && areOneSided(values, face.points, values[face.points.front()] >= 0.0, slack))
  {
    return true;
  }
  if (count > 2)
  {
    return false;
  }
  std::vector<double> onFace(face.points.size());
  std::transform(face.points.begin(), face.points.end(), onFace.begin(),
    [&](int point) { return values[point]; });
  if (!face.monotone.rises(onFace))
  {
    return false;
  }
  if (count > 0)
  {
    curves.unite(ends[0], ends[1]);
  }
  return true;
}

} // namespace hop
