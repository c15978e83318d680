#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace hop
{

/// A box along the axes.
struct Bounds
{
  glm::dvec3 lower{ 0.0 };
  glm::dvec3 upper{ 0.0 };

  void include(const Bounds& other)
  {
    this->lower = glm::min(this->lower, other.lower);
    this->upper = glm::max(this->upper, other.upper);
  }
  bool overlaps(const Bounds& other) const
  {
    return glm::all(glm::lessThanEqual(this->lower, other.upper)) &&
      glm::all(glm::lessThanEqual(other.lower, this->upper));
  }
  Bounds widened(double by) const { return { this->lower - by, this->upper + by }; }
  double diagonal() const { return glm::distance(this->lower, this->upper); }
};

/// Finds which of many boxes overlap a given one: a bounding-volume tree, halved at the median along
/// the longest side.
class BoxTree
{
public:
  explicit BoxTree(std::vector<Bounds> boxes);

  /// Numbers of the boxes that overlap, ascending.
  std::vector<int> overlapping(const Bounds& box) const;

private:
  /// A leaf holds the boxes Order[first] to Order[last - 1]; another node has the children `first` and
  /// `first` + 1.
  struct Node
  {
    Bounds bounds;
    int first = 0;
    int last = -1;

    bool isLeaf() const { return this->last >= 0; }
  };

  void divide(int node, int first, int last);

  std::vector<Bounds> Boxes;
  std::vector<int> Order;
  std::vector<Node> Nodes;
};

} // namespace hop
