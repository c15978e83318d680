#include "ElementMesh.h"

#include <algorithm>

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

/// A quadrilateral with two neighbouring corners in one place is a triangle in world space.
/// \return the first of the two coincident corners (the second follows it), or -1
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

const Face& faceOf(const ElementMesh& mesh, int element, int face)
{
  return facts(mesh.elements[element].domain).faces[face];
}

/// Weights of a face's corners at a point of the face: bilinear on quadrilaterals, barycentric on
/// triangles. On a collapsed quadrilateral they add up to barycentric ones.
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

/// The point of a collapsed quadrilateral from the barycentric weights of its three places.
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

glm::dvec3 faceMiddle(const ElementMesh& mesh, const FaceReference& reference)
{
  const BernsteinForm form = mesh.form(reference.element);
  const DomainFacts& domain = facts(form.domain);
  const Face& face = domain.faces[reference.face];
  const Element& element = mesh.elements[reference.element];
  const int apex = collapsedCorner(element, face);
  ReferencePoint middle;
  if (apex >= 0)
  {
    std::array<double, MaximumCorners> thirds{};
    for (const int c : { 1, 2, 3 })
    {
      thirds[face.corners[(apex + c) % 4]] = 1.0 / 3.0;
    }
    middle = pointOnCollapsed(domain, face, apex, thirds);
  }
  for (int c = 0; apex < 0 && c < face.cornerCount; ++c)
  {
    middle.xyz += domain.corners[face.corners[c]].xyz / static_cast<double>(face.cornerCount);
  }
  return glm::dvec3(evaluateGradient(form, middle).value);
}

FaceNeighbor joinTo(const ElementMesh& mesh, const FaceReference& from, const FaceReference& to)
{
  const Element& element = mesh.elements[from.element];
  const Element& other = mesh.elements[to.element];
  const Face& face = faceOf(mesh, from.element, from.face);
  const Face& otherFace = faceOf(mesh, to.element, to.face);
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
  return neighbor;
}

/// A face, and the corners by which it is found.
struct FaceClaim
{
  FaceKey key;
  FaceReference where;
};

/// All faces, sorted by their corners.
std::vector<FaceClaim> faceClaims(const ElementMesh& mesh)
{
  std::vector<FaceClaim> claims;
  claims.reserve(mesh.elements.size() * MaximumFaces);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    const auto& faces = facts(mesh.elements[e].domain).faces;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
      const FaceKey key = faceKey(mesh.elements[e], faces[f]);
      if (key[1] >= 0) // three distinct corners at least: a face, not an edge or a point
      {
        claims.push_back({ key, { e, f } });
      }
    }
  }
  std::stable_sort(claims.begin(), claims.end(),
    [](const FaceClaim& a, const FaceClaim& b) { return a.key < b.key; });
  return claims;
}

FaceNeighbor& neighborAt(ElementMesh& mesh, const FaceReference& face)
{
  return mesh.neighbors[faceSlot(face.element, face.face)];
}

} // namespace

void findFaceNeighbors(ElementMesh& mesh, double tolerance, const ParallelFor& parallelFor)
{
  mesh.neighbors.assign(mesh.elements.size() * MaximumFaces, {});
  const std::vector<FaceClaim> claims = faceClaims(mesh);
  // Where in the list two faces of one key follow each other, and no third one.
  std::vector<std::size_t> pairs;
  for (std::size_t first = 0, end = 0; first < claims.size(); first = end)
  {
    for (end = first + 1; end < claims.size() && claims[end].key == claims[first].key;)
    {
      ++end;
    }
    if (end - first == 2)
    {
      pairs.push_back(first);
    }
  }
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(pairs.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t p = begin; p < end; ++p)
      {
        const FaceReference& a = claims[pairs[p]].where;
        const FaceReference& b = claims[pairs[p] + 1].where;
        if (glm::distance(faceMiddle(mesh, a), faceMiddle(mesh, b)) <= tolerance)
        {
          neighborAt(mesh, a) = joinTo(mesh, a, b);
          neighborAt(mesh, b) = joinTo(mesh, b, a);
        }
      }
    });
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
