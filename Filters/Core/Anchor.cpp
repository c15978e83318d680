#include "Anchor.h"

#include <cmath>
#include <numeric>

namespace hop
{
namespace
{

/// Indices of items sorted by a number below `count`, stably.
template <class Item, class NumberOf>
std::vector<int> sortedBy(
  const std::vector<Item>& items, std::size_t count, const NumberOf& numberOf)
{
  std::vector<int> next(count + 1, 0);
  for (const Item& item : items)
  {
    ++next[numberOf(item) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<int> order(items.size());
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    order[next[numberOf(items[i])]++] = static_cast<int>(i);
  }
  return order;
}

} // namespace

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
  return sortedBy(places, elementCount, [](const Location& place) { return place.element; });
}

std::vector<int> orderByElement(const std::vector<Anchor>& anchors, std::size_t elementCount)
{
  return sortedBy(anchors, elementCount, [](const Anchor& anchor) { return anchor.place.element; });
}

} // namespace hop
