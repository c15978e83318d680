#include "Support/CoincidentPoints.h"

#include "Support/DisjointSets.h"
#include "Support/SortedBy.h"
#include "Support/VectorHash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

namespace hop
{
namespace
{

/// Points whose reaches are in [2^(levelBits l), 2^(levelBits (l + 1))) are of level l. They are looked up in cells
/// that are 2^cellBits times as wide as the largest reach of the level, so 8 to 64 times as wide as a point reaches:
/// few points stand in one cell, and few look into more than one. Chosen by experiment; wider cells hold more points
/// that are compared in vain, narrower ones make more points look into several.
constexpr int levelBits = 3;
constexpr int cellBits = 3;

int levelOf(double reach)
{
  return static_cast<int>(std::floor(static_cast<double>(std::ilogb(reach)) / levelBits));
}

/// Edge of the cells of a level.
/// \param largest absolute value of a coordinate
double cellSize(int level, double largest)
{
  // Numbers of cells are below 2^50 in size: doubles hold them, and those beside them, exactly.
  constexpr int mostBits = 50;
  return std::max(
    std::ldexp(1.0, levelBits * (level + 1) + cellBits), std::ldexp(largest, -mostBits));
}

/// Coordinates that are compared one after the other.
std::array<double, 3> lexical(const glm::dvec3& x)
{
  return { x.x, x.y, x.z };
}

/// Calls use(cell) for all cells from one to another.
template <class Use>
void forCells(const glm::dvec3& lowest, const glm::dvec3& highest, const Use& use)
{
  glm::dvec3 cell;
  for (cell.z = lowest.z; cell.z <= highest.z; ++cell.z)
  {
    for (cell.y = lowest.y; cell.y <= highest.y; ++cell.y)
    {
      for (cell.x = lowest.x; cell.x <= highest.x; ++cell.x)
      {
        use(cell);
      }
    }
  }
}

/// Two places that may be one.
struct Pair
{
  double distance = 0.0;
  int first = -1;
  int second = -1;
};

class Places
{
public:
  Places(const Buffer<RoundedPoint>& points, const ParallelFor& parallelFor)
    : Points(points)
    , Parallel(parallelFor)
    , First(points.size())
    , Reach(points.size())
  {
  }

  std::vector<int> find()
  {
    this->joinEqual();
    std::vector<int> members;
    for (int i = 0; i < static_cast<int>(this->Points.size()); ++i)
    {
      if (this->First[i] == i)
      {
        members.push_back(i);
      }
    }
    std::vector<Pair> pairs = this->pairsAmong(std::move(members));
    return this->joinNearest(std::move(pairs));
  }

private:
  void joinEqual();
  void joinEqualOf(int point, std::vector<int>& places);
  std::vector<Pair> pairsAmong(std::vector<int> members) const;
  void addPairs(const std::vector<int>& members, int level, std::vector<Pair>& pairs) const;
  std::vector<int> joinNearest(std::vector<Pair> pairs);
  const glm::dvec3& at(int point) const { return this->Points[point].position; }

  const Buffer<RoundedPoint>& Points;
  const ParallelFor& Parallel;
  /// For each point the first one of equal coordinates; how far the place reaches that a first point stands for.
  std::vector<int> First;
  std::vector<double> Reach;
};

/// Makes one place of points of equal coordinates. Mostly all points that belong together are equal, and nothing is
/// left to look for.
void Places::joinEqual()
{
  const std::size_t bins = std::max<std::size_t>(1, this->Points.size());
  const Grouping equal = groupedBy(
    this->Points, bins, [bins](const RoundedPoint& point) { return hashOf(point.position) % bins; },
    this->Parallel);
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(bins),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::vector<int> places;
      for (std::ptrdiff_t bin = begin; bin < end; ++bin)
      {
        places.clear();
        for (int n = equal.start[bin]; n < equal.start[bin + 1]; ++n)
        {
          this->joinEqualOf(equal.order[n], places);
        }
      }
    });
}

/// \param places the places found so far; the point's own is among them or is added
void Places::joinEqualOf(int point, std::vector<int>& places)
{
  const double reach = this->Points[point].reach;
  const auto same = std::find_if(
    places.begin(), places.end(), [&](int place) { return this->at(place) == this->at(point); });
  if (same == places.end())
  {
    places.push_back(point);
    this->First[point] = point;
    this->Reach[point] = reach;
  }
  else
  {
    this->First[point] = *same;
    this->Reach[*same] = std::min(this->Reach[*same], reach);
  }
}

/// All pairs of places that reach each other. Levels are taken one by one, the lowest first, in cells of their own
/// size: a place looks for places of its level or of a higher one.
std::vector<Pair> Places::pairsAmong(std::vector<int> members) const
{
  std::vector<Pair> pairs;
  while (!members.empty())
  {
    int level = std::numeric_limits<int>::max();
    for (const int i : members)
    {
      level = std::min(level, levelOf(this->Reach[i]));
    }
    this->addPairs(members, level, pairs);
    members.erase(std::remove_if(members.begin(), members.end(),
                    [&](int i) { return levelOf(this->Reach[i]) == level; }),
      members.end());
  }
  return pairs;
}

/// Adds the pairs in which at least one place is of this level, the lowest of all members.
void Places::addPairs(const std::vector<int>& members, int level, std::vector<Pair>& pairs) const
{
  double largest = 0.0;
  for (const int i : members)
  {
    const glm::dvec3 x = glm::abs(this->at(i));
    largest = std::max({ largest, x.x, x.y, x.z });
  }
  const double size = cellSize(level, largest);
  const std::size_t bins = members.size();
  const auto binOf = [&](const glm::dvec3& cell) { return hashOf(cell) % bins; };
  const Grouping cells = groupedBy(
    members, bins, [&](int i) { return binOf(glm::floor(this->at(i) / size)); }, this->Parallel);
  std::mutex mutex;
  runParallel(this->Parallel, static_cast<std::ptrdiff_t>(members.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      std::vector<Pair> found;
      const auto lookFrom = [&](int i, const glm::dvec3& cell)
      {
        const std::size_t bin = binOf(cell);
        for (int n = cells.start[bin]; n < cells.start[bin + 1]; ++n)
        {
          const int j = members[cells.order[n]];
          const double distance = glm::distance(this->at(i), this->at(j));
          const bool isOther = j > i || levelOf(this->Reach[j]) > level;
          if (isOther && distance <= std::min(this->Reach[i], this->Reach[j]))
          {
            found.push_back({ distance, i, j });
          }
        }
      };
      for (std::ptrdiff_t m = begin; m < end; ++m)
      {
        const int i = members[m];
        const double reach = this->Reach[i];
        if (levelOf(reach) == level)
        {
          forCells(glm::floor((this->at(i) - reach) / size),
            glm::floor((this->at(i) + reach) / size),
            [&](const glm::dvec3& cell) { lookFrom(i, cell); });
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      pairs.insert(pairs.end(), found.begin(), found.end());
    });
}

/// Makes places one, the nearest first (Kruskal's method), equally near ones in the order of their coordinates.
/// \return for each point the first of its place
std::vector<int> Places::joinNearest(std::vector<Pair> pairs)
{
  const auto ends = [&](const Pair& pair) {
    return std::minmax({ lexical(this->at(pair.first)), lexical(this->at(pair.second)) });
  };
  std::sort(pairs.begin(), pairs.end(),
    [&](const Pair& a, const Pair& b)
    {
      // Coordinates are seldom needed, and far off in memory.
      return a.distance != b.distance ? a.distance < b.distance : ends(a) < ends(b);
    });
  DisjointSets places(this->Points.size());
  for (const Pair& pair : pairs)
  {
    const auto [first, second] = std::minmax({ places.root(pair.first), places.root(pair.second) });
    const double reach = std::min(this->Reach[first], this->Reach[second]);
    if (first != second && pair.distance <= reach)
    {
      places.unite(first, second);
      this->Reach[first] = reach;
    }
  }
  for (int& first : this->First)
  {
    first = places.root(first);
  }
  return std::move(this->First);
}

} // namespace

std::vector<int> coincidentPoints(
  const Buffer<RoundedPoint>& points, const ParallelFor& parallelFor)
{
  return Places(points, parallelFor).find();
}

} // namespace hop
