#include "Surface/FaceLocator.h"

#include "Surface/ActiveFaces.h"

#include <algorithm>
#include <tuple>

namespace hop
{
namespace
{

/// Errors of coordinates and values in single precision, in units of their size: some 8 epsilons of floats.
constexpr double rounding = 1e-6;
/// Largest cosine between the outward normals of opposite faces, at their middles; chosen by experiment. It leaves room
/// for curved faces: planes that coincide have -1. Larger: more pairs of faces are searched in vain; smaller: strongly
/// bent neighbours are not found.
constexpr double facing = -0.2;
/// The same of faces that share an edge of the mesh, as halves of a face do with the whole. Larger: the surface goes on at
/// sharp edges of the mesh, where it ends; smaller: halves of strongly bent faces are not found.
constexpr double facingAtSharedEdge = -0.9;
/// The same at one place of both faces, 37 degrees from opposite; chosen by experiment. Larger: the surface goes on
/// across a reentrant edge of the mesh, beside which the other face is near; smaller: curved faces that approximate each
/// other badly are not found.
constexpr double facingAtPlace = -0.8;
/// Half-space value up to which a control point counts as on a face. Other control points have 1/MaximumDegree at least.
constexpr double onFaceOfLattice = 1e-9;

struct FaceHull
{
  Bounds bounds;
  Range range;
};

/// Bounds of the control points on a face, and of the field's coefficients there.
FaceHull hullOf(
  const BernsteinForm& form, const std::vector<LatticePoint>& lattice, const Face& face)
{
  FaceHull hull;
  bool first = true;
  for (std::size_t i = 0; i < lattice.size(); ++i)
  {
    if (faceMargin(face, latticePosition(form.degrees, lattice[i])) > onFaceOfLattice)
    {
      continue;
    }
    const Coefficient c = controlPoint(form, static_cast<int>(i));
    const Bounds point{ glm::dvec3(c), glm::dvec3(c) };
    if (first)
    {
      hull = { point, { c.w, c.w } };
      first = false;
    }
    hull.bounds.include(point);
    hull.range.include(c.w);
  }
  return hull;
}

bool straddles(const Range& range, double isovalue)
{
  const double slack = rounding * range.magnitude();
  return range.lower - slack <= isovalue && isovalue <= range.upper + slack;
}

LocalMap mapAt(const BernsteinForm& form, const ReferencePoint& u)
{
  return fieldPoint(evaluateGradient(form, u), 0.0).map;
}

/// Gradient in world space of a face's half-space value (faceMargin): it points into the element.
WorldVector inwardOf(const LocalMap& map, const Face& face)
{
  return { glm::transpose(map.inverse) * face.inward.xyz };
}

/// Takes u towards a target by the linearised map, along the element's faces where it would leave.
/// \param rest vector from u to the target; receives what is left of it
/// \return length of the way in reference space
double stepInside(Domain domain, const LocalMap& map, ReferencePoint& u, WorldVector& rest)
{
  ActiveFaces active;
  double way = 0.0;
  // Ends with the third step at the latest: each of the others makes one more face active.
  for (;;)
  {
    const ReferenceVector du = pullAlong(domain, active, map, rest);
    const Exit exit = findExit(domain, u, du, active);
    const ReferenceVector step = exit.fraction * du;
    u = u + step;
    rest = rest - map.push(step);
    way += length(step);
    if (exit.face < 0 || active.count == 2)
    {
      return way;
    }
    active.add(exit.face);
  }
}

/// Largest cosine between the outward normals of two faces that are opposite to each other.
double largestCosine(
  const ElementMesh& mesh, int element, int face, int otherElement, int otherFace)
{
  const Face& one = mesh.face(element, face);
  const Face& other = mesh.face(otherElement, otherFace);
  int shared = 0;
  for (int c = 0; c < one.cornerCount; ++c)
  {
    const std::int64_t number = mesh.elements[element].corners[one.corners[c]];
    for (int d = 0; d < other.cornerCount; ++d)
    {
      shared += mesh.elements[otherElement].corners[other.corners[d]] == number;
    }
  }
  return shared == 2 ? facingAtSharedEdge : facing;
}

} // namespace

FaceLocator::FaceLocator(const ElementMesh& mesh, double isovalue, const ParallelFor& parallelFor)
  : Mesh(mesh)
  , Met(mesh.elements.size() * MaximumFaces, 0)
{
  std::vector<std::vector<OpenFace>> ofElement(mesh.elements.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(ofElement.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        ofElement[e] = this->openFacesOf(static_cast<int>(e), isovalue);
      }
    });
  for (const std::vector<OpenFace>& faces : ofElement)
  {
    this->Faces.insert(this->Faces.end(), faces.begin(), faces.end());
  }
  this->Evaluations = static_cast<std::int64_t>(this->Faces.size());
  this->findOpposites(parallelFor);
}

std::vector<FaceLocator::OpenFace> FaceLocator::openFacesOf(int element, double isovalue)
{
  const BernsteinForm form = this->Mesh.form(element);
  const DomainFacts& domain = facts(form.domain);
  std::vector<OpenFace> result;
  std::vector<LatticePoint> lattice;
  for (int f = 0; f < static_cast<int>(domain.faces.size()); ++f)
  {
    if (this->Mesh.neighbor(element, f).element >= 0)
    {
      continue;
    }
    if (lattice.empty())
    {
      lattice = latticePoints(form.domain, form.degrees);
    }
    const FaceHull hull = hullOf(form, lattice, domain.faces[f]);
    if (straddles(hull.range, isovalue))
    {
      this->Met[faceSlot(element, f)] = 1;
      const WorldVector inward =
        inwardOf(mapAt(form, middleOf(domain, domain.faces[f])), domain.faces[f]);
      const double size = length(inward);
      result.push_back(
        { element, f, hull.bounds, size > 0.0 ? (-1.0 / size) * inward : WorldVector{}, {} });
    }
  }
  return result;
}

/// Finds the pairs of opposite faces, and forgets faces that have no opposite.
void FaceLocator::findOpposites(const ParallelFor& parallelFor)
{
  std::vector<Bounds> boxes;
  for (const OpenFace& face : this->Faces)
  {
    boxes.push_back(face.bounds.widened(face.reach()));
  }
  const BoxTree tree(boxes);
  std::vector<std::vector<int>> opposites(this->Faces.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(this->Faces.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        const OpenFace& face = this->Faces[i];
        for (const int j : tree.overlapping(boxes[i]))
        {
          const OpenFace& other = this->Faces[j];
          const bool known = length(face.outward) > 0.0 && length(other.outward) > 0.0;
          if (other.element != face.element &&
            (!known ||
              dot(face.outward, other.outward) <
                largestCosine(this->Mesh, face.element, face.face, other.element, other.face)))
          {
            opposites[i].push_back(j);
          }
        }
      }
    });
  std::vector<int> rank(this->Faces.size(), -1);
  int next = 0;
  for (std::size_t i = 0; i < opposites.size(); ++i)
  {
    rank[i] = opposites[i].empty() ? -1 : next++;
  }
  std::vector<OpenFace> kept;
  for (std::size_t i = 0; i < opposites.size(); ++i)
  {
    if (rank[i] >= 0)
    {
      kept.push_back(this->Faces[i]);
      // Being opposite is symmetric, so that all faces opposite to this one are kept too.
      std::transform(opposites[i].begin(), opposites[i].end(),
        std::back_inserter(kept.back().opposite), [&](int j) { return rank[j]; });
    }
  }
  this->Faces = std::move(kept);
}

const FaceLocator::OpenFace* FaceLocator::find(int element, int face) const
{
  const auto at = std::lower_bound(this->Faces.begin(), this->Faces.end(), std::pair(element, face),
    [](const OpenFace& open, const std::pair<int, int>& wanted)
    { return std::pair(open.element, open.face) < wanted; });
  const bool found = at != this->Faces.end() && at->element == element && at->face == face;
  return found ? &*at : nullptr;
}

bool FaceLocator::mayContinueIn(int element, int face, int other) const
{
  const OpenFace* from = this->find(element, face);
  return from &&
    std::any_of(from->opposite.begin(), from->opposite.end(),
      [&](int j) { return this->Faces[j].element == other; });
}

std::vector<std::size_t> FaceLocator::slotsBehind(int element, int face) const
{
  std::vector<std::size_t> slots;
  if (const OpenFace* from = this->find(element, face))
  {
    std::transform(from->opposite.begin(), from->opposite.end(), std::back_inserter(slots),
      [this](int j) { return faceSlot(this->Faces[j].element, this->Faces[j].face); });
  }
  return slots;
}

std::optional<LocatedPlace> FaceLocator::locate(
  const LocalMap& point, int element, int face, double tolerance, std::int64_t& evaluations) const
{
  const OpenFace* from = this->find(element, face);
  const WorldVector inward = inwardOf(point, this->Mesh.face(element, face));
  std::optional<LocatedPlace> nearest;
  for (std::size_t n = 0; from && n < from->opposite.size(); ++n)
  {
    const OpenFace& to = this->Faces[from->opposite[n]];
    const double reach = std::min({ tolerance, from->reach(), to.reach() });
    const auto found = this->locateIn(to, point.position, inward, reach, evaluations);
    if (found && (!nearest || found->gap < nearest->gap))
    {
      nearest = found;
    }
    if (nearest && nearest->gap <= rounding * to.bounds.diagonal())
    {
      break;
    }
  }
  return nearest;
}

/// Newton's method for T(u) = x, or for the u nearest to x where the element does not hold x. The point counts as
/// behind the face only if it lies in front of the element, not beside it: what is left from T(u) to x points across
/// the face for the most part. Nor if the faces do not face each other there.
/// \param inward gradient of the half-space value of the face that the point is on
std::optional<LocatedPlace> FaceLocator::locateIn(const OpenFace& to, const WorldPoint& point,
  const WorldVector& inward, double tolerance, std::int64_t& evaluations) const
{
  // Newton's method converges quadratically and needs a few steps; where it takes more it fails.
  constexpr int maximumSteps = 20;
  // Length of the last step, reference coordinates.
  constexpr double converged = 1e-9;
  // Largest half-space value on the near side of an element, see isNearFace.
  constexpr double nearSide = 0.5;
  if (!to.bounds.widened(tolerance + rounding * to.bounds.diagonal())
         .overlaps({ point.xyz, point.xyz }))
  {
    return std::nullopt;
  }
  const BernsteinForm form = this->Mesh.form(to.element);
  const DomainFacts& domain = facts(form.domain);
  const Face& face = domain.faces[to.face];
  ReferencePoint u = middleOf(domain, face);
  for (int n = 0; n < maximumSteps; ++n)
  {
    const LocalMap map = mapAt(form, u);
    ++evaluations;
    if (map.singular)
    {
      return std::nullopt;
    }
    WorldVector rest = point - map.position;
    if (stepInside(form.domain, map, u, rest) > converged)
    {
      continue;
    }
    const WorldVector its = inwardOf(map, face);
    const double slope = length(its);
    const double across = dot(rest, its) / slope;
    const double aside = length(rest - (across / slope) * its);
    const double gap = std::max(length(rest), std::max(0.0, faceMargin(face, u)) / slope);
    const double slack = rounding * to.bounds.diagonal();
    // A point beyond the far side of a thin element, or nearer to it, lies behind the far side: two plates that are
    // thinner than the tolerance must not be taken for each other's neighbours through their far sides, nor the two
    // faces of a plate of tetrahedra, whose far sides are inclined.
    const bool isNearFace = faceMargin(face, u) <= nearSide && across <= slack;
    const bool facesIt = dot(inward, its) <= facingAtPlace * length(inward) * slope;
    const bool behind =
      isNearFace && facesIt && gap <= tolerance + slack && aside <= std::abs(across) + slack;
    return behind ? std::optional<LocatedPlace>({ { to.element, u }, to.face, gap }) : std::nullopt;
  }
  return std::nullopt;
}

} // namespace hop
