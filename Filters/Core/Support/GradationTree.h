#pragma once

#include "Support/Bounds.h"

#include <vector>

namespace hop
{

/// The spacings that places with small ones allow around them, where spacings may grow by no more than a slope times
/// the distance: the least of spacing plus slope times distance over all places. A bounding-volume tree, halved at the
/// median along the longest side; a node is passed by if its least spacing, at the distance of its bounds, is too much.
class GradationTree
{
public:
  /// A place, and the spacing at it, > 0, in units of length.
  struct Place
  {
    glm::dvec3 position{ 0.0 };
    float spacing = 0.0f;
  };

  /// \param slope growth of the spacing per length at most, > 0
  GradationTree(std::vector<Place> places, double slope);

  /// The spacing that the places allow at a position, or `spacing` if this is less.
  float limited(const glm::dvec3& position, float spacing) const;

  const std::vector<Place>& places() const { return this->Places; }

private:
  /// A leaf holds the places first to last - 1; any other node has the children `first` and `first` + 1.
  struct Node
  {
    Bounds bounds;
    float leastSpacing = 0.0f;
    int first = 0;
    int last = -1;

    bool isLeaf() const { return this->last >= 0; }
  };

  void divide(int node, int first, int last);

  double Slope;
  std::vector<Place> Places;
  std::vector<Node> Nodes;
};

} // namespace hop
