#include "Topology/LeafTests.h"

#include "Support/DisjointSets.h"

#include <algorithm>
#include <cmath>

namespace hop
{
namespace
{

std::array<CubeEdge, 12> makeEdges()
{
  std::array<CubeEdge, 12> edges{};
  int count = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      if ((corner >> axis & 1) == 0)
      {
        edges[count++] = { axis, corner, corner | 1 << axis };
      }
    }
  }
  return edges;
}

std::array<std::array<int, 4>, 6> makeFaceEdges()
{
  std::array<std::array<int, 4>, 6> result{};
  for (int face = 0; face < 6; ++face)
  {
    int count = 0;
    for (int e = 0; e < 12; ++e)
    {
      const CubeEdge& edge = cubeEdges()[e];
      if (edge.axis != face / 2 && (edge.first >> face / 2 & 1) == face % 2)
      {
        result[face][count++] = e;
      }
    }
  }
  return result;
}

/// Number of closed curves that the arcs in the faces make; -1 if a face may hold two arcs.
int countCurves(std::uint8_t signs)
{
  DisjointSets curves(12);
  std::array<bool, 12> crossed{};
  for (int face = 0; face < 6; ++face)
  {
    std::vector<int> ends;
    for (const int e : edgesOfCubeFace(face))
    {
      crossed[e] = isCrossed(cubeEdges()[e], signs);
      if (crossed[e])
      {
        ends.push_back(e);
      }
    }
    if (ends.size() == 4)
    {
      return -1;
    }
    if (ends.size() == 2)
    {
      curves.unite(ends[0], ends[1]);
    }
  }
  int count = 0;
  for (int e = 0; e < 12; ++e)
  {
    count += crossed[e] && curves.root(e) == e;
  }
  return count;
}

int curvesOf(std::uint8_t signs)
{
  static const std::vector<int> table = []
  {
    std::vector<int> counts;
    counts.reserve(256);
    for (int s = 0; s < 256; ++s)
    {
      counts.push_back(countCurves(static_cast<std::uint8_t>(s)));
    }
    return counts;
  }();
  return table[signs];
}

/// Indices of coefficients in the order of the storage, of which some coordinates are fixed.
/// \param lower, upper first and last lattice point
std::vector<int> latticePart(
  const Degrees& degrees, const std::array<int, 3>& lower, const std::array<int, 3>& upper)
{
  std::vector<int> points;
  for (int k = lower[2]; k <= upper[2]; ++k)
  {
    for (int j = lower[1]; j <= upper[1]; ++j)
    {
      for (int i = lower[0]; i <= upper[0]; ++i)
      {
        points.push_back(coefficientIndex(Domain::Hexahedron, degrees, { i, j, k }));
      }
    }
  }
  return points;
}

/// The lattice point of a corner of the cube.
std::array<int, 3> latticeCorner(const Degrees& degrees, int corner)
{
  return { (corner & 1) * degrees[0], (corner >> 1 & 1) * degrees[1], (corner >> 2) * degrees[2] };
}

/// Whether coefficients along an edge first are negative, then rise through zero, then are positive: for each level
/// within the slack they change their sign once at most, which allows one zero. By `sign` -1 the same for those that
/// fall.
bool changesOnce(
  const std::vector<double>& values, const std::vector<int>& points, double slack, double sign)
{
  double highest = -slack; // of the values from the first one that is not negative
  bool isNegative = true;
  for (const int point : points)
  {
    const double value = sign * values[point];
    isNegative = isNegative && value < -slack;
    if (!isNegative && value < std::min(highest, slack))
    {
      return false;
    }
    highest = std::max(highest, value);
  }
  return true;
}

/// Whether all of some coefficients are above the slack, or all below.
bool isOneSided(const std::vector<double>& values, const std::vector<int>& points, double slack)
{
  const double sign = values[points.front()] > 0.0 ? 1.0 : -1.0;
  return std::all_of(
    points.begin(), points.end(), [&](int point) { return sign * values[point] > slack; });
}

/// The lift is two slacks; rounding leaves it below this.
double mostLifted(double slack)
{
  return 2.5 * slack;
}

/// The field as it was before zeros were lifted (ElementCube.h): where it stands still at a zero, it is singular there.
std::vector<double> withoutLift(std::vector<double> values, double slack)
{
  const double most = mostLifted(slack);
  std::replace_if(
    values.begin(), values.end(), [=](double value) { return std::abs(value) <= most; }, 0.0);
  return values;
}

} // namespace

const std::array<CubeEdge, 12>& cubeEdges()
{
  static const std::array<CubeEdge, 12> edges = makeEdges();
  return edges;
}

const std::array<int, 4>& edgesOfCubeFace(int face)
{
  static const std::array<std::array<int, 4>, 6> edges = makeFaceEdges();
  return edges[face];
}

LeafTests::LeafTests(const Degrees& degrees)
  : ItsDegrees(degrees)
  , Monotone(Domain::Hexahedron, degrees)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::array<int, 3> at = latticeCorner(degrees, corner);
    this->Corners[corner] = coefficientIndex(Domain::Hexahedron, degrees, { at[0], at[1], at[2] });
  }
  for (const CubeEdge& edge : cubeEdges())
  {
    this->Edges.push_back(latticePart(
      degrees, latticeCorner(degrees, edge.first), latticeCorner(degrees, edge.second)));
  }
  for (int face = 0; face < 6; ++face)
  {
    Degrees flat = degrees;
    flat[face / 2] = 0;
    std::array<int, 3> lower{}, upper = latticeCorner(degrees, 7);
    lower[face / 2] = upper[face / 2] = face % 2 == 0 ? 0 : degrees[face / 2];
    this->Faces.push_back(
      { MonotoneTest(Domain::Hexahedron, flat), latticePart(degrees, lower, upper) });
  }
}

LeafSurface LeafTests::examine(
  const std::vector<double>& values, double slack, std::uint8_t& signs) const
{
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  if (*lowest > slack || *highest < -slack)
  {
    return LeafSurface::Empty;
  }
  signs = 0;
  // Whether a corner is zero, but was lifted.
  LeafSurface undecided = LeafSurface::Undecided;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double value = values[this->Corners[corner]];
    if (!(std::abs(value) > slack))
    {
      return LeafSurface::ZeroAtCorner;
    }
    if (std::abs(value) <= mostLifted(slack))
    {
      undecided = LeafSurface::ZeroAtCorner;
    }
    signs = static_cast<std::uint8_t>(signs | (value > 0.0) << corner);
  }
  const int curves = curvesOf(signs);
  if (curves != 0 && curves != 1)
  {
    return undecided;
  }
  for (int e = 0; e < 12; ++e)
  {
    if (isCrossed(cubeEdges()[e], signs) ? !changesOnce(values, this->Edges[e], slack,
                                             signs >> cubeEdges()[e].second & 1 ? 1.0 : -1.0)
                                         : !isOneSided(values, this->Edges[e], slack))
    {
      return undecided;
    }
  }
  const std::vector<double> given = withoutLift(values, slack);
  if (!this->Monotone.rises(given) ||
    !std::all_of(this->Faces.begin(), this->Faces.end(),
      [&](const Face& face)
      { return isOneSided(values, face.points, slack) || this->isOneArc(face, given); }))
  {
    return undecided;
  }
  return curves == 0 ? LeafSurface::Empty : LeafSurface::Disc;
}

/// Whether the zeros in a face are one arc at most, and no closed curve.
bool LeafTests::isOneArc(const Face& face, const std::vector<double>& values) const
{
  std::vector<double> onFace;
  onFace.reserve(face.points.size());
  for (const int point : face.points)
  {
    onFace.push_back(values[point]);
  }
  return face.monotone.rises(onFace);
}

} // namespace hop
