#include "Topology/SurfaceTopology.h"

#include "Support/DisjointSets.h"
#include "Topology/CurveMatching.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace hop
{
namespace
{

/// A curve, by its element and its number there.
struct CurveReference
{
  int element = -1;
  int curve = -1;

  bool operator==(const CurveReference& other) const
  {
    return this->element == other.element && this->curve == other.curve;
  }
};

/// Joins the surfaces of elements: pieces at curves, and curves in points on edges of elements. Pieces, curves and
/// points of all elements are numbered through.
class ElementJoiner
{
public:
  ElementJoiner(const ElementMesh& mesh, double isovalue,
    const std::vector<ElementSurface>& surfaces, std::vector<std::vector<CurveMatch>> matches)
    : Mesh(mesh)
    , Isovalue(isovalue)
    , Surfaces(surfaces)
    , Matches(std::move(matches))
    , FirstPiece(numbersOf([](const ElementSurface& s) { return s.pieces.size(); }))
    , FirstPoint(
        numbersOf([](const ElementSurface& s) { return static_cast<std::size_t>(s.pointCount); }))
    , Pieces(FirstPiece.back())
    , Points(FirstPoint.back())
    , PieceOfPoint(FirstPoint.back(), -1)
    , Doubtful(FirstPiece.back(), 0)
  {
  }

  void join(SurfaceTopology& topology)
  {
    this->forCurves([this](int element, const FaceCurve& curve, const CurveMatch& match)
      { this->joinAt(element, curve, match); });
    this->joinDivided();
    this->listComponents(topology);
    this->sumEulerCharacteristics(topology);
    this->countBoundaryLoops(topology);
  }

private:
  template <class Count>
  std::vector<int> numbersOf(const Count& count) const
  {
    std::vector<int> first{ 0 };
    for (const ElementSurface& surface : this->Surfaces)
    {
      first.push_back(first.back() + static_cast<int>(count(surface)));
    }
    return first;
  }

  /// Calls use(element, curve, match) for all curves.
  template <class Use>
  void forCurves(const Use& use)
  {
    for (int element = 0; element < static_cast<int>(this->Surfaces.size()); ++element)
    {
      const auto& curves = this->Surfaces[element].curves;
      for (std::size_t n = 0; n < curves.size(); ++n)
      {
        use(element, curves[n], this->Matches[element][n]);
      }
    }
  }

  int pieceOf(int element, const FaceCurve& curve) const
  {
    return this->FirstPiece[element] + curve.piece;
  }

  int pointOf(int element, const FaceCurve& curve, int end) const
  {
    return this->FirstPoint[element] + curve.ends[end].point;
  }

  void joinAt(int element, const FaceCurve& curve, const CurveMatch& match)
  {
    const int piece = this->pieceOf(element, curve);
    const bool hasEnds = !curve.isClosed && !curve.isBroken;
    for (int end = 0; end < 2 && hasEnds; ++end)
    {
      this->PieceOfPoint[this->pointOf(element, curve, end)] = piece;
    }
    if (match.kind == CurveMatch::Joined)
    {
      const FaceCurve& other = this->Surfaces[match.element].curves[match.curve];
      const CurveMatch& back = this->Matches[match.element][match.curve];
      this->Pieces.unite(piece, this->pieceOf(match.element, other));
      this->Doubtful[piece] |= back.kind != CurveMatch::Joined || back.element != element ||
        &this->Surfaces[element].curves[back.curve] != &curve;
      for (int end = 0; end < 2 && hasEnds; ++end)
      {
        this->Points.unite(this->pointOf(element, curve, end),
          this->pointOf(match.element, other, end ^ match.firstEnd));
      }
    }
    else if (match.kind == CurveMatch::Collapsed)
    {
      this->Points.unite(this->pointOf(element, curve, 0), this->pointOf(element, curve, 1));
    }
    this->Doubtful[piece] |= match.kind == CurveMatch::Unknown;
  }

  /// A curve in a face beside hanging nodes, and the curve of the larger face whose part it is.
  struct Part
  {
    CurveReference whole;
    CurveReference part;
  };

  const FaceCurve& curveOf(const CurveReference& which) const
  {
    return this->Surfaces[which.element].curves[which.curve];
  }

  int pieceOf(const CurveReference& which) const
  {
    return this->pieceOf(which.element, this->curveOf(which));
  }

  int pointOf(const CurveReference& which, int end)
  {
    return this->Points.root(this->pointOf(which.element, this->curveOf(which), end));
  }

  /// Joins the curves of larger faces with their parts.
  void joinDivided()
  {
    std::vector<Part> parts;
    for (int element = 0; element < static_cast<int>(this->Surfaces.size()); ++element)
    {
      for (int curve = 0; curve < static_cast<int>(this->Matches[element].size()); ++curve)
      {
        const CurveMatch& match = this->Matches[element][curve];
        if (match.kind == CurveMatch::PartOf)
        {
          parts.push_back({ { match.element, match.curve }, { element, curve } });
        }
        else if (match.kind == CurveMatch::Divided)
        {
          parts.push_back({ { element, curve }, {} });
        }
      }
    }
    std::stable_sort(parts.begin(), parts.end(),
      [](const Part& a, const Part& b) {
        return std::tie(a.whole.element, a.whole.curve) < std::tie(b.whole.element, b.whole.curve);
      });
    for (auto first = parts.begin(), next = first; first != parts.end(); first = next)
    {
      std::vector<CurveReference> ofWhole;
      for (next = first; next != parts.end() && next->whole == first->whole; ++next)
      {
        if (next->part.element >= 0)
        {
          ofWhole.push_back(next->part);
        }
      }
      this->joinParts(first->whole, ofWhole);
    }
  }

  void joinParts(const CurveReference& whole, const std::vector<CurveReference>& parts)
  {
    bool fits = this->Matches[whole.element][whole.curve].kind == CurveMatch::Divided;
    for (const CurveReference& part : parts)
    {
      this->Pieces.unite(this->pieceOf(whole), this->pieceOf(part));
    }
    const FaceCurve& curve = this->curveOf(whole);
    const bool isOneLoop = parts.size() == 1 && this->curveOf(parts[0]).isClosed;
    if (fits && !(curve.isClosed && isOneLoop))
    {
      const auto ends = this->endsOfPath(parts);
      fits = ends && ends->empty() == curve.isClosed;
      fits = fits && (curve.isClosed || this->joinEnds(whole, *ends));
    }
    this->Doubtful[this->pieceOf(whole)] |= !fits;
  }

  /// An end of a curve.
  struct End
  {
    CurveReference curve;
    int end = 0;
  };

  /// The two ends of a path of open curves; none if the path is closed.
  /// \return nothing if the curves are not one path
  std::optional<std::vector<End>> endsOfPath(const std::vector<CurveReference>& parts)
  {
    std::map<int, std::vector<std::pair<End, int>>> atPoint; // ends, and the number of the part
    for (int n = 0; n < static_cast<int>(parts.size()); ++n)
    {
      for (int end = 0; end < 2 && !this->curveOf(parts[n]).isClosed; ++end)
      {
        atPoint[this->pointOf(parts[n], end)].push_back({ { parts[n], end }, n });
      }
    }
    DisjointSets joined(parts.size());
    std::vector<End> open;
    bool fits = !parts.empty();
    for (const auto& [point, ends] : atPoint)
    {
      fits = fits && ends.size() <= 2;
      joined.unite(ends.front().second, ends.back().second);
      if (ends.size() == 1)
      {
        open.push_back(ends.front().first);
      }
    }
    for (int n = 0; n < static_cast<int>(parts.size()); ++n)
    {
      fits = fits && joined.root(n) == 0 && !this->curveOf(parts[n]).isClosed;
    }
    return fits && (open.empty() || open.size() == 2) ? std::optional(open) : std::nullopt;
  }

  WorldPoint positionOf(const End& end) const
  {
    return positionOfEnd(this->Mesh, this->Isovalue, end.curve.element,
      this->Surfaces[end.curve.element], this->curveOf(end.curve).ends[end.end]);
  }

  /// Unites the ends of a curve with those of the path that it consists of, where they are in the same places.
  bool joinEnds(const CurveReference& whole, const std::vector<End>& path)
  {
    // Distance between ends in one place, as a share of the distance between the ends of the curve: more than digits of
    // files. Larger: ends that are far apart count as one; smaller: short curves are in doubt.
    constexpr double samePlace = 1e-2;
    std::array<std::array<double, 2>, 2> apart{};
    for (int n = 0; n < 2; ++n)
    {
      for (int m = 0; m < 2; ++m)
      {
        apart[n][m] = length(this->positionOf({ whole, n }) - this->positionOf(path[m]));
      }
    }
    const int swap = apart[0][0] + apart[1][1] <= apart[0][1] + apart[1][0] ? 0 : 1;
    for (int n = 0; n < 2; ++n)
    {
      this->Points.unite(
        this->pointOf(whole, n), this->pointOf(path[n ^ swap].curve, path[n ^ swap].end));
    }
    return apart[0][swap] + apart[1][1 - swap] <= samePlace * (apart[0][1 - swap] + apart[1][swap]);
  }

  SurfaceComponent& componentOf(SurfaceTopology& topology, int piece)
  {
    return topology.components[this->ComponentOfPiece[this->Pieces.root(piece)]];
  }

  void listComponents(SurfaceTopology& topology)
  {
    this->ComponentOfPiece.resize(this->FirstPiece.back());
    for (int element = 0; element < static_cast<int>(this->Surfaces.size()); ++element)
    {
      std::vector<int>& components = topology.componentOfPiece.emplace_back();
      for (int piece = this->FirstPiece[element]; piece < this->FirstPiece[element + 1]; ++piece)
      {
        const int root = this->Pieces.root(piece);
        if (root == piece)
        {
          this->ComponentOfPiece[piece] = static_cast<int>(topology.components.size());
          topology.components.push_back({ 0, 0, true, element });
        }
        const SurfacePiece& what =
          this->Surfaces[element].pieces[piece - this->FirstPiece[element]];
        components.push_back(this->ComponentOfPiece[root]);
        SurfaceComponent& component = topology.components[this->ComponentOfPiece[root]];
        component.eulerCharacteristic += what.eulerCharacteristic;
        component.proven &= what.proven && !this->Doubtful[piece];
      }
    }
  }

  /// Without its boundary, which is circles, a piece counts as with it. Open curves count -1, closed ones 0, points 1.
  void sumEulerCharacteristics(SurfaceTopology& topology)
  {
    this->forCurves(
      [&](int element, const FaceCurve& curve, const CurveMatch& match)
      {
        const int piece = this->pieceOf(element, curve);
        const bool isFirst = match.kind != CurveMatch::Joined ||
          piece < this->pieceOf(match.element, this->Surfaces[match.element].curves[match.curve]);
        const bool counts =
          match.kind != CurveMatch::Collapsed && match.kind != CurveMatch::Divided;
        if (!curve.isClosed && counts && isFirst)
        {
          this->componentOf(topology, piece).eulerCharacteristic -= 1;
        }
      });
    for (int point = 0; point < this->FirstPoint.back(); ++point)
    {
      if (this->Points.root(point) == point && this->PieceOfPoint[point] >= 0)
      {
        this->componentOf(topology, this->PieceOfPoint[point]).eulerCharacteristic += 1;
      }
    }
  }

  void countBoundaryLoops(SurfaceTopology& topology)
  {
    DisjointSets loops(this->FirstPoint.back());
    std::vector<int> degree(this->FirstPoint.back(), 0);
    this->forCurves(
      [&](int element, const FaceCurve& curve, const CurveMatch& match)
      {
        if (match.kind == CurveMatch::End && curve.isClosed)
        {
          this->componentOf(topology, this->pieceOf(element, curve)).boundaryLoops += 1;
        }
        else if (match.kind == CurveMatch::End && !curve.isBroken)
        {
          const int first = this->Points.root(this->pointOf(element, curve, 0));
          const int second = this->Points.root(this->pointOf(element, curve, 1));
          ++degree[first];
          ++degree[second];
          loops.unite(first, second);
        }
      });
    for (int point = 0; point < this->FirstPoint.back(); ++point)
    {
      if (degree[point] > 0)
      {
        SurfaceComponent& component = this->componentOf(topology, this->PieceOfPoint[point]);
        component.proven &= degree[point] == 2;
        component.boundaryLoops += loops.root(point) == point;
      }
    }
  }

  const ElementMesh& Mesh;
  double Isovalue;
  const std::vector<ElementSurface>& Surfaces;
  std::vector<std::vector<CurveMatch>> Matches;
  /// Number of the first piece and point of each element; last, how many there are.
  std::vector<int> FirstPiece;
  std::vector<int> FirstPoint;
  DisjointSets Pieces;
  DisjointSets Points;
  std::vector<int> PieceOfPoint;
  std::vector<char> Doubtful;
  std::vector<int> ComponentOfPiece;
};

std::vector<std::int64_t> unresolvedCells(
  const ElementMesh& mesh, const std::vector<ElementSurface>& surfaces)
{
  std::vector<std::int64_t> cells;
  for (std::size_t e = 0; e < surfaces.size(); ++e)
  {
    if (!surfaces[e].isResolved)
    {
      cells.push_back(mesh.elements[e].cell);
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

} // namespace

bool SurfaceTopology::isProven() const
{
  return this->unresolvedCells.empty() &&
    std::all_of(this->components.begin(), this->components.end(),
      [](const SurfaceComponent& component) { return component.proven; });
}

int SurfaceTopology::componentAt(const Location& location) const
{
  const ElementSurface& surface = this->surfaces[location.element];
  const int piece = surface.pieceAt(surface.shape.inCube(location.u));
  if (piece < 0)
  {
    return surface.isLifted ? AnyComponent : NoComponent;
  }
  return this->componentOfPiece[location.element][piece];
}

SurfaceTopology findTopology(const ElementMesh& mesh, double isovalue, const FaceLocator* locator,
  const ParallelFor& parallelFor)
{
  SurfaceTopology topology;
  std::vector<int> all(mesh.elements.size());
  std::iota(all.begin(), all.end(), 0);
  topology.surfaces = findElementSurfaces(mesh, all, isovalue, parallelFor);
  std::vector<std::vector<CurveMatch>> matches(mesh.elements.size());
  const SurfaceOfElement surfaceOf = [&](int element) -> const ElementSurface&
  { return topology.surfaces[element]; };
  forAll(parallelFor, mesh.elements.size(),
    [&](std::size_t e)
    { matches[e] = matchCurves(mesh, isovalue, static_cast<int>(e), surfaceOf, locator); });
  ElementJoiner(mesh, isovalue, topology.surfaces, std::move(matches)).join(topology);
  topology.unresolvedCells = unresolvedCells(mesh, topology.surfaces);
  return topology;
}

} // namespace hop
