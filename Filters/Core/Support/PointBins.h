#pragma once

#include "Common/Monitor.h"
#include "Support/VectorHash.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hop
{

/// A uniform grid of bins over points in world space. Memory in proportion to the points: only bins
/// that hold points exist.
class PointBins
{
public:
  /// \param binSize edge of a bin, > 0; widened if the bounds would not fit 2^21 bins a direction
  PointBins(const std::vector<glm::dvec3>& points, double binSize);

  /// Calls visit(index) for every point in the bins that overlap the cube of half-width `radius` around a position, in
  /// a fixed order. Some points are farther than the radius: the caller tests.
  template <class Visit>
  void visit(const glm::dvec3& position, double radius, const Visit& visit) const;

  /// Whether holds(index) is true of one of these points; the others are not tested any more.
  template <class Holds>
  bool anyOf(const glm::dvec3& position, double radius, const Holds& holds) const;

private:
  glm::i64vec3 binOf(const glm::dvec3& position) const;
  static std::uint64_t key(const glm::i64vec3& bin);

  glm::dvec3 Origin{ 0.0 };
  double BinSize = 1.0;
  std::vector<int> Order;                                      // point indices, bin by bin
  std::unordered_map<std::uint64_t, std::pair<int, int>> Bins; // range in Order
};

/// Bins to which points are added one by one.
class GrowingBins
{
public:
  /// \param binSize edge of a bin, > 0
  explicit GrowingBins(double binSize)
    : BinSize(binSize)
  {
  }

  void insert(int index, const glm::dvec3& position)
  {
    this->Bins[hashOf(this->binOf(position))].push_back(index);
  }

  /// Calls visit(index) for the points in the 27 bins around a position: for all within binSize of it, and for some
  /// farther off. Cells of equal hash share a bin, so that some may be far off.
  template <class Visit>
  void visit(const glm::dvec3& position, const Visit& visit) const;

private:
  glm::dvec3 binOf(const glm::dvec3& position) const
  {
    return glm::floor(position / this->BinSize);
  }

  double BinSize;
  std::unordered_map<std::uint64_t, std::vector<int>> Bins;
};

/// Lists of neighbours, one after the other: the neighbours of i are at [start[i], start[i + 1]).
struct NeighborLists
{
  std::vector<std::size_t> start;
  std::vector<int> neighbor;
};

/// For every point i the other points within radii[i] of it, in a fixed order.
NeighborLists findNeighbors(const std::vector<glm::dvec3>& points, const std::vector<double>& radii,
  const ParallelFor& parallelFor);

template <class Holds>
bool PointBins::anyOf(const glm::dvec3& position, double radius, const Holds& holds) const
{
  const glm::i64vec3 lower = this->binOf(position - radius);
  const glm::i64vec3 upper = this->binOf(position + radius);
  for (auto z = lower.z; z <= upper.z; ++z)
  {
    for (auto y = lower.y; y <= upper.y; ++y)
    {
      for (auto x = lower.x; x <= upper.x; ++x)
      {
        const auto bin = this->Bins.find(key({ x, y, z }));
        for (int i = bin == this->Bins.end() ? 0 : bin->second.first;
             bin != this->Bins.end() && i < bin->second.second; ++i)
        {
          if (holds(this->Order[i]))
          {
            return true;
          }
        }
      }
    }
  }
  return false;
}

template <class Visit>
void PointBins::visit(const glm::dvec3& position, double radius, const Visit& visit) const
{
  this->anyOf(position, radius,
    [&](int index)
    {
      visit(index);
      return false;
    });
}

template <class Visit>
void GrowingBins::visit(const glm::dvec3& position, const Visit& visit) const
{
  const glm::dvec3 middle = this->binOf(position);
  for (int n = 0; n < 27; ++n)
  {
    const auto bin =
      this->Bins.find(hashOf(middle + glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
    for (std::size_t i = 0; bin != this->Bins.end() && i < bin->second.size(); ++i)
    {
      visit(bin->second[i]);
    }
  }
}

} // namespace hop
