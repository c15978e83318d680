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

  /// Finds the places that may allow less than a spacing somewhere in a ball: one search for many positions.
  /// \param radius >= 0, units of length
  /// \param around receives them, and few that allow nothing less
  void findAround(
    const glm::dvec3& center, double radius, float spacing, std::vector<Place>& around) const;

  /// limited() at a position in the ball of findAround(), with the same spacing.
  float limited(const glm::dvec3& position, float spacing, const std::vector<Place>& around) const;

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
  template <class MayMatter, class Use>
  void visit(const glm::dvec3& position, const MayMatter& mayMatter, const Use& use) const;

  double Slope;
  std::vector<Place> Places;
  std::vector<Node> Nodes;
};

} // namespace hop
