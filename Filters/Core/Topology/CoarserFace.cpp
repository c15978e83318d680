#include "Topology/CoarserFace.h"

#include <algorithm>
#include <limits>

namespace hop
{
namespace
{

/// Largest gap between a face and what is behind it, as a share of the distance from the nearest corner of the face.
/// Larger: what is beside the face, beyond a corner, counts as behind it; smaller: neighbours are not found where
/// curved faces approximate each other badly.
constexpr double largestGap = 0.02;

/// Where corners of refined elements are in the larger element.
struct Refinement
{
  /// Parts of the larger element's side: halves, three times in turn.
  static constexpr double Parts = 8.0;
  /// How far places may be from where they should be, reference units. Curved elements approximate a geometry on their
  /// own, so that their faces miss each other. Larger: faces that do not fit count as refined; smaller: curved ones do
  /// not.
  static constexpr double Rounding = 1e-2;
};

/// A place with the coordinates of refined corners where it is near these.
glm::dvec3 snapped(const glm::dvec3& u)
{
  const glm::dvec3 corner = glm::round(Refinement::Parts * u) / Refinement::Parts;
  return glm::mix(
    u, corner, glm::lessThanEqual(glm::abs(u - corner), glm::dvec3(Refinement::Rounding)));
}

LocalMap mapAt(const ElementMesh& mesh, const Location& location)
{
  return fieldPoint(evaluateGradient(mesh.form(location.element), location.u), 0.0).map;
}

/// The place behind a face.
std::optional<LocatedPlace> locateBehind(
  const ElementMesh& mesh, const FaceLocator& locator, const Location& location, int face)
{
  const Face& what = mesh.face(location.element, face);
  const auto& corners = facts(mesh.elements[location.element].domain).corners;
  const LocalMap place = mapAt(mesh, location);
  double toCorner = std::numeric_limits<double>::infinity();
  for (int c = 0; c < what.cornerCount; ++c)
  {
    const Location corner{ location.element, corners[what.corners[c]] };
    toCorner = std::min(toCorner, length(place.position - mapAt(mesh, corner).position));
  }
  std::int64_t evaluations = 0;
  return locator.locate(place, location.element, face, largestGap * toCorner, evaluations);
}

} // namespace

void CoarserFace::setMap(
  const std::array<glm::dvec3, 4>& here, const std::array<glm::dvec3, 4>& there)
{
  const auto frame = [](const std::array<glm::dvec3, 4>& places)
  {
    const glm::dvec3 across = places[1] - places[0], up = places[2] - places[0];
    return glm::dmat3(across, up, glm::cross(across, up));
  };
  glm::dmat3 image = frame(there);
  image[2] = glm::dvec3(0.0); // no place is off the face
  this->slope = image * glm::inverse(frame(here));
  this->origin = there[0] - this->slope * here[0];
}

ReferencePoint placeOnFace(Domain domain, const Face& face, double s, double t)
{
  const auto& corners = facts(domain).corners;
  const glm::dvec3 origin = corners[face.corners[0]].xyz;
  const glm::dvec3 across = corners[face.corners[1]].xyz - origin;
  const glm::dvec3 up = corners[face.corners[face.cornerCount - 1]].xyz - origin;
  return { origin + s * across + t * up };
}

bool isSomethingBehind(const ElementMesh& mesh, const FaceLocator& locator, int element, int face)
{
  if (!locator.mayContinue(element, face))
  {
    return false;
  }
  // Places along each side. More find neighbours that overlap with a small part of the face.
  constexpr int count = 4;
  const Face& what = mesh.face(element, face);
  const double inset = what.cornerCount == 3 ? 0.3 : 0.5; // from the sides, in steps between places
  for (int i = 0; i < count; ++i)
  {
    for (int j = 0; j < (what.cornerCount == 3 ? count - i : count); ++j)
    {
      const ReferencePoint u =
        placeOnFace(mesh.elements[element].domain, what, (i + inset) / count, (j + inset) / count);
      if (locateBehind(mesh, locator, { element, u }, face))
      {
        return true;
      }
    }
  }
  return false;
}

std::optional<CoarserFace> findCoarserFace(
  const ElementMesh& mesh, const FaceLocator& locator, int element, int face)
{
  // Distance of the places from the sides of the face: nearer to corners, what is beside the face may be found.
  constexpr double inset = 0.1;
  const Face& what = mesh.face(element, face);
  const Domain domain = mesh.elements[element].domain;
  const double far = what.cornerCount == 3 ? 1.0 - 2.0 * inset : 1.0 - inset;
  const double last = what.cornerCount == 3 ? 0.4 : far;
  const std::array<std::array<double, 2>, 4> at{ { { inset, inset }, { far, inset }, { inset, far },
    { last, last } } };
  std::array<glm::dvec3, 4> here, there;
  CoarserFace coarser;
  for (int n = 0; n < 4; ++n)
  {
    const ReferencePoint u = placeOnFace(domain, what, at[n][0], at[n][1]);
    const auto place = locateBehind(mesh, locator, { element, u }, face);
    if (!place ||
      (n > 0 && (place->location.element != coarser.element || place->face != coarser.face)))
    {
      return std::nullopt;
    }
    coarser.element = place->location.element;
    coarser.face = place->face;
    here[n] = u.xyz;
    there[n] = place->location.u.xyz;
  }
  coarser.setMap(here, there);
  if (glm::distance(coarser({ here[3] }).u.xyz, there[3]) > Refinement::Rounding)
  {
    return std::nullopt;
  }
  const auto& corners = facts(domain).corners;
  for (int n = 0; n < 3; ++n)
  {
    here[n] = corners[what.corners[n < 2 ? n : what.cornerCount - 1]].xyz;
    there[n] = snapped(coarser({ here[n] }).u.xyz);
  }
  coarser.setMap(here, there);
  return coarser;
}

} // namespace hop
