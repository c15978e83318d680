#include "Surface/Anchor.h"

#include "Support/SortedBy.h"

#include <cmath>

namespace hop
{
namespace
{

/// The root s near zero of newton - s + s^2 bend/2: the distance at which the field F - c, whose slope along a line is
/// -1 and whose second derivative is `bend`, vanishes to second order. Newton's step itself where there is no root.
double offsetAlong(double newton, double bend)
{
  // The discriminant is >= 0; the root written so that it does not cancel.
  const double product = newton * bend;
  return product <= 0.5 ? 2.0 * newton / (1.0 + std::sqrt(1.0 - 2.0 * product)) : newton;
}

/// xx, xy, yy of a bilinear form in the basis of tangentsOf(normal).
std::array<float, 3> shapeOf(const glm::vec3& normal, const glm::dmat3& bend)
{
  const auto tangents = tangentsOf(normal);
  const glm::dvec3 e1(tangents[0]);
  const glm::dvec3 e2(tangents[1]);
  return { static_cast<float>(glm::dot(e1, bend * e1)), static_cast<float>(glm::dot(e1, bend * e2)),
    static_cast<float>(glm::dot(e2, bend * e2)) };
}

} // namespace

bool anchorPatch(
  const Location& place, const Jet& jet, double isovalue, Anchor& anchor, Patch& patch)
{
  const FieldPoint point = fieldPoint(jet, isovalue);
  if (!anchorPatch({ place, point, worldHessian(jet, point) }, anchor, patch))
  {
    return false;
  }
  // The next step goes along a straight line in reference space: second derivative of the field along that line.
  const double slope = length(point.gradient);
  const glm::dvec3 d = point.map.inverse * (point.gradient.xyz / -slope);
  const auto second = [&jet](int n) { return jet.second[n].w; };
  const double bend = d.x * d.x * second(0) + d.y * d.y * second(3) + d.z * d.z * second(5) +
    2.0 * (d.x * d.y * second(1) + d.x * d.z * second(2) + d.y * d.z * second(4));
  anchor.offset = static_cast<float>(offsetAlong(point.value / slope, bend / slope));
  return true;
}

bool anchorPatch(const Evaluated& at, Anchor& anchor, Patch& patch)
{
  const FieldPoint& point = at.point;
  const double slope = length(point.gradient);
  const double offset = point.value / slope;
  if (point.map.singular || !(slope > 0.0) || !std::isfinite(slope) || !std::isfinite(offset))
  {
    return false;
  }
  const glm::dvec3 normal = point.gradient.xyz / -slope;
  const glm::dmat3 bend = at.hessian / -slope;
  const double distance = offsetAlong(offset, -glm::dot(normal, bend * normal));
  patch.position = point.map.position.xyz + distance * normal;
  patch.normal = glm::vec3(normal);
  patch.shape = shapeOf(patch.normal, bend);
  anchor = { at.location, glm::mat3(point.map.inverse), static_cast<float>(distance) };
  return true;
}

void continuePatch(const Anchor& knownAnchor, const Patch& known, const Location& place,
  Anchor& anchor, Patch& patch)
{
  const auto tangents = tangentsOf(known.normal);
  const glm::dvec3 normal(known.normal);
  const glm::dvec3 e1(tangents[0]);
  const glm::dvec3 e2(tangents[1]);
  const auto& s = known.shape;
  const glm::dmat3 bend = static_cast<double>(s[0]) * glm::outerProduct(e1, e1) +
    static_cast<double>(s[1]) * (glm::outerProduct(e1, e2) + glm::outerProduct(e2, e1)) +
    static_cast<double>(s[2]) * glm::outerProduct(e2, e2);
  // From the known patch to the place.
  const glm::dvec3 d =
    glm::inverse(glm::dmat3(knownAnchor.pull)) * (place.u.xyz - knownAnchor.place.u.xyz) -
    static_cast<double>(knownAnchor.offset) * normal;
  const glm::dvec3 along = d - glm::dot(d, normal) * normal;
  const glm::dvec3 normalThere = glm::normalize(normal + bend * along);
  // Above the surface, which lies t.S t / 2 below the tangent plane.
  const double height = glm::dot(d, normal) + 0.5 * glm::dot(along, bend * along);
  const double offset = -height * glm::dot(normal, normalThere);
  patch = known;
  patch.position = known.position + d + offset * normalThere;
  patch.normal = glm::vec3(normalThere);
  patch.shape = shapeOf(patch.normal, bend);
  anchor = { place, knownAnchor.pull, static_cast<float>(offset) };
}

std::vector<int> orderByElement(
  const std::vector<Location>& places, std::size_t elementCount, const ParallelFor& parallelFor)
{
  return sortedBy(
    places, elementCount, [](const Location& place) { return place.element; }, parallelFor);
}

std::vector<int> orderByElement(
  const Buffer<Anchor>& anchors, std::size_t elementCount, const ParallelFor& parallelFor)
{
  return sortedBy(
    anchors, elementCount, [](const Anchor& anchor) { return anchor.place.element; }, parallelFor);
}

} // namespace hop
