#include "Mesh/ConvexHull.h"

#include <cmath>
#include <set>

namespace hop
{
namespace
{

/// Adds one point after the other, by what it sees of the hull of those before (beneath and beyond).
class Hull
{
public:
  explicit Hull(const std::vector<glm::dvec3>& points)
    : Points(points)
  {
  }

  std::vector<Triangle> run()
  {
    if (!this->begin())
    {
      return {};
    }
    for (int p = 0; p < static_cast<int>(this->Points.size()); ++p)
    {
      this->add(p);
    }
    return this->Triangles;
  }

private:
  glm::dvec3 doubleArea(const Triangle& t) const
  {
    return glm::cross(
      this->Points[t[1]] - this->Points[t[0]], this->Points[t[2]] - this->Points[t[0]]);
  }

  /// Six times the volume between a triangle and a point, positive outside of it.
  double volume(const Triangle& t, int point) const
  {
    return glm::dot(this->doubleArea(t), this->Points[point] - this->Points[t[0]]);
  }

  template <class Measure>
  int farthest(const Measure& measure) const
  {
    int best = 0;
    for (int p = 1; p < static_cast<int>(this->Points.size()); ++p)
    {
      best = measure(p) > measure(best) ? p : best;
    }
    return best;
  }

  /// Starts with a tetrahedron of points that are far from each other.
  bool begin()
  {
    if (this->Points.empty())
    {
      return false;
    }
    const auto& x = this->Points;
    const int a = 0;
    const int b = this->farthest([&](int p) { return glm::distance(x[p], x[a]); });
    const int c = this->farthest([&](int p) { return glm::length(this->doubleArea({ a, b, p })); });
    const int d = this->farthest([&](int p) { return std::abs(this->volume({ a, b, c }, p)); });
    const double length = glm::distance(x[b], x[a]);
    constexpr double rounding = 1e-9;
    this->Least = rounding * length * length * length;
    const double six = this->volume({ a, b, c }, d);
    if (!(std::abs(six) > this->Least))
    {
      return false;
    }
    const auto& [p, q] = six < 0.0 ? Edge{ b, c } : Edge{ c, b };
    this->Triangles = { { a, p, q }, { a, d, p }, { p, d, q }, { q, d, a } };
    return true;
  }

  /// Replaces the triangles that a point sees by those between it and their border.
  void add(int point)
  {
    std::vector<Triangle> kept;
    std::set<Edge> border;
    for (const Triangle& t : this->Triangles)
    {
      if (this->volume(t, point) <= this->Least)
      {
        kept.push_back(t);
        continue;
      }
      for (int n = 0; n < 3; ++n)
      {
        const Edge edge{ t[n], t[(n + 1) % 3] };
        if (border.erase({ edge[1], edge[0] }) == 0)
        {
          border.insert(edge);
        }
      }
    }
    for (const Edge& edge : border)
    {
      kept.push_back({ edge[0], edge[1], point });
    }
    this->Triangles = std::move(kept);
  }

  using Edge = std::array<int, 2>;
  const std::vector<glm::dvec3>& Points;
  std::vector<Triangle> Triangles;
  /// Volume that is none.
  double Least = 0.0;
};

} // namespace

std::vector<Triangle> convexHull(const std::vector<glm::dvec3>& points)
{
  return Hull(points).run();
}

} // namespace hop
