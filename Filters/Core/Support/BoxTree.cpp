#include "Support/BoxTree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hop
{
namespace
{

/// Boxes that are looked at one by one rather than divided further; chosen by experiment. More make long lists of boxes
/// that do not overlap, fewer make a deeper tree.
constexpr int boxesPerLeaf = 4;

} // namespace

BoxTree::BoxTree(std::vector<Bounds> boxes)
  : Boxes(std::move(boxes))
  , Order(this->Boxes.size())
{
  std::iota(this->Order.begin(), this->Order.end(), 0);
  if (!this->Boxes.empty())
  {
    this->Nodes.emplace_back();
    this->divide(0, 0, static_cast<int>(this->Boxes.size()));
  }
}

void BoxTree::divide(int node, int first, int last)
{
  Bounds bounds = this->Boxes[this->Order[first]];
  for (int n = first; n < last; ++n)
  {
    bounds.include(this->Boxes[this->Order[n]]);
  }
  this->Nodes[node] = { bounds, first, last };
  if (last - first <= boxesPerLeaf)
  {
    return;
  }
  const glm::dvec3 size = bounds.upper - bounds.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto key = [&](int box)
  { return std::pair(this->Boxes[box].lower[axis] + this->Boxes[box].upper[axis], box); };
  const int middle = first + (last - first) / 2;
  std::nth_element(this->Order.begin() + first, this->Order.begin() + middle,
    this->Order.begin() + last, [&](int a, int b) { return key(a) < key(b); });
  const int child = static_cast<int>(this->Nodes.size());
  this->Nodes[node] = { bounds, child, -1 };
  this->Nodes.resize(this->Nodes.size() + 2);
  this->divide(child, first, middle);
  this->divide(child + 1, middle, last);
}

std::vector<int> BoxTree::overlapping(const Bounds& box) const
{
  std::vector<int> found;
  std::vector<int> open;
  if (!this->Nodes.empty())
  {
    open.push_back(0);
  }
  while (!open.empty())
  {
    const Node& node = this->Nodes[open.back()];
    open.pop_back();
    if (!node.bounds.overlaps(box))
    {
      continue;
    }
    if (!node.isLeaf())
    {
      open.push_back(node.first);
      open.push_back(node.first + 1);
      continue;
    }
    std::copy_if(this->Order.begin() + node.first, this->Order.begin() + node.last,
      std::back_inserter(found), [&](int b) { return this->Boxes[b].overlaps(box); });
  }
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace hop
