#include "Topology/CurveMatching.h"

#include "Surface/FaceLocator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hop
{
namespace
{

WorldPoint positionAt(const ElementMesh& mesh, const Location& location)
{
  return { glm::dvec3(evaluateGradient(mesh.form(location.element), location.u).value) };
}

double fieldAt(const ElementMesh& mesh, const Location& location)
{
  return evaluateGradient(mesh.form(location.element), location.u).value.w;
}

/// A place on a face from two coordinates of its own; on a triangle their sum is 1 at most.
ReferencePoint onFace(Domain domain, const Face& face, double s, double t)
{
  const auto& corners = facts(domain).corners;
  const glm::dvec3 origin = corners[face.corners[0]].xyz;
  const glm::dvec3 across = corners[face.corners[1]].xyz - origin;
  const glm::dvec3 up = corners[face.corners[face.cornerCount - 1]].xyz - origin;
  return { origin + s * across + t * up };
}

/// Whether another element lies behind a face that is not joined, at one of some places inside the face.
bool isSomethingBehind(
  const ElementMesh& mesh, const FaceLocator& locator, int element, int face)
{
  if (!locator.mayContinue(element, face))
  {
    return false;
  }
  // Places along each side. More find neighbours that overlap with a small part of the face.
  constexpr int count = 4;
  // Largest gap, as a share of the distance from the nearest corner of the face. Larger: what is beside the face, beyond
  // a corner, counts as behind it; smaller: neighbours are not found where curved faces approximate each other badly.
  constexpr double largestGap = 0.02;
  const Face& what = mesh.face(element, face);
  std::int64_t evaluations = 0;
  for (int i = 0; i < count; ++i)
  {
    for (int j = 0; j < (what.cornerCount == 3 ? count - i : count); ++j)
    {
      const double inset = what.cornerCount == 3 ? 0.3 : 0.5; // from the sides of the face
      const ReferencePoint u =
        onFace(mesh.elements[element].domain, what, (i + inset) / count, (j + inset) / count);
      const WorldPoint place = positionAt(mesh, { element, u });
      double toCorner = std::numeric_limits<double>::infinity();
      for (int c = 0; c < what.cornerCount; ++c)
      {
        const ReferencePoint corner = facts(mesh.elements[element].domain).corners[what.corners[c]];
        toCorner = std::min(toCorner, length(place - positionAt(mesh, { element, corner })));
      }
      if (locator.locate(place, element, face, largestGap * toCorner, evaluations))
      {
        return true;
      }
    }
  }
  return false;
}

bool areSame(const CurveEnd& a, const CurveEnd& b)
{
  return a.edge == b.edge && a.order == b.order && a.count == b.count;
}

/// Matches the curves in one joined face of an element.
class FaceMatcher
{
public:
  FaceMatcher(const ElementMesh& mesh, double isovalue, const std::vector<ElementSurface>& surfaces,
    int element, int face)
    : Mesh(mesh)
    , Isovalue(isovalue)
    , Here(surfaces[element])
    , There(surfaces[mesh.neighbor(element, face).element])
    , Element(element)
    , DomainFace(face)
    , Behind(mesh.neighbor(element, face))
  {
    const auto& faces = this->There.shape.faces;
    this->FaceThere =
      static_cast<int>(std::find(faces.begin(), faces.end(), int(this->Behind.face)) - faces.begin());
    this->mapCorners();
  }

  /// Whether corners correspond, and the two fields agree at places that determine polynomials of both degrees.
  bool agrees() const
  {
    if (!this->CornersFit)
    {
      return false;
    }
    const Face& face = this->Mesh.face(this->Element, this->DomainFace);
    const auto degreeOf = [&](int element)
    {
      const Degrees& degrees = this->Mesh.elements[element].degrees;
      return *std::max_element(degrees.begin(), degrees.end());
    };
    const int n = std::max(degreeOf(this->Element), degreeOf(this->Behind.element));
    double largest = 0.0;
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= (face.cornerCount == 3 ? n - j : n); ++i)
      {
        const Location here{ this->Element, onFace(this->Here.shape.domain, face, double(i) / n, double(j) / n) };
        const Location there = crossFace(this->Mesh, here, this->DomainFace);
        largest = std::max(largest, std::abs(fieldAt(this->Mesh, here) - fieldAt(this->Mesh, there)));
      }
    }
    const auto rangeOf = [&](int element)
    {
      const Range range = fieldRange(this->Mesh.form(element));
      return range.upper - range.lower;
    };
    return largest <= LargestDifference * std::min(rangeOf(this->Element), rangeOf(this->Behind.element));
  }

  CurveMatch match(const FaceCurve& curve) const
  {
    return curve.isBroken ? CurveMatch{} : curve.isClosed ? this->matchClosed(curve) : this->matchOpen(curve);
  }

private:
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
    return { CurveMatch::Joined, this->Behind.element, static_cast<int>(&curve - this->There.curves.data()), firstEnd };
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
    // Cube units: the place on the curve is known by bisection.
    constexpr double rounding = 1e-9;
    const Location place = crossFace(this->Mesh, this->placeOn(curve), this->DomainFace);
    const glm::dvec3 t = this->There.shape.inCube(place.u);
    CurveMatch found;
    for (const FaceCurve& other : this->There.curves)
    {
      if (other.face == this->FaceThere && other.isClosed &&
        glm::all(glm::lessThanEqual(other.lower - rounding, t)) &&
        glm::all(glm::greaterThanEqual(other.upper + rounding, t)))
      {
        if (found.kind == CurveMatch::Joined)
        {
          return {};
        }
        found = this->joinedTo(other, 0);
      }
    }
    return found;
  }

  /// A point of a curve, by bisection of its segment.
  Location placeOn(const FaceCurve& curve) const
  {
    std::array<glm::dvec3, 2> ends = curve.segment;
    const auto at = [&](const glm::dvec3& t) { return Location{ this->Element, this->Here.shape.inElement(t) }; };
    const bool isPositive = fieldAt(this->Mesh, at(ends[0])) > this->Isovalue;
    for (int step = 0; step < 50; ++step)
    {
      const glm::dvec3 middle = 0.5 * (ends[0] + ends[1]);
      const bool isSame = (fieldAt(this->Mesh, at(middle)) > this->Isovalue) == isPositive;
      ends[isSame ? 0 : 1] = middle;
    }
    return at(ends[0]);
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
};

CurveMatch matchCollapsed(const FaceCurve& curve)
{
  CurveMatch match;
  const bool isPoint = !curve.isClosed && !curve.isBroken && areSame(curve.ends[0], curve.ends[1]);
  match.kind = isPoint ? CurveMatch::Collapsed : CurveMatch::Unknown;
  return match;
}

} // namespace

std::vector<CurveMatch> matchCurves(const ElementMesh& mesh, double isovalue, int element,
  const std::vector<ElementSurface>& surfaces, const FaceLocator* locator)
{
  const ElementSurface& here = surfaces[element];
  std::vector<CurveMatch> matches(here.curves.size());
  std::optional<FaceMatcher> matcher;
  int lastFace = -1;
  bool isKnown = false; // what is behind the last face
  for (std::size_t n = 0; n < here.curves.size(); ++n)
  {
    const FaceCurve& curve = here.curves[n];
    const int face = here.shape.faces[curve.face];
    if (face < 0)
    {
      matches[n] = matchCollapsed(curve);
    }
    else
    {
      const bool isJoined = mesh.neighbor(element, face).element >= 0;
      if (face != lastFace)
      {
        lastFace = face;
        if (isJoined)
        {
          matcher.emplace(mesh, isovalue, surfaces, element, face);
        }
        isKnown = isJoined ? matcher->agrees() : !locator || !isSomethingBehind(mesh, *locator, element, face);
      }
      if (isKnown)
      {
        matches[n].kind = CurveMatch::End;
        matches[n] = isJoined ? matcher->match(curve) : matches[n];
      }
    }
  }
  return matches;
}

} // namespace hop
