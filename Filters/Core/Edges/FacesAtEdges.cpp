#include "Edges/FacesAtEdges.h"

#include <algorithm>
#include <iterator>

namespace hop
{

int faceCount(const ElementMesh& mesh, const Location& location)
{
  return static_cast<int>(facts(mesh.elements[location.element].domain).faces.size());
}

std::vector<std::int64_t> cornersOf(const ElementMesh& mesh, const Location& location, int face)
{
  const Face& which = mesh.face(location.element, face);
  std::vector<std::int64_t> numbers;
  numbers.reserve(which.cornerCount);
  for (int c = 0; c < which.cornerCount; ++c)
  {
    numbers.push_back(mesh.elements[location.element].corners[which.corners[c]]);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<std::int64_t> edgeBetween(
  const ElementMesh& mesh, const Location& location, int faceA, int faceB)
{
  const auto first = cornersOf(mesh, location, faceA);
  const auto second = cornersOf(mesh, location, faceB);
  std::vector<std::int64_t> edge;
  std::set_intersection(
    first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(edge));
  return edge;
}

int faceAtEdge(const ElementMesh& mesh, const Location& location, int entry,
  const std::vector<std::int64_t>& edge)
{
  for (int f = 0; f < faceCount(mesh, location); ++f)
  {
    const auto corners = cornersOf(mesh, location, f);
    if (f != entry && std::includes(corners.begin(), corners.end(), edge.begin(), edge.end()))
    {
      return f;
    }
  }
  return -1;
}

int otherFaceAt(const ElementMesh& mesh, const Location& location, int one, double accuracy)
{
  for (int f = 0; f < faceCount(mesh, location); ++f)
  {
    if (f != one && isOnFace(mesh, location, f, accuracy))
    {
      return f;
    }
  }
  return -1;
}

Location ontoFace(const ElementMesh& mesh, const Location& location, int face)
{
  const Face& which = mesh.face(location.element, face);
  const glm::dvec3& inward = which.inward.xyz;
  return { location.element,
    { location.u.xyz - faceMargin(which, location.u) / glm::dot(inward, inward) * inward } };
}

} // namespace hop
