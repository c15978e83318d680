#include "Elements/ElementMesh.h"

#include "Support/Buffer.h"
#include "Support/SortedBy.h"

#include <algorithm>
#include <tuple>

namespace hop
{
namespace
{

struct FaceReference
{
  int element = -1;
  int face = -1;
};

using FaceKey = std::array<std::int64_t, 4>;

std::int64_t cornerNumber(const Element& element, const Face& face, int c)
{
  return element.corners[face.corners[c]];
}

/// The distinct numbers of a face's corners, sorted; -1 where there are fewer than four.
FaceKey faceKey(const Element& element, const Face& face)
{
  FaceKey key{ -1, -1, -1, -1 };
  int distinct = 0;
  for (int c = 0; c < face.cornerCount; ++c)
  {
    const std::int64_t number = cornerNumber(element, face, c);
    if (std::find(key.begin(), key.begin() + distinct, number) == key.begin() + distinct)
    {
      key[distinct++] = number;
    }
  }
  std::sort(key.begin(), key.end());
  return key;
}

/// The apex of a collapsed face: a quadrilateral with two neighbouring corners in one place is a triangle in world
/// space.
/// \return position in the ring of the first of the two coincident corners (the second follows it), or -1
int collapsedCorner(const Element& element, const Face& face)
{
  for (int c = 0; face.cornerCount == 4 && c < 4; ++c)
  {
    if (cornerNumber(element, face, c) == cornerNumber(element, face, (c + 1) % 4))
    {
      return c;
    }
  }
  return -1;
}

/// Weights of a face's corners at a point of the face: bilinear on quadrilaterals, barycentric on
/// triangles. On a collapsed quadrilateral the sums over coincident corners are barycentric weights.
std::array<double, 4> cornerWeights(
  const DomainFacts& domain, const Face& face, const ReferencePoint& u)
{
  const glm::dvec3 origin = domain.corners[face.corners[0]].xyz;
  const glm::dvec3 e1 = domain.corners[face.corners[1]].xyz - origin;
  const glm::dvec3 e2 = domain.corners[face.corners[face.cornerCount - 1]].xyz - origin;
  const glm::dvec3 d = u.xyz - origin;
  const double a11 = glm::dot(e1, e1), a12 = glm::dot(e1, e2), a22 = glm::dot(e2, e2);
  const double b1 = glm::dot(e1, d), b2 = glm::dot(e2, d);
  const double determinant = a11 * a22 - a12 * a12;
  const double s = (a22 * b1 - a12 * b2) / determinant;
  const double t = (a11 * b2 - a12 * b1) / determinant;
  if (face.cornerCount == 3)
  {
    return { 1.0 - s - t, s, t, 0.0 };
  }
  return { (1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t };
}

/// The point of a collapsed quadrilateral from the barycentric weights of its three distinct corners.
/// \param apex see collapsedCorner()
/// \param weightOfCorner by corner of the domain; the apex's two corners share its weight in any way
ReferencePoint pointOnCollapsed(const DomainFacts& domain, const Face& face, int apex,
  const std::array<double, MaximumCorners>& weightOfCorner)
{
  const auto corner = [&](int c) { return face.corners[(apex + c) % 4]; };
  // Ring order: apex, apex again, then the base from the second apex to the first.
  const double atApex = weightOfCorner[corner(0)] + weightOfCorner[corner(1)];
  const double second = weightOfCorner[corner(2)];
  const double first = weightOfCorner[corner(3)];
  const double base = first + second;
  const double s = base > 0.0 ? second / base : 0.5;
  const auto at = [&](int c) { return domain.corners[corner(c)].xyz; };
  return { atApex * ((1.0 - s) * at(0) + s * at(1)) +
    (1.0 - atApex) * ((1.0 - s) * at(3) + s * at(2)) };
}

/// World position of a face's middle; of a collapsed face, of its barycentre.
glm::dvec3 faceMiddle(const ElementMesh& mesh, const FaceReference& reference)
{
  const BernsteinForm form = mesh.form(reference.element);
  const DomainFacts& domain = facts(form.domain);
  const Face& face = domain.faces[reference.face];
  const Element& element = mesh.elements[reference.element];
  const int apex = collapsedCorner(element, face);
  ReferencePoint middle = middleOf(domain, face);
  if (apex >= 0)
  {
    std::array<double, MaximumCorners> thirds{};
    for (const int c : { 1, 2, 3 })
    {
      thirds[face.corners[(apex + c) % 4]] = 1.0 / 3.0;
    }
    middle = pointOnCollapsed(domain, face, apex, thirds);
  }
  return glm::dvec3(evaluateGradient(form, middle).value);
}

/// What the first face has to know of the second.
FaceNeighbor joinTo(const ElementMesh& mesh, const FaceReference& from, const FaceReference& to)
{
  const Element& element = mesh.elements[from.element];
  const Element& other = mesh.elements[to.element];
  const Face& face = mesh.face(from.element, from.face);
  const Face& otherFace = mesh.face(to.element, to.face);
  FaceNeighbor neighbor;
  neighbor.element = to.element;
  neighbor.face = static_cast<std::uint8_t>(to.face);
  for (int c = 0; c < face.cornerCount; ++c)
  {
    int match = 0;
    while (cornerNumber(other, otherFace, match) != cornerNumber(element, face, c))
    {
      ++match;
    }
    neighbor.corners[c] = static_cast<std::uint8_t>(otherFace.corners[match]);
  }
  const int apex = collapsedCorner(element, face);
  const int otherApex = collapsedCorner(other, otherFace);
  if (apex >= 0 && otherApex >= 0 &&
    cornerNumber(element, face, apex) == cornerNumber(other, otherFace, otherApex))
  {
    // Two corners of each face stand in one place: those are paired at which corresponding sides of the faces end.
    const bool sameWay = cornerNumber(element, face, (apex + 3) % 4) ==
      cornerNumber(other, otherFace, (otherApex + 3) % 4);
    neighbor.corners[apex] =
      static_cast<std::uint8_t>(otherFace.corners[(otherApex + !sameWay) % 4]);
    neighbor.corners[(apex + 1) % 4] =
      static_cast<std::uint8_t>(otherFace.corners[(otherApex + sameWay) % 4]);
  }
  return neighbor;
}

/// A face, and the distinct corners by which its partner is found.
struct FaceClaim
{
  FaceKey key{ -1, -1, -1, -1 };
  FaceReference where;

  /// Whether there are three distinct corners at least, so that it is no edge or point. Keys ascend, -1 first.
  bool isFace() const { return this->key[1] >= 0; }
};

/// MaximumFaces entries an element, as faceSlot() counts them.
Buffer<FaceClaim> faceClaims(const ElementMesh& mesh, const ParallelFor& parallelFor)
{
  Buffer<FaceClaim> claims(mesh.elements.size() * MaximumFaces);
  forAll(parallelFor, mesh.elements.size(),
    [&](std::size_t e)
    {
      const int element = static_cast<int>(e);
      const auto& faces = facts(mesh.elements[e].domain).faces;
      for (int f = 0; f < MaximumFaces; ++f)
      {
        FaceClaim& claim = claims[faceSlot(element, f)];
        claim = {};
        if (f < static_cast<int>(faces.size()))
        {
          claim = { faceKey(mesh.elements[e], faces[f]), { element, f } };
        }
      }
    });
  return claims;
}

FaceNeighbor& neighborAt(ElementMesh& mesh, const FaceReference& face)
{
  return mesh.neighbors[faceSlot(face.element, face.face)];
}

/// Joins faces a and b if they coincide and belong to two elements.
void join(ElementMesh& mesh, const FaceReference& a, const FaceReference& b,
  const std::vector<double>& tolerances)
{
  const double tolerance = std::min(tolerances[a.element], tolerances[b.element]);
  if (a.element != b.element &&
    glm::distance(faceMiddle(mesh, a), faceMiddle(mesh, b)) <= tolerance)
  {
    neighborAt(mesh, a) = joinTo(mesh, a, b);
    neighborAt(mesh, b) = joinTo(mesh, b, a);
  }
}

} // namespace

void findFaceNeighbors(
  ElementMesh& mesh, const std::vector<double>& tolerances, const ParallelFor& parallelFor)
{
  mesh.neighbors.assign(mesh.elements.size() * MaximumFaces, {});
  const Buffer<FaceClaim> claims = faceClaims(mesh, parallelFor);
  const std::size_t bins = mesh.elements.size();
  Grouping faces = groupedBy(
    claims, bins + 1,
    [bins](const FaceClaim& claim)
    { return claim.isFace() ? static_cast<std::size_t>(claim.key.back()) % bins : bins; },
    parallelFor);
  forAll(parallelFor, bins,
    [&](std::size_t bin)
    {
      const auto begin = faces.order.begin() + faces.start[bin];
      const auto end = faces.order.begin() + faces.start[bin + 1];
      std::sort(begin, end,
        [&](int a, int b) { return std::tie(claims[a].key, a) < std::tie(claims[b].key, b); });
      for (auto first = begin, next = begin; first != end; first = next)
      {
        next = std::find_if(first, end, [&](int i) { return claims[i].key != claims[*first].key; });
        if (next - first == 2)
        {
          join(mesh, claims[first[0]].where, claims[first[1]].where, tolerances);
        }
      }
    });
}

Jet exactGradient(const ElementMesh& mesh, const Location& at)
{
  if (mesh.elements[at.element].exactField < 0)
  {
    return evaluateGradient(mesh.form(at.element), at.u);
  }
  const ExactField& field = mesh.exactField(at.element);
  return exactGradient(mesh.elements[at.element].domain, field,
    mesh.exactCoefficients.data() + field.firstCoefficient, at.u);
}

Jet exactHessian(const ElementMesh& mesh, const Location& at)
{
  if (mesh.elements[at.element].exactField < 0)
  {
    return evaluateHessian(mesh.form(at.element), at.u);
  }
  const ExactField& field = mesh.exactField(at.element);
  return exactHessian(mesh.elements[at.element].domain, field,
    mesh.exactCoefficients.data() + field.firstCoefficient, at.u);
}

double meshExtent(const ElementMesh& mesh)
{
  glm::dvec3 lower(controlPoint(mesh.form(0), 0));
  glm::dvec3 upper = lower;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    const BernsteinForm form = mesh.form(e);
    for (int i = 0; i < coefficientCount(form.domain, form.degrees); ++i)
    {
      const glm::dvec3 x(controlPoint(form, i));
      lower = glm::min(lower, x);
      upper = glm::max(upper, x);
    }
  }
  return glm::distance(lower, upper);
}

Location crossFace(const ElementMesh& mesh, const Location& location, int face)
{
  const Element& here = mesh.elements[location.element];
  const Face& from = facts(here.domain).faces[face];
  const std::array<double, 4> weights = cornerWeights(facts(here.domain), from, location.u);

  const FaceNeighbor& neighbor = mesh.neighbor(location.element, face);
  const Element& there = mesh.elements[neighbor.element];
  const DomainFacts& domain = facts(there.domain);
  const Face& to = domain.faces[neighbor.face];
  std::array<double, MaximumCorners> weightOfCorner{};
  ReferencePoint u;
  for (int c = 0; c < from.cornerCount; ++c)
  {
    weightOfCorner[neighbor.corners[c]] += weights[c];
    u.xyz += weights[c] * domain.corners[neighbor.corners[c]].xyz;
  }
  const int apex = collapsedCorner(there, to);
  return { neighbor.element, apex < 0 ? u : pointOnCollapsed(domain, to, apex, weightOfCorner) };
}

} // namespace hop
