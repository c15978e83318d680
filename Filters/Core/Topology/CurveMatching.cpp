#include "Topology/CurveMatching.h"

#include "Topology/CoarserFace.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace hop
{
namespace
{

double fieldAt(const ElementMesh& mesh, const Location& location)
{
  return evaluateGradient(mesh.form(location.element), location.u).value.w;
}

/// A point of the surface on a segment of an element's cube that holds one, by bisection.
Location pointOn(const ElementMesh& mesh, double isovalue, int element, const CubeShape& shape,
  std::array<glm::dvec3, 2> segment)
{
  constexpr int steps = 50; // as many as doubles have digits
  const auto at = [&](const glm::dvec3& t) { return Location{ element, shape.inElement(t) }; };
  const bool isPositive = fieldAt(mesh, at(segment[0])) > isovalue;
  for (int step = 0; step < steps; ++step)
  {
    const glm::dvec3 middle = 0.5 * (segment[0] + segment[1]);
    const bool isSame = (fieldAt(mesh, at(middle)) > isovalue) == isPositive;
    segment[isSame ? 0 : 1] = middle;
  }
  return at(segment[0]);
}

/// Whether the fields on two sides of a face agree at places that determine polynomials of both degrees.
/// \param behind behind(u) is the place on the other side
template <class Behind>
bool fieldsAgree(const ElementMesh& mesh, int element, int face, int other, const Behind& behind)
{
  const auto degreeOf = [&](int e)
  {
    const Degrees& degrees = mesh.elements[e].degrees;
    return *std::max_element(degrees.begin(), degrees.end());
  };
  const auto rangeOf = [&](int e)
  {
    const Range range = fieldRange(mesh.form(e));
    return range.upper - range.lower;
  };
  const Face& what = mesh.face(element, face);
  const int n = std::max(degreeOf(element), degreeOf(other));
  double largest = 0.0;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= (what.cornerCount == 3 ? n - j : n); ++i)
    {
      const ReferencePoint u = placeOnFace(mesh.elements[element].domain, what,
        static_cast<double>(i) / n, static_cast<double>(j) / n);
      largest =
        std::max(largest, std::abs(fieldAt(mesh, { element, u }) - fieldAt(mesh, behind(u))));
    }
  }
  return largest <= LargestDifference * std::min(rangeOf(element), rangeOf(other));
}

/// The face of an element's cube that stands for a face of its domain.
int cubeFaceOf(const CubeShape& shape, int face)
{
  return static_cast<int>(
    std::find(shape.faces.begin(), shape.faces.end(), face) - shape.faces.begin());
}

bool areSame(const CurveEnd& a, const CurveEnd& b)
{
  return a.edge == b.edge && a.order == b.order && a.count == b.count;
}

/// Matches the curves in one joined face of an element.
class FaceMatcher
{
public:
  FaceMatcher(const ElementMesh& mesh, double isovalue, const SurfaceOfElement& surfaceOf,
    int element, int face)
    : Mesh(mesh)
    , Isovalue(isovalue)
    , Here(surfaceOf(element))
    , There(surfaceOf(mesh.neighbor(element, face).element))
    , Element(element)
    , DomainFace(face)
    , Behind(mesh.neighbor(element, face))
  {
    this->FaceThere = cubeFaceOf(this->There.shape, this->Behind.face);
    this->mapCorners();
    this->Agrees = this->agrees();
  }

  CurveMatch match(const FaceCurve& curve) const
  {
    return curve.isBroken || !this->Agrees ? CurveMatch{}
      : curve.isClosed                     ? this->matchClosed(curve)
                                           : this->matchOpen(curve);
  }

private:
  /// Whether corners correspond, and the two fields agree.
  bool agrees() const
  {
    return this->CornersFit &&
      fieldsAgree(this->Mesh, this->Element, this->DomainFace, this->Behind.element,
        [&](const ReferencePoint& u) {
          return crossFace(this->Mesh, { this->Element, u }, this->DomainFace);
        });
  }

  /// Lists which corner of the neighbour each corner of the face is.
  void mapCorners()
  {
    const Face& face = this->Mesh.face(this->Element, this->DomainFace);
    std::array<int, MaximumCorners> back{};
    this->CornerThere.fill(-1);
    back.fill(-1);
    for (int c = 0; c < face.cornerCount; ++c)
    {
      const int here = this->Here.shape.distinctCorner(face.corners[c]);
      const int there = this->There.shape.distinctCorner(this->Behind.corners[c]);
      const bool isNew = this->CornerThere[here] < 0 && back[there] < 0;
      this->CornersFit &= isNew || (this->CornerThere[here] == there && back[there] == here);
      this->CornerThere[here] = there;
      back[there] = here;
    }
  }

  /// An end as the neighbour numbers it.
  CurveEnd seenFromThere(CurveEnd end) const
  {
    const std::array<int, 2> edge{ this->CornerThere[end.edge[0]], this->CornerThere[end.edge[1]] };
    end.edge = { std::min(edge[0], edge[1]), std::max(edge[0], edge[1]) };
    end.order = edge[0] < edge[1] ? end.order : end.count - 1 - end.order;
    return end;
  }

  CurveMatch joinedTo(const FaceCurve& curve, int firstEnd) const
  {
    return { CurveMatch::Joined, this->Behind.element,
      static_cast<int>(&curve - this->There.curves.data()), firstEnd };
  }

  CurveMatch matchOpen(const FaceCurve& curve) const
  {
    const CurveEnd first = this->seenFromThere(curve.ends[0]);
    const CurveEnd second = this->seenFromThere(curve.ends[1]);
    for (const FaceCurve& other : this->There.curves)
    {
      for (int n = 0; n < 2 && other.face == this->FaceThere; ++n)
      {
        if (!other.isClosed && !other.isBroken && areSame(first, other.ends[n]) &&
          areSame(second, other.ends[1 - n]))
        {
          return this->joinedTo(other, n);
        }
      }
    }
    return {};
  }

  CurveMatch matchClosed(const FaceCurve& curve) const
  {
    const Location here =
      pointOn(this->Mesh, this->Isovalue, this->Element, this->Here.shape, curve.segment);
    const Location there = crossFace(this->Mesh, here, this->DomainFace);
    const int other = this->There.curveAt(this->FaceThere, this->There.shape.inCube(there.u));
    return other >= 0 && this->There.curves[other].isClosed
      ? this->joinedTo(this->There.curves[other], 0)
      : CurveMatch{};
  }

  const ElementMesh& Mesh;
  double Isovalue;
  const ElementSurface& Here;
  const ElementSurface& There;
  int Element;
  int DomainFace;
  const FaceNeighbor& Behind;
  /// Face of the neighbour's cube.
  int FaceThere = -1;
  std::array<int, MaximumCorners> CornerThere{};
  bool CornersFit = true;
  bool Agrees = false;
};

CurveMatch matchCollapsed(const FaceCurve& curve)
{
  CurveMatch match;
  const bool isPoint = !curve.isClosed && !curve.isBroken && areSame(curve.ends[0], curve.ends[1]);
  match.kind = isPoint ? CurveMatch::Collapsed : CurveMatch::Unknown;
  return match;
}

/// Matches the curves in one face that is not joined.
class OpenFaceMatcher
{
public:
  OpenFaceMatcher(const ElementMesh& mesh, double isovalue, const SurfaceOfElement& surfaceOf,
    const FaceLocator* locator, int element, int face)
    : Mesh(mesh)
    , Isovalue(isovalue)
    , SurfaceOf(surfaceOf)
    , Element(element)
  {
    if (!locator || !isSomethingBehind(mesh, *locator, element, face))
    {
      this->Kind = CurveMatch::End;
      return;
    }
    this->Coarser = findCoarserFace(mesh, *locator, element, face);
    this->Kind = !this->Coarser ? CurveMatch::Divided
      : fieldsAgree(mesh, element, face, this->Coarser->element, *this->Coarser)
      ? CurveMatch::PartOf
      : CurveMatch::Unknown;
  }

  CurveMatch match(const FaceCurve& curve) const
  {
    CurveMatch match;
    match.kind = curve.isBroken ? CurveMatch::Unknown : this->Kind;
    if (match.kind == CurveMatch::PartOf)
    {
      const ElementSurface& there = this->SurfaceOf(this->Coarser->element);
      const Location here = pointOn(this->Mesh, this->Isovalue, this->Element,
        this->SurfaceOf(this->Element).shape, curve.segment);
      match.element = this->Coarser->element;
      match.curve = there.curveAt(cubeFaceOf(there.shape, this->Coarser->face),
        there.shape.inCube((*this->Coarser)(here.u).u));
      match.kind = match.curve < 0 ? CurveMatch::Unknown : CurveMatch::PartOf;
    }
    return match;
  }

private:
  const ElementMesh& Mesh;
  double Isovalue;
  const SurfaceOfElement& SurfaceOf;
  int Element;
  CurveMatch::Kind Kind = CurveMatch::Unknown;
  std::optional<CoarserFace> Coarser;
};

} // namespace

std::vector<CurveMatch> matchCurves(const ElementMesh& mesh, double isovalue, int element,
  const SurfaceOfElement& surfaceOf, const FaceLocator* locator)
{
  const ElementSurface& here = surfaceOf(element);
  std::vector<CurveMatch> matches;
  std::unique_ptr<FaceMatcher> joined;
  std::unique_ptr<OpenFaceMatcher> open;
  int lastFace = -1;
  for (const FaceCurve& curve : here.curves)
  {
    const int face = here.shape.faces[curve.face];
    const bool isJoined = face >= 0 && mesh.neighbor(element, face).element >= 0;
    if (face >= 0 && face != lastFace)
    {
      joined.reset();
      open.reset();
      isJoined
        ? (void)(joined = std::make_unique<FaceMatcher>(mesh, isovalue, surfaceOf, element, face))
        : (void)(open = std::make_unique<OpenFaceMatcher>(
                   mesh, isovalue, surfaceOf, locator, element, face));
      lastFace = face;
    }
    matches.push_back(face < 0 ? matchCollapsed(curve)
        : isJoined             ? joined->match(curve)
                               : open->match(curve));
  }
  return matches;
}

WorldPoint positionOfEnd(const ElementMesh& mesh, double isovalue, int element,
  const ElementSurface& surface, const CurveEnd& end)
{
  const Location place = pointOn(mesh, isovalue, element, surface.shape, end.segment);
  return { glm::dvec3(evaluateGradient(mesh.form(element), place.u).value) };
}

} // namespace hop
