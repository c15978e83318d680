#include "Support/GradationTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hop
{
namespace
{

/// Places that are looked at one by one rather than divided further. Chosen by experiment; it changes the time alone.
constexpr int placesPerLeaf = 6;

/// More than the nodes that wait while a tree is gone through: one a level, and an int counts places.
constexpr std::size_t mostWaiting = 64;

inline double squaredDistance(const Bounds& bounds, const glm::dvec3& position)
{
  const glm::dvec3 apart =
    glm::max(glm::max(bounds.lower - position, position - bounds.upper), glm::dvec3(0.0));
  return glm::dot(apart, apart);
}

/// The least spacing that some places allow at a position.
struct Allowance
{
  double slope;
  double least;

  /// Whether a place with a spacing, or one in bounds with that least spacing, may allow less than what is known.
  bool mayFall(double squaredDistance, double spacing) const
  {
    const double room = this->least - spacing;
    return room > 0.0 && this->slope * this->slope * squaredDistance < room * room;
  }

  void lower(double squaredDistance, double spacing)
  {
    if (this->mayFall(squaredDistance, spacing))
    {
      this->least = spacing + this->slope * std::sqrt(squaredDistance);
    }
  }
};

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

/// Goes through the places, the nearer half of each node first.
/// \param mayMatter called with the squared distance of a node's bounds, and with its least spacing: whether its places
///   are to be looked at
/// \param use called with a place, and with its squared distance
template <class MayMatter, class Use>
void GradationTree::visit(
  const glm::dvec3& position, const MayMatter& mayMatter, const Use& use) const
{
  struct Waiting
  {
    int node;
    double squaredDistance;
  };
  const auto at = [&](int node) -> Waiting {
    return { node, squaredDistance(this->Nodes[node].bounds, position) };
  };
  const auto isWanted = [&](const Waiting& some)
  { return mayMatter(some.squaredDistance, this->Nodes[some.node].leastSpacing); };
  std::array<Waiting, mostWaiting> waiting;
  std::size_t count = 0;
  if (!this->Nodes.empty())
  {
    waiting[count++] = at(0);
  }
  while (count > 0)
  {
    Waiting next = waiting[--count];
    bool isNextWanted = isWanted(next);
    // Down to a leaf. The nearer child is looked at first: what it allows often leaves the other one out.
    while (isNextWanted && !this->Nodes[next.node].isLeaf())
    {
      const int first = this->Nodes[next.node].first;
      next = at(first + 1);
      Waiting other = at(first);
      if (next.squaredDistance > other.squaredDistance)
      {
        std::swap(next, other);
      }
      isNextWanted = isWanted(next);
      if (isWanted(other))
      {
        waiting[count++] = other;
      }
    }
    for (int n = this->Nodes[next.node].first; isNextWanted && n < this->Nodes[next.node].last; ++n)
    {
      const glm::dvec3 apart = position - this->Places[n].position;
      use(this->Places[n], glm::dot(apart, apart));
    }
  }
}

float GradationTree::limited(const glm::dvec3& position, float spacing) const
{
  Allowance allowance{ this->Slope, spacing };
  this->visit(
    position,
    [&](double squared, double itsSpacing) { return allowance.mayFall(squared, itsSpacing); },
    [&](const Place& place, double squared) { allowance.lower(squared, place.spacing); });
  return static_cast<float>(allowance.least);
}

void GradationTree::findAround(
  const glm::dvec3& center, double radius, float spacing, std::vector<Place>& around) const
{
  // More than rounding errors.
  constexpr double slack = 1e-6;
  const double reach = (1.0 + slack) * radius;
  // What is allowed everywhere in the ball.
  double most = spacing;
  const auto mayMatter = [&](double squared, double itsSpacing)
  {
    const double farthest = reach + (most - itsSpacing) / this->Slope;
    return itsSpacing < most && squared < farthest * farthest;
  };
  around.clear();
  this->visit(center, mayMatter,
    [&](const Place& place, double squared)
    {
      if (mayMatter(squared, place.spacing))
      {
        around.push_back(place);
        most = std::min(most, place.spacing + this->Slope * (std::sqrt(squared) + reach));
      }
    });
}

float GradationTree::limited(
  const glm::dvec3& position, float spacing, const std::vector<Place>& around) const
{
  Allowance allowance{ this->Slope, spacing };
  for (const Place& place : around)
  {
    const glm::dvec3 apart = position - place.position;
    allowance.lower(glm::dot(apart, apart), place.spacing);
  }
  return static_cast<float>(allowance.least);
}

} // namespace hop
