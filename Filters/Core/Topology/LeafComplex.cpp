#include "Topology/LeafComplex.h"

#include <algorithm>
#include <tuple>

namespace hop
{
namespace
{

constexpr int coordinateBits = 17;
constexpr std::uint64_t coordinateMask = (std::uint64_t{ 1 } << coordinateBits) - 1;
static_assert(LeafGrid::Depth < coordinateBits && LeafGrid::Depth < 32);

template <class Item>
typename std::vector<Item>::iterator findPart(std::vector<Item>& items, const LeafPart& part)
{
  const auto found = std::lower_bound(items.begin(), items.end(), part,
    [](const Item& item, const LeafPart& wanted) { return item.part < wanted; });
  return found != items.end() && found->part == part ? found : items.end();
}

/// Calls use(part) for the parts of larger leaves that hold a part, the smallest first, until it returns true.
/// \param isFace whether parts are faces, not edges
template <class Use>
void forLarger(const LeafPart& part, bool isFace, const Use& use)
{
  const int axis = part.axis();
  glm::ivec3 lower = part.lower();
  for (int size = 2 * part.size(); size <= LeafGrid::Size; size *= 2)
  {
    for (int a = 0; a < 3; ++a)
    {
      const bool isFixed = (a == axis) == isFace;
      if (isFixed && lower[a] % size != 0)
      {
        return; // no larger leaf ends here
      }
      lower[a] -= lower[a] % size;
    }
    if (use(LeafPart(size, axis, lower)))
    {
      return;
    }
  }
}

int crossedEdges(const Leaf& leaf, int face)
{
  const auto& edges = edgesOfCubeFace(face);
  return static_cast<int>(std::count_if(
    edges.begin(), edges.end(), [&](int e) { return isCrossed(cubeEdges()[e], leaf.signs); }));
}

} // namespace

LeafPart::LeafPart(int size, int axis, const glm::ivec3& lower)
  : Key(0)
{
  std::uint64_t level = 0;
  while (size << level < LeafGrid::Size)
  {
    ++level;
  }
  this->Key = 4 * level + static_cast<std::uint64_t>(axis);
  for (int a = 0; a < 3; ++a)
  {
    this->Key = this->Key << coordinateBits | static_cast<std::uint64_t>(lower[a]);
  }
}

glm::ivec3 LeafPart::lower() const
{
  return { static_cast<int>(this->Key >> 2 * coordinateBits & coordinateMask),
    static_cast<int>(this->Key >> coordinateBits & coordinateMask),
    static_cast<int>(this->Key & coordinateMask) };
}

LeafPart faceOf(const Leaf& leaf, int face)
{
  glm::ivec3 lower = leaf.lower;
  lower[face / 2] += face % 2 * leaf.size;
  return LeafPart(leaf.size, face / 2, lower);
}

LeafPart edgeOf(const Leaf& leaf, int edge)
{
  const int corner = cubeEdges()[edge].first;
  return LeafPart(leaf.size, cubeEdges()[edge].axis,
    leaf.lower + leaf.size * glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2));
}

bool LeafComplex::Square::isOnBoundary() const
{
  const int plane = this->part.lower()[this->part.axis()];
  return plane == 0 || plane == LeafGrid::Size;
}

LeafComplex::LeafComplex(const ElementLeaves& leaves)
  : Joined(leaves.discs.size())
  , Doubtful(leaves.discs.size(), 0)
{
  this->listSquares(leaves.discs);
  this->joinSquares();
  this->doubtNeighbours(leaves.unresolved);
  this->listPoints(leaves.discs);
}

void LeafComplex::listSquares(const std::vector<Leaf>& discs)
{
  std::vector<Square> all;
  for (int leaf = 0; leaf < static_cast<int>(discs.size()); ++leaf)
  {
    for (int face = 0; face < 6; ++face)
    {
      if (crossedEdges(discs[leaf], face) == 2)
      {
        all.push_back({ faceOf(discs[leaf], face), { leaf, -1 }, face });
      }
    }
  }
  std::sort(all.begin(), all.end(),
    [](const Square& a, const Square& b)
    { return std::tie(a.part, a.leaves[0]) < std::tie(b.part, b.leaves[0]); });
  for (const Square& square : all)
  {
    if (!this->Squares.empty() && this->Squares.back().part == square.part)
    {
      this->Squares.back().leaves[1] = square.leaves[0];
      this->Squares.back().isJoined = true;
    }
    else
    {
      this->Squares.push_back(square);
    }
  }
}

/// Joins leaves at their squares; leaves at squares without another side become doubtful.
void LeafComplex::joinSquares()
{
  for (Square& square : this->Squares)
  {
    if (square.isJoined)
    {
      this->Joined.unite(square.leaves[0], square.leaves[1]);
      continue;
    }
    forLarger(square.part, true,
      [&](const LeafPart& larger)
      {
        const auto behind = findPart(this->Squares, larger);
        if (behind == this->Squares.end())
        {
          return false;
        }
        this->Joined.unite(square.leaves[0], behind->leaves[0]);
        square.isJoined = behind->isJoined = behind->isDivided = true;
        return true;
      });
  }
  for (const Square& square : this->Squares)
  {
    this->Doubtful[square.leaves[0]] |= !square.isJoined && !square.isOnBoundary();
  }
}

/// Marks the leaves of which a part of a face borders on an unresolved leaf.
void LeafComplex::doubtNeighbours(const std::vector<Leaf>& unresolved)
{
  const auto doubt = [this](const LeafPart& part)
  {
    const auto square = findPart(this->Squares, part);
    if (square != this->Squares.end())
    {
      this->Doubtful[square->leaves[0]] = 1;
    }
    return false;
  };
  for (const Leaf& leaf : unresolved)
  {
    for (int face = 0; face < 6; ++face)
    {
      doubt(faceOf(leaf, face));
      forLarger(faceOf(leaf, face), true, doubt);
    }
  }
}

/// Finds which edges of leaves hold the same point: the only point of an edge is that of a part of the edge, if this
/// part holds one.
void LeafComplex::listPoints(const std::vector<Leaf>& discs)
{
  for (int leaf = 0; leaf < static_cast<int>(discs.size()); ++leaf)
  {
    for (int e = 0; e < 12; ++e)
    {
      if (isCrossed(cubeEdges()[e], discs[leaf].signs))
      {
        this->Segments.push_back({ edgeOf(discs[leaf], e), leaf, -1 });
      }
    }
  }
  auto& all = this->Segments;
  std::sort(all.begin(), all.end(),
    [](const Segment& a, const Segment& b)
    { return std::tie(a.part, a.leaf) < std::tie(b.part, b.leaf); });
  all.erase(std::unique(all.begin(), all.end(),
              [](const Segment& a, const Segment& b) { return a.part == b.part; }),
    all.end());
  for (auto segment = all.rbegin(); segment != all.rend(); ++segment)
  {
    if (segment->point < 0)
    {
      segment->point = static_cast<int>(this->Points.size());
      this->Points.push_back(segment->part);
      this->LeafOfPoint.push_back(segment->leaf);
    }
    forLarger(segment->part, false,
      [&](const LeafPart& part)
      {
        const auto larger = findPart(all, part);
        if (larger != all.end())
        {
          const bool isSame = larger->point < 0 || larger->point == segment->point;
          this->Doubtful[larger->leaf] |= !isSame;
          larger->point = segment->point;
        }
        return false;
      });
  }
}

int LeafComplex::pointOn(const LeafPart& edge) const
{
  const auto segment = std::lower_bound(this->Segments.begin(), this->Segments.end(), edge,
    [](const Segment& item, const LeafPart& wanted) { return item.part < wanted; });
  return segment->point;
}

} // namespace hop
