#pragma once

#include "Support/DisjointSets.h"
#include "Topology/ElementLeaves.h"

namespace hop
{

/// A face or an edge of leaves that the surface crosses, as a number: its size, the axis that a face is normal to or
/// that an edge runs along, and its lower corner. Larger ones come before smaller ones.
class LeafPart
{
public:
  LeafPart(int size, int axis, const glm::ivec3& lower);

  int size() const { return LeafGrid::Size >> (this->Key >> 53); }
  int axis() const { return static_cast<int>(this->Key >> 51 & 3); }
  glm::ivec3 lower() const;

  bool operator<(const LeafPart& other) const { return this->Key < other.Key; }
  bool operator==(const LeafPart& other) const { return this->Key == other.Key; }

private:
  std::uint64_t Key;
};

LeafPart faceOf(const Leaf& leaf, int face);
LeafPart edgeOf(const Leaf& leaf, int edge);

/// How the discs in the leaves of an element are joined: a disc for each leaf, arcs in which discs meet, and points in
/// which arcs end. Where one leaf has several smaller neighbours behind a face, its own arc consists of theirs.
class LeafComplex
{
public:
  explicit LeafComplex(const ElementLeaves& leaves);

  /// A face of a leaf with an arc.
  struct Square
  {
    LeafPart part;
    /// The leaves on its two sides, or the only one.
    std::array<int, 2> leaves{ -1, -1 };
    /// Which face of the first leaf it is.
    int face = 0;
    /// Whether its arc consists of those of smaller squares.
    bool isDivided = false;
    bool isJoined = false;

    /// Whether it lies in a face of the element.
    bool isOnBoundary() const;
  };

  /// An edge of a leaf with a point.
  struct Segment
  {
    LeafPart part;
    int leaf = -1;
    int point = -1;
  };

  const std::vector<Square>& squares() const { return this->Squares; }
  /// The smallest segment of each point.
  const std::vector<LeafPart>& points() const { return this->Points; }
  int leafOfPoint(int point) const { return this->LeafOfPoint[point]; }
  /// The point on an edge of a leaf.
  int pointOn(const LeafPart& edge) const;
  /// The first of the leaves that are joined to a leaf.
  int firstLeaf(int leaf) { return this->Joined.root(leaf); }
  /// Whether a leaf borders on places of which nothing is proven.
  bool isDoubtful(int leaf) const { return this->Doubtful[leaf] != 0; }

private:
  void listSquares(const std::vector<Leaf>& discs);
  void joinSquares();
  void doubtNeighbours(const std::vector<Leaf>& unresolved);
  void listPoints(const std::vector<Leaf>& discs);

  std::vector<Square> Squares;
  std::vector<Segment> Segments;
  std::vector<LeafPart> Points;
  std::vector<int> LeafOfPoint;
  DisjointSets Joined;
  std::vector<char> Doubtful;
};

} // namespace hop
