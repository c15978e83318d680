#include "LatticeTopology.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace hop::testing
{
namespace
{

/// Points of the lattice by number.
struct Lattice
{
  int n = 1;

  int pointOf(const glm::ivec3& p) const { return p.x + (n + 1) * (p.y + (n + 1) * p.z); }
  glm::dvec3 placeOf(const glm::ivec3& p) const { return 2.0 / n * glm::dvec3(p) - 1.0; }
};

/// The polygons of marching tetrahedra without their places: each corner is an edge of a tetrahedron, each side a
/// triangle.
class Polygons
{
public:
  Polygons(const Field& field, int n)
    : Grid{ n }
  {
    this->Positive.resize(static_cast<std::size_t>(n + 1) * (n + 1) * (n + 1));
    this->forPoints(n + 1,
      [&](const glm::ivec3& p)
      { this->Positive[this->Grid.pointOf(p)] = field(this->Grid.placeOf(p)) > 0.0; });
    this->forPoints(n, [&](const glm::ivec3& p) { this->addCube(p); });
  }

  std::vector<std::pair<int, int>> components()
  {
    std::map<int, int> euler, loops;
    for (const auto& [edge, corner] : this->Corners)
    {
      ++euler[this->root(corner)];
    }
    for (const int corner : this->Faces)
    {
      ++euler[this->root(corner)];
    }
    std::vector<int> along(this->Parent.size());
    std::iota(along.begin(), along.end(), 0);
    const auto rootAlong = [&](int c)
    {
      while (along[c] != c)
      {
        c = along[c] = along[along[c]];
      }
      return c;
    };
    std::vector<char> isOnBoundary(this->Parent.size(), 0);
    for (const auto& [triangle, side] : this->Sides)
    {
      --euler[this->root(side.corners[0])];
      if (side.count == 1)
      {
        along[rootAlong(side.corners[0])] = rootAlong(side.corners[1]);
        isOnBoundary[side.corners[0]] = isOnBoundary[side.corners[1]] = 1;
      }
    }
    for (int corner = 0; corner < static_cast<int>(along.size()); ++corner)
    {
      loops[this->root(corner)] += isOnBoundary[corner] && rootAlong(corner) == corner;
    }
    std::vector<std::pair<int, int>> result;
    for (const auto& [root, number] : euler)
    {
      result.emplace_back(number, loops[root]);
    }
    std::sort(result.begin(), result.end());
    return result;
  }

private:
  struct Side
  {
    std::array<int, 2> corners{};
    int count = 0;
  };

  template <class Use>
  void forPoints(int count, const Use& use)
  {
    for (int k = 0; k < count; ++k)
    {
      for (int j = 0; j < count; ++j)
      {
        for (int i = 0; i < count; ++i)
        {
          use(glm::ivec3(i, j, k));
        }
      }
    }
  }

  /// Kuhn's six tetrahedra: from one corner to the opposite one along the three axes in all orders.
  void addCube(const glm::ivec3& p)
  {
    std::array<int, 3> axes{ 0, 1, 2 };
    do
    {
      std::array<int, 4> corners{ this->Grid.pointOf(p), 0, 0, 0 };
      glm::ivec3 at = p;
      for (int n = 0; n < 3; ++n)
      {
        ++at[axes[n]];
        corners[n + 1] = this->Grid.pointOf(at);
      }
      this->addTetrahedron(corners);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  /// \param corners ascending
  void addTetrahedron(const std::array<int, 4>& corners)
  {
    std::vector<int> crossed;
    for (int left = 0; left < 4; ++left)
    {
      std::array<int, 3> triangle{};
      std::copy_if(corners.begin(), corners.end(), triangle.begin(),
        [&](int c) { return c != corners[left]; });
      this->addTriangle(triangle, crossed);
    }
    if (!crossed.empty())
    {
      this->Faces.push_back(crossed.front());
      for (const int corner : crossed)
      {
        this->Parent[this->root(corner)] = this->root(crossed.front());
      }
    }
  }

  void addTriangle(const std::array<int, 3>& triangle, std::vector<int>& crossed)
  {
    std::vector<int> ends;
    for (int a = 0; a < 3; ++a)
    {
      for (int b = a + 1; b < 3; ++b)
      {
        if (this->Positive[triangle[a]] != this->Positive[triangle[b]])
        {
          const auto [entry, isNew] = this->Corners.try_emplace(
            { triangle[a], triangle[b] }, static_cast<int>(this->Parent.size()));
          if (isNew)
          {
            this->Parent.push_back(entry->second);
          }
          ends.push_back(entry->second);
        }
      }
    }
    if (!ends.empty())
    {
      Side& side = this->Sides[triangle];
      side.corners = { ends[0], ends[1] };
      ++side.count;
      crossed.insert(crossed.end(), ends.begin(), ends.end());
    }
  }

  int root(int corner)
  {
    while (this->Parent[corner] != corner)
    {
      corner = this->Parent[corner] = this->Parent[this->Parent[corner]];
    }
    return corner;
  }

  Lattice Grid;
  std::vector<char> Positive;
  std::map<std::pair<int, int>, int> Corners;
  std::map<std::array<int, 3>, Side> Sides;
  /// A corner of each polygon.
  std::vector<int> Faces;
  std::vector<int> Parent;
};

} // namespace

std::vector<std::pair<int, int>> latticeTopology(const Field& field, int n)
{
  return Polygons(field, n).components();
}

} // namespace hop::testing
