#include "Anchor.h"

#include <cmath>
#include <numeric>

namespace hop
{

bool anchorPatch(
  const Location& place, const Jet& jet, double isovalue, Anchor& anchor, Patch& patch)
{
  const FieldPoint point = fieldPoint(jet, isovalue);
  const double slope = length(point.gradient);
  const double offset = point.value / slope;
  if (point.map.singular || !(slope > 0.0) || !std::isfinite(slope) || !std::isfinite(offset))
  {
    return false;
  }
  const glm::dvec3 normal = point.gradient.xyz / -slope;
  const glm::dmat3 bend = worldHessian(jet, point) / -slope;
  patch.position = point.map.position.xyz + offset * normal;
  patch.normal = glm::vec3(normal);
  const auto tangents = tangentsOf(patch.normal);
  const glm::dvec3 e1(tangents[0]);
  const glm::dvec3 e2(tangents[1]);
  patch.shape = { static_cast<float>(glm::dot(e1, bend * e1)),
    static_cast<float>(glm::dot(e1, bend * e2)), static_cast<float>(glm::dot(e2, bend * e2)) };
  anchor = { place, glm::mat3(point.map.inverse), static_cast<float>(offset) };
  return true;
}

std::vector<int> orderByElement(const std::vector<Location>& places, std::size_t elementCount)
{
  std::vector<int> next(elementCount + 1, 0);
  for (const Location& place : places)
  {
    ++next[place.element + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<int> order(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    order[next[places[i].element]++] = static_cast<int>(i);
  }
  return order;
}

} // namespace hop
