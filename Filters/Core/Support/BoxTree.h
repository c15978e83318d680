#pragma once

#include "Support/Bounds.h"

#include <vector>

namespace hop
{

/// Finds which of many boxes overlap a given one: a bounding-volume tree, halved at the median along
/// the longest side.
class BoxTree
{
public:
  explicit BoxTree(std::vector<Bounds> boxes);

  /// Numbers of the boxes that overlap, ascending.
  std::vector<int> overlapping(const Bounds& box) const;

private:
  /// A leaf holds the boxes Order[first] to Order[last - 1]; any other node has the children `first` and `first` + 1.
  struct Node
  {
    Bounds bounds;
    int first = 0;
    int last = -1;

    bool isLeaf() const { return this->last >= 0; }
  };

  /// Makes the subtree of the boxes Order[first] to Order[last - 1].
  void divide(int node, int first, int last);

  std::vector<Bounds> Boxes;
  std::vector<int> Order;
  std::vector<Node> Nodes;
};

} // namespace hop
