#include "Support/PointBins.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hop
{
namespace
{

/// A key has 64 bits for three numbers of bins.
constexpr int bitsPerAxis = 21;
constexpr std::int64_t binsPerAxis = std::int64_t{ 1 } << bitsPerAxis;

} // namespace

PointBins::PointBins(const std::vector<glm::dvec3>& points, double binSize)
{
  if (points.empty())
  {
    return;
  }
  glm::dvec3 upper = this->Origin = points.front();
  for (const glm::dvec3& p : points)
  {
    this->Origin = glm::min(this->Origin, p);
    upper = glm::max(upper, p);
  }
  const glm::dvec3 extent = upper - this->Origin;
  this->BinSize = std::max(binSize, std::max({ extent.x, extent.y, extent.z }) / (binsPerAxis - 2));

  std::vector<std::uint64_t> keys(points.size());
  std::transform(points.begin(), points.end(), keys.begin(),
    [this](const glm::dvec3& p) { return key(this->binOf(p)); });
  this->Order.resize(points.size());
  std::iota(this->Order.begin(), this->Order.end(), 0);
  std::sort(this->Order.begin(), this->Order.end(),
    [&](int a, int b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  const int count = static_cast<int>(points.size());
  for (int begin = 0, end = 0; begin < count; begin = end)
  {
    const std::uint64_t bin = keys[this->Order[begin]];
    while (end < count && keys[this->Order[end]] == bin)
    {
      ++end;
    }
    this->Bins[bin] = { begin, end };
  }
}

glm::i64vec3 PointBins::binOf(const glm::dvec3& position) const
{
  const glm::dvec3 bin = glm::floor((position - this->Origin) / this->BinSize);
  return glm::i64vec3(glm::clamp(bin, -1.0, static_cast<double>(binsPerAxis - 2)));
}

std::uint64_t PointBins::key(const glm::i64vec3& bin)
{
  // Queries may ask for bin -1, just outside of the bounds; numbers are shifted by one so that it has a key.
  const glm::u64vec3 b(bin + std::int64_t{ 1 });
  return (b.z << (2 * bitsPerAxis)) | (b.y << bitsPerAxis) | b.x;
}

NeighborLists findNeighbors(const std::vector<glm::dvec3>& points, const std::vector<double>& radii,
  const ParallelFor& parallelFor)
{
  NeighborLists lists;
  lists.start.assign(points.size() + 1, 0);
  if (points.empty())
  {
    return lists;
  }
  const PointBins bins(points, *std::max_element(radii.begin(), radii.end()));
  const auto forEachNeighbor = [&](std::size_t i, const auto& use)
  {
    bins.visit(points[i], radii[i],
      [&](int j)
      {
        const glm::dvec3 d = points[j] - points[i];
        if (static_cast<std::size_t>(j) != i && glm::dot(d, d) <= radii[i] * radii[i])
        {
          use(j);
        }
      });
  };
  const auto count = static_cast<std::ptrdiff_t>(points.size());
  runParallel(parallelFor, count,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        forEachNeighbor(i, [&](int) { ++lists.start[i + 1]; });
      }
    });
  std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
  lists.neighbor.resize(lists.start.back());
  runParallel(parallelFor, count,
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        std::size_t next = lists.start[i];
        forEachNeighbor(i, [&](int j) { lists.neighbor[next++] = j; });
      }
    });
  return lists;
}

} // namespace hop
