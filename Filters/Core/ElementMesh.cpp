#include "ElementMesh.h"

#include <algorithm>
#include <unordered_map>

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

struct FaceKeyHash
{
  std::size_t operator()(const FaceKey& key) const
  {
    std::uint64_t hash = 0;
    for (const std::int64_t corner : key)
    {
      hash = (hash ^ static_cast<std::uint64_t>(corner)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

FaceKey faceKey(const Element& element, const Face& face)
{
  FaceKey key{ -1, -1, -1, -1 };
  for (int c = 0; c < face.cornerCount; ++c)
  {
    key[c] = element.corners[face.corners[c]];
  }
  std::sort(key.begin(), key.end());
  return key;
}

glm::dvec3 faceMiddle(const ElementMesh& mesh, const FaceReference& reference)
{
  const BernsteinForm form = mesh.form(reference.element);
  const DomainFacts& domain = facts(form.domain);
  const Face& face = domain.faces[reference.face];
  glm::dvec3 middle(0.0);
  for (int c = 0; c < face.cornerCount; ++c)
  {
    middle += domain.corners[face.corners[c]].xyz / static_cast<double>(face.cornerCount);
  }
  return glm::dvec3(evaluateGradient(form, { middle }).value);
}

/// The corner of `element` that carries this number.
std::uint8_t cornerWithNumber(const Element& element, std::int64_t number)
{
  return static_cast<std::uint8_t>(
    std::find(element.corners.begin(), element.corners.end(), number) - element.corners.begin());
}

FaceNeighbor joinTo(const ElementMesh& mesh, const FaceReference& from, const FaceReference& to)
{
  const Element& element = mesh.elements[from.element];
  const Face& face = facts(element.domain).faces[from.face];
  const int carried[3] = { face.corners[0], face.corners[1], face.corners[face.cornerCount - 1] };
  FaceNeighbor neighbor;
  neighbor.element = to.element;
  for (int c = 0; c < 3; ++c)
  {
    neighbor.corners[c] = cornerWithNumber(mesh.elements[to.element], element.corners[carried[c]]);
  }
  return neighbor;
}

} // namespace

void findFaceNeighbors(ElementMesh& mesh, double tolerance)
{
  mesh.neighbors.assign(mesh.elements.size() * MaximumFaces, {});
  std::unordered_map<FaceKey, std::vector<FaceReference>, FaceKeyHash> claims;
  claims.reserve(mesh.elements.size() * 3);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
  {
    const Element& element = mesh.elements[e];
    const auto& faces = facts(element.domain).faces;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
      claims[faceKey(element, faces[f])].push_back({ e, f });
    }
  }
  for (const auto& [key, pair] : claims)
  {
    if (pair.size() != 2 ||
      glm::distance(faceMiddle(mesh, pair[0]), faceMiddle(mesh, pair[1])) > tolerance)
    {
      continue;
    }
    for (int side = 0; side < 2; ++side)
    {
      const FaceReference& from = pair[side];
      mesh.neighbors[static_cast<std::size_t>(from.element) * MaximumFaces + from.face] =
        joinTo(mesh, from, pair[1 - side]);
    }
  }
}

Location crossFace(const ElementMesh& mesh, const Location& location, int face)
{
  const Domain domain = mesh.elements[location.element].domain;
  const DomainFacts& here = facts(domain);
  const Face& from = here.faces[face];
  const glm::dvec3 origin = here.corners[from.corners[0]].xyz;
  const glm::dvec3 e1 = here.corners[from.corners[1]].xyz - origin;
  const glm::dvec3 e2 = here.corners[from.corners[from.cornerCount - 1]].xyz - origin;

  // Coordinates (s, t) within the face: least squares in the plane of the face.
  const glm::dvec3 d = location.u.xyz - origin;
  const double a11 = glm::dot(e1, e1), a12 = glm::dot(e1, e2), a22 = glm::dot(e2, e2);
  const double b1 = glm::dot(e1, d), b2 = glm::dot(e2, d);
  const double determinant = a11 * a22 - a12 * a12;
  const double s = (a22 * b1 - a12 * b2) / determinant;
  const double t = (a11 * b2 - a12 * b1) / determinant;

  const FaceNeighbor& neighbor = mesh.neighbor(location.element, face);
  const auto& there = facts(mesh.elements[neighbor.element].domain).corners;
  const glm::dvec3 start = there[neighbor.corners[0]].xyz;
  return { neighbor.element,
    { start + s * (there[neighbor.corners[1]].xyz - start) +
      t * (there[neighbor.corners[2]].xyz - start) } };
}

} // namespace hop
