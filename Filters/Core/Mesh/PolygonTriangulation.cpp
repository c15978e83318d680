#include "Mesh/PolygonTriangulation.h"

#include <cmath>
#include <limits>

namespace hop
{
namespace
{

constexpr double forbidden = std::numeric_limits<double>::infinity();

class Triangulator
{
public:
  Triangulator(const std::vector<int>& polygon, const TriangleCost& cost, double leastCost,
    const MayJoin& mayJoin)
    : Polygon(polygon)
    , Cost(cost)
    , LeastCost(leastCost)
    , MayJoinCorners(mayJoin)
    , Count(static_cast<int>(polygon.size()))
    , Best(polygon.size() * polygon.size(), { 0.0, -1 })
  {
  }

  std::vector<Triangle> run()
  {
    std::vector<Triangle> triangles;
    for (int width = 2; width < this->Count; ++width)
    {
      for (int first = 0; first + width < this->Count; ++first)
      {
        this->solve(first, first + width);
      }
    }
    if (this->Count >= 3 && std::isfinite(this->best(0, this->Count - 1).cost))
    {
      this->collect(0, this->Count - 1, triangles);
    }
    return triangles;
  }

private:
  struct Solution
  {
    double cost = 0.0;
    int apex = -1;
  };

  Solution& best(int first, int last) { return this->Best[first * this->Count + last]; }

  /// The best triangulation of the corners from `first` to `last`.
  void solve(int first, int last)
  {
    Solution& solution = this->best(first, last);
    solution.cost = forbidden;
    const bool isPolygonEdge = first == 0 && last == this->Count - 1;
    if (!isPolygonEdge && !this->MayJoinCorners(this->Polygon[first], this->Polygon[last]))
    {
      return;
    }
    for (int apex = first + 1; apex < last; ++apex)
    {
      const double others = this->best(first, apex).cost + this->best(apex, last).cost;
      if (others + this->LeastCost < solution.cost)
      {
        const double whole =
          others + this->Cost({ this->Polygon[first], this->Polygon[apex], this->Polygon[last] });
        if (whole < solution.cost)
        {
          solution = { whole, apex };
        }
      }
    }
  }

  void collect(int first, int last, std::vector<Triangle>& triangles)
  {
    if (last - first >= 2)
    {
      const int apex = this->best(first, last).apex;
      triangles.push_back({ this->Polygon[first], this->Polygon[apex], this->Polygon[last] });
      this->collect(first, apex, triangles);
      this->collect(apex, last, triangles);
    }
  }

  const std::vector<int>& Polygon;
  const TriangleCost& Cost;
  double LeastCost;
  const MayJoin& MayJoinCorners;
  int Count;
  std::vector<Solution> Best;
};

} // namespace

std::vector<Triangle> triangulatePolygon(const std::vector<int>& polygon, const TriangleCost& cost,
  double leastCost, const MayJoin& mayJoin)
{
  return Triangulator(polygon, cost, leastCost, mayJoin).run();
}

} // namespace hop
