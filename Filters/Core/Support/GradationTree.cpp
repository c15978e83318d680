#include "Support/GradationTree.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hop
{
namespace
{

/// Places that are looked at one by one rather than divided further. Chosen by experiment; it changes the time alone.
constexpr int placesPerLeaf = 6;

/// More than the nodes that wait while a tree is gone through: one a level, and an int counts places.
constexpr std::size_t mostWaiting = 64;

double squaredDistance(const Bounds& bounds, const glm::dvec3& position)
{
  const glm::dvec3 apart =
    glm::max(glm::max(bounds.lower - position, position - bounds.upper), glm::dvec3(0.0));
  return glm::dot(apart, apart);
}

} // namespace

GradationTree::GradationTree(std::vector<Place> places, double slope)
  : Slope(slope)
  , Places(std::move(places))
{
  if (!this->Places.empty())
  {
    this->Nodes.reserve(1 + 4 * this->Places.size() / placesPerLeaf);
    this->Nodes.emplace_back();
    this->divide(0, 0, static_cast<int>(this->Places.size()));
  }
}

/// Makes the subtree of the places first to last - 1.
void GradationTree::divide(int node, int first, int last)
{
  const auto begin = this->Places.begin() + first;
  const auto end = this->Places.begin() + last;
  Bounds bounds{ begin->position, begin->position };
  float least = begin->spacing;
  for (auto place = begin; place != end; ++place)
  {
    bounds.include({ place->position, place->position });
    least = std::min(least, place->spacing);
  }
  this->Nodes[node] = { bounds, least, first, last };
  if (last - first <= placesPerLeaf)
  {
    return;
  }
  const glm::dvec3 size = bounds.upper - bounds.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int middle = first + (last - first) / 2;
  std::nth_element(begin, this->Places.begin() + middle, end,
    [axis](const Place& a, const Place& b) { return a.position[axis] < b.position[axis]; });
  const int child = static_cast<int>(this->Nodes.size());
  this->Nodes[node] = { bounds, least, child, -1 };
  this->Nodes.resize(this->Nodes.size() + 2);
  this->divide(child, first, middle);
  this->divide(child + 1, middle, last);
}

float GradationTree::limited(const glm::dvec3& position, float spacing) const
{
  struct Waiting
  {
    int node;
    double squaredDistance;
  };
  std::array<Waiting, mostWaiting> waiting;
  std::size_t count = 0;
  double least = spacing;
  /// Whether something at a distance, with a spacing, may allow less than what is known.
  const auto mayAllowLess = [&](double squaredDistance, double itsSpacing)
  {
    const double room = least - itsSpacing;
    return room > 0.0 && this->Slope * this->Slope * squaredDistance < room * room;
  };
  const auto waitFor = [&](int node) {
    waiting[count++] = { node, squaredDistance(this->Nodes[node].bounds, position) };
  };
  if (!this->Nodes.empty())
  {
    waitFor(0);
  }
  while (count > 0)
  {
    const Waiting next = waiting[--count];
    const Node& node = this->Nodes[next.node];
    if (!mayAllowLess(next.squaredDistance, node.leastSpacing))
    {
      continue;
    }
    if (node.isLeaf())
    {
      for (int n = node.first; n < node.last; ++n)
      {
        const Place& place = this->Places[n];
        const glm::dvec3 apart = position - place.position;
        if (mayAllowLess(glm::dot(apart, apart), place.spacing))
        {
          least = place.spacing + this->Slope * glm::length(apart);
        }
      }
      continue;
    }
    // The nearer child is looked at first: what it allows often leaves the other one out.
    waitFor(node.first);
    waitFor(node.first + 1);
    if (waiting[count - 1].squaredDistance > waiting[count - 2].squaredDistance)
    {
      std::swap(waiting[count - 1], waiting[count - 2]);
    }
  }
  return static_cast<float>(least);
}

} // namespace hop
