#include "Topology/ElementSurface.h"

#include "Topology/LeafComplex.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hop
{
namespace
{

/// The place of a leaf's lower corner on a curve that passes every octant of an octant ... before the next one.
std::uint64_t leafOrder(const glm::ivec3& lower)
{
  std::uint64_t order = 0;
  for (int bit = LeafGrid::Depth - 1; bit >= 0; --bit)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      order = order << 1 | static_cast<std::uint64_t>(lower[axis] >> bit & 1);
    }
  }
  return order;
}

bool isEnd(int coordinate)
{
  return coordinate == 0 || coordinate == LeafGrid::Size;
}

/// The edge of the element's cube on which a point lies, or -1.
int cubeEdgeOf(const LeafPart& point)
{
  int corner = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (axis != point.axis())
    {
      if (!isEnd(point.lower()[axis]))
      {
        return -1;
      }
      corner |= (point.lower()[axis] > 0) << axis;
    }
  }
  const auto& edges = cubeEdges();
  return static_cast<int>(
    std::find_if(edges.begin(), edges.end(),
      [&](const CubeEdge& edge) { return edge.axis == point.axis() && edge.first == corner; }) -
    edges.begin());
}

/// An edge of a leaf in the cube.
std::array<glm::dvec3, 2> segmentOf(const LeafPart& edge)
{
  glm::ivec3 end = edge.lower();
  end[edge.axis()] += edge.size();
  return { LeafGrid::toCube(glm::dvec3(edge.lower())), LeafGrid::toCube(glm::dvec3(end)) };
}

/// Makes the pieces and curves of an element's surface.
class SurfaceJoiner
{
public:
  SurfaceJoiner(ElementSurface& surface, LeafComplex& complex)
    : Surface(surface)
    , Complex(complex)
  {
  }

  void join()
  {
    this->makePieces();
    this->listEdgePoints();
    for (int face = 0; face < 6; ++face)
    {
      this->makeCurves(face);
    }
  }

private:
  /// An end of the arc of a square.
  struct ArcEnd
  {
    int point = -1;
    /// Index in a face's list of arcs.
    int arc = -1;
  };

  SurfacePiece& pieceOf(int leaf) { return this->Surface.pieces[this->Surface.pieceOfLeaf[leaf]]; }

  void makePieces()
  {
    const int count = static_cast<int>(this->Surface.leaves.size());
    for (int leaf = 0; leaf < count; ++leaf)
    {
      const int first = this->Complex.firstLeaf(leaf);
      if (first == leaf)
      {
        this->Surface.pieces.emplace_back();
      }
      this->Surface.pieceOfLeaf.push_back(first == leaf
          ? static_cast<int>(this->Surface.pieces.size()) - 1
          : this->Surface.pieceOfLeaf[first]);
      this->pieceOf(leaf).eulerCharacteristic += 1;
      this->pieceOf(leaf).proven &= !this->Complex.isDoubtful(leaf);
    }
    for (const LeafComplex::Square& square : this->Complex.squares())
    {
      this->pieceOf(square.leaves[0]).eulerCharacteristic -= square.isDivided ? 0 : 1;
    }
    for (int point = 0; point < static_cast<int>(this->Complex.points().size()); ++point)
    {
      this->pieceOf(this->Complex.leafOfPoint(point)).eulerCharacteristic += 1;
    }
  }

  /// Numbers the points on edges of the cube along each edge.
  void listEdgePoints()
  {
    const auto& points = this->Complex.points();
    std::array<std::vector<std::pair<int, int>>, 12> onEdge; // place along the edge, and point
    for (int point = 0; point < static_cast<int>(points.size()); ++point)
    {
      const int edge = cubeEdgeOf(points[point]);
      if (edge >= 0)
      {
        onEdge[edge].emplace_back(points[point].lower()[points[point].axis()], point);
      }
    }
    this->EndOfPoint.resize(points.size());
    for (int e = 0; e < 12; ++e)
    {
      std::sort(onEdge[e].begin(), onEdge[e].end());
      const int count = static_cast<int>(onEdge[e].size());
      for (int n = 0; n < count; ++n)
      {
        CurveEnd& end = this->EndOfPoint[onEdge[e][n].second];
        end = this->endAt(e, n, count);
        end.segment = segmentOf(points[onEdge[e][n].second]);
      }
    }
  }

  /// The end of curves in a point on an edge of the cube.
  /// \param n the how-manieth point on the edge it is
  CurveEnd endAt(int edge, int n, int count)
  {
    const int first = this->Surface.shape.corners[cubeEdges()[edge].first];
    const int second = this->Surface.shape.corners[cubeEdges()[edge].second];
    const auto [less, more] = std::minmax(first, second);
    return { { less, more }, first < second ? n : count - 1 - n, count, this->Surface.pointCount++,
      {} };
  }

  void makeCurves(int face)
  {
    const int plane = face % 2 * LeafGrid::Size;
    std::vector<const LeafComplex::Square*> arcs;
    std::vector<ArcEnd> ends;
    for (const LeafComplex::Square& square : this->Complex.squares())
    {
      if (square.part.axis() == face / 2 && square.part.lower()[face / 2] == plane)
      {
        const Leaf& leaf = this->Surface.leaves[square.leaves[0]];
        for (const int edge : edgesOfCubeFace(square.face))
        {
          if (isCrossed(cubeEdges()[edge], leaf.signs))
          {
            ends.push_back(
              { this->Complex.pointOn(edgeOf(leaf, edge)), static_cast<int>(arcs.size()) });
          }
        }
        arcs.push_back(&square);
      }
    }
    std::sort(ends.begin(), ends.end(),
      [](const ArcEnd& a, const ArcEnd& b)
      { return std::pair(a.point, a.arc) < std::pair(b.point, b.arc); });
    this->joinArcs(face, arcs, ends);
  }

  /// \param ends sorted by their points
  void joinArcs(
    int face, const std::vector<const LeafComplex::Square*>& arcs, const std::vector<ArcEnd>& ends)
  {
    DisjointSets joined(arcs.size());
    std::vector<std::vector<int>> openPoints(arcs.size()); // of each curve, by its first arc
    for (std::size_t n = 1; n < ends.size(); ++n)
    {
      if (ends[n].point == ends[n - 1].point)
      {
        joined.unite(ends[n].arc, ends[n - 1].arc);
      }
    }
    for (std::size_t n = 0; n < ends.size(); ++n)
    {
      const bool isLast = n + 1 == ends.size() || ends[n + 1].point != ends[n].point;
      const bool isFirst = n == 0 || ends[n - 1].point != ends[n].point;
      if (isFirst && isLast)
      {
        openPoints[joined.root(ends[n].arc)].push_back(ends[n].point);
      }
    }
    std::vector<int> curveOfArc(arcs.size(), -1);
    for (int arc = 0; arc < static_cast<int>(arcs.size()); ++arc)
    {
      const int first = joined.root(arc);
      if (first == arc)
      {
        curveOfArc[arc] = static_cast<int>(this->Surface.curves.size());
        this->Surface.curves.push_back(this->newCurve(face, *arcs[arc], openPoints[arc]));
      }
      this->Surface.curves[curveOfArc[first]].leaves.push_back(arcs[arc]->leaves[0]);
    }
  }

  /// A curve that begins with an arc.
  /// \param open the points in which it ends
  FaceCurve newCurve(int face, const LeafComplex::Square& arc, const std::vector<int>& open)
  {
    FaceCurve curve;
    curve.face = face;
    curve.piece = this->Surface.pieceOfLeaf[arc.leaves[0]];
    curve.isClosed = open.empty();
    curve.isBroken = open.size() != 0 && open.size() != 2;
    for (std::size_t n = 0; n < open.size() && !curve.isBroken; ++n)
    {
      curve.ends[n] = this->EndOfPoint[open[n]];
      curve.isBroken = curve.ends[n].point < 0 || curve.ends[n].edge[0] == curve.ends[n].edge[1];
    }
    this->Surface.pieces[curve.piece].proven &= !curve.isBroken;
    const Leaf& leaf = this->Surface.leaves[arc.leaves[0]];
    for (const int edge : edgesOfCubeFace(arc.face))
    {
      if (isCrossed(cubeEdges()[edge], leaf.signs))
      {
        curve.segment = segmentOf(edgeOf(leaf, edge));
      }
    }
    return curve;
  }

  ElementSurface& Surface;
  LeafComplex& Complex;
  /// For each point of the complex; CurveEnd::point is -1 inside faces of the cube and inside the cube.
  std::vector<CurveEnd> EndOfPoint;
};

/// Square of the distance of a place from a box of the octree, in units of the smallest leaf.
double squaredDistance(const glm::ivec3& lower, int size, const glm::dvec3& place)
{
  const glm::dvec3 beyond = glm::max(
    glm::max(glm::dvec3(lower) - place, place - glm::dvec3(lower + size)), glm::dvec3(0.0));
  return glm::dot(beyond, beyond);
}

/// Searches the leaf that is nearest to a place: the leaves of an octant follow one another in the order of leafOrder().
/// Of leaves equally near it is the first.
class NearestLeaf
{
public:
  /// \param leaves in the order of leafOrder(), not empty; outlive it
  NearestLeaf(const std::vector<Leaf>& leaves, const glm::dvec3& place)
    : Leaves(leaves)
    , Place(place)
  {
    this->search({ glm::ivec3(0), LeafGrid::Size, 0, static_cast<int>(leaves.size()) });
  }

  int index() const { return this->Best; }

private:
  /// A box of the octree, and the leaves first to last - 1 in it.
  struct Octant
  {
    glm::ivec3 lower;
    int size;
    int first;
    int last;
  };

  void search(const Octant& octant)
  {
    // Fewer leaves are looked at one by one. It changes the time alone.
    constexpr int few = 16;
    if (octant.first == octant.last ||
      squaredDistance(octant.lower, octant.size, this->Place) > this->Least)
    {
      return;
    }
    if (octant.last - octant.first > few)
    {
      this->searchOctants(octant);
      return;
    }
    for (int n = octant.first; n < octant.last; ++n)
    {
      const double distance =
        squaredDistance(this->Leaves[n].lower, this->Leaves[n].size, this->Place);
      if (distance < this->Least || (distance == this->Least && n < this->Best))
      {
        this->Least = distance;
        this->Best = n;
      }
    }
  }

  /// The octant on the side of the place first: what is found there leaves most of the others out.
  void searchOctants(const Octant& octant)
  {
    const int half = octant.size / 2;
    const auto octantOf = [half](const Leaf& leaf)
    {
      const glm::ivec3 upper = glm::min(leaf.lower & half, 1);
      return 4 * upper.x + 2 * upper.y + upper.z;
    };
    std::array<int, 9> begin{};
    begin.front() = octant.first;
    begin.back() = octant.last;
    for (int o = 1; o < 8; ++o)
    {
      begin[o] = static_cast<int>(std::partition_point(this->Leaves.begin() + begin[o - 1],
                                    this->Leaves.begin() + octant.last,
                                    [&](const Leaf& leaf) { return octantOf(leaf) < o; }) -
        this->Leaves.begin());
    }
    const glm::dvec3 middle(octant.lower + half);
    const int nearest =
      4 * (this->Place.x > middle.x) + 2 * (this->Place.y > middle.y) + (this->Place.z > middle.z);
    for (int n = 0; n < 8; ++n)
    {
      const int o = n ^ nearest;
      const glm::ivec3 upper(o >> 2, o >> 1 & 1, o & 1);
      this->search({ octant.lower + half * upper, half, begin[o], begin[o + 1] });
    }
  }

  const std::vector<Leaf>& Leaves;
  glm::dvec3 Place;
  double Least = std::numeric_limits<double>::infinity();
  int Best = 0;
};

} // namespace

int ElementSurface::leafAt(const glm::dvec3& t) const
{
  if (this->leaves.empty())
  {
    return -1;
  }
  const glm::dvec3 place = LeafGrid::fromCube(t);
  const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(place)), 0, LeafGrid::Size - 1);
  const std::uint64_t order = leafOrder(cell);
  const auto next = std::upper_bound(this->leaves.begin(), this->leaves.end(), order,
    [](std::uint64_t wanted, const Leaf& leaf) { return wanted < leafOrder(leaf.lower); });
  const auto last = next == this->leaves.begin() ? next : next - 1;
  return squaredDistance(last->lower, last->size, place) > 0.0
    ? NearestLeaf(this->leaves, place).index()
    : static_cast<int>(last - this->leaves.begin());
}

int ElementSurface::pieceAt(const glm::dvec3& t) const
{
  const int leaf = this->leafAt(t);
  return leaf < 0 ? -1 : this->pieceOfLeaf[leaf];
}

int ElementSurface::curveAt(int face, const glm::dvec3& t) const
{
  const int leaf = this->leafAt(t);
  const auto found = std::find_if(this->curves.begin(), this->curves.end(),
    [&](const FaceCurve& curve)
    {
      return curve.face == face &&
        std::find(curve.leaves.begin(), curve.leaves.end(), leaf) != curve.leaves.end();
    });
  return found == this->curves.end() ? -1 : static_cast<int>(found - this->curves.begin());
}

namespace
{

/// The surface in one element.
/// \param leavesOf leavesOf(cube, tests, partsOfCell) finds the leaves, or nothing where that takes too long
/// \return nothing where leavesOf has returned it
template <class LeavesOf>
std::optional<ElementSurface> surfaceFrom(const ElementMesh& mesh, int element, double isovalue,
  std::optional<LeafTests>& tests, const ParallelFor& parallelFor, const LeavesOf& leavesOf)
{
  const ElementCube cube = elementCube(mesh, element, isovalue);
  if (!cube.isFinite())
  {
    ElementSurface unknown;
    unknown.isResolved = false;
    return unknown;
  }
  if (!tests || tests->degrees() != cube.degrees)
  {
    tests.emplace(cube.degrees);
  }
  std::optional<ElementLeaves> leaves = leavesOf(cube, *tests, mesh.elements[element].partsOfCell);
  if (!leaves)
  {
    return std::nullopt;
  }
  ElementSurface surface = joinLeaves(cube.shape, std::move(*leaves), parallelFor);
  surface.isLifted = cube.isLifted;
  return surface;
}

} // namespace

ElementSurface findElementSurface(const ElementMesh& mesh, int element, double isovalue,
  std::optional<LeafTests>& tests, const ParallelFor& parallelFor)
{
  return *surfaceFrom(mesh, element, isovalue, tests, parallelFor,
    [&](const ElementCube& cube, const LeafTests& ofCube, int partsOfCell)
    { return std::optional(findLeaves(cube, ofCube, partsOfCell, parallelFor)); });
}

std::vector<ElementSurface> findElementSurfaces(const ElementMesh& mesh,
  const std::vector<int>& elements, double isovalue, const ParallelFor& parallelFor)
{
  std::vector<ElementSurface> surfaces(elements.size());
  std::vector<char> takesLong(elements.size(), 0);
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(elements.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::optional<LeafTests> tests;
      for (std::ptrdiff_t n = begin; n < end; ++n)
      {
        std::optional<ElementSurface> surface =
          surfaceFrom(mesh, elements[n], isovalue, tests, {}, findFewLeaves);
        takesLong[n] = !surface;
        surfaces[n] = surface ? std::move(*surface) : ElementSurface();
      }
    });
  std::optional<LeafTests> tests;
  for (std::size_t n = 0; n < elements.size(); ++n)
  {
    if (takesLong[n] != 0)
    {
      surfaces[n] = findElementSurface(mesh, elements[n], isovalue, tests, parallelFor);
    }
  }
  return surfaces;
}

ElementSurface joinLeaves(
  const CubeShape& shape, ElementLeaves leaves, const ParallelFor& parallelFor)
{
  ElementSurface surface;
  surface.shape = shape;
  surface.isResolved = leaves.unresolved.empty();
  std::sort(leaves.discs.begin(), leaves.discs.end(),
    [](const Leaf& a, const Leaf& b) { return leafOrder(a.lower) < leafOrder(b.lower); });
  if (!leaves.discs.empty())
  {
    askCaller(parallelFor);
    LeafComplex complex(leaves);
    askCaller(parallelFor);
    surface.leaves = std::move(leaves.discs);
    SurfaceJoiner(surface, complex).join();
  }
  return surface;
}

} // namespace hop
