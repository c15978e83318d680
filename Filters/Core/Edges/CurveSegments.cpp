#include "Edges/CurveSegments.h"

#include <algorithm>

namespace hop
{
namespace
{

/// Pairs of particles along curves: on boundary curves, and in the order of curves of which a part is a crease.
struct CurvePairs
{
  std::vector<std::array<int, 2>> segments, ordered;
};

/// Adds a pair from particle to particle, along one curve.
class Chain
{
public:
  Chain(CurvePairs& pairs, bool hasCrease)
    : Pairs(pairs)
    , HasCrease(hasCrease)
  {
  }

  /// \param place whose particle, or stand-in, is next
  void goOn(const CurvePlace& place)
  {
    const int particle = place.particle >= 0 ? place.particle : place.standIn;
    const bool isOwn = place.particle >= 0;
    if (this->Last >= 0)
    {
      if (!this->IsCrease)
      {
        this->Pairs.segments.push_back({ this->Last, particle });
      }
      if (this->HasCrease && isOwn && this->IsOwn)
      {
        this->Pairs.ordered.push_back({ this->Last, particle });
      }
    }
    this->Last = particle;
    this->IsCrease = place.beginsCrease;
    this->IsOwn = isOwn;
  }
  void breakOff() { this->Last = -1; }

private:
  CurvePairs& Pairs;
  bool HasCrease;
  int Last = -1;
  bool IsCrease = false;
  bool IsOwn = false;
};

/// The places of a curve, a closed one from a place with a particle on and once round to it.
std::vector<CurvePlace> unrolled(const std::vector<CurvePlace>& places, const CurveRange& curve)
{
  const auto begin = places.begin() + static_cast<std::ptrdiff_t>(curve.first);
  std::vector<CurvePlace> result(begin, begin + static_cast<std::ptrdiff_t>(curve.count));
  if (curve.closed && !result.empty())
  {
    const auto first = std::find_if(
      result.begin(), result.end(), [](const CurvePlace& place) { return place.particle >= 0; });
    std::rotate(result.begin(), first == result.end() ? result.begin() : first, result.end());
    result.push_back(result.front());
  }
  return result;
}

CurvePairs pairsOf(
  const std::vector<CurvePlace>& places, const std::vector<CurveRange>& curves, bool allAreOrdered)
{
  CurvePairs pairs;
  for (const CurveRange& curve : curves)
  {
    const std::vector<CurvePlace> way = unrolled(places, curve);
    const auto hasParticle = [&way](std::size_t n)
    { return n < way.size() && way[n].particle >= 0; };
    Chain chain(pairs,
      allAreOrdered ||
        std::any_of(
          way.begin(), way.end(), [](const CurvePlace& place) { return place.beginsCrease; }));
    for (std::size_t n = 0; n < way.size(); ++n)
    {
      const bool isBetweenTwo = n > 0 && hasParticle(n - 1) && hasParticle(n + 1);
      if (way[n].isGap)
      {
        chain.breakOff();
      }
      else if (hasParticle(n) || (way[n].standIn >= 0 && !isBetweenTwo))
      {
        chain.goOn(way[n]);
      }
    }
  }
  return pairs;
}

/// The indices that are left of a row after some have been dropped.
std::vector<int> numbersOf(const std::vector<char>& kept)
{
  std::vector<int> numbers(kept.size());
  for (std::size_t i = 1; i < kept.size(); ++i)
  {
    numbers[i] = numbers[i - 1] + (kept[i - 1] != 0);
  }
  return numbers;
}

} // namespace

void sortPairs(std::vector<std::array<int, 2>>& pairs)
{
  for (std::array<int, 2>& pair : pairs)
  {
    std::sort(pair.begin(), pair.end());
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                [](const std::array<int, 2>& pair) { return pair[0] == pair[1]; }),
    pairs.end());
}

std::vector<std::array<int, 2>> segmentsOf(
  const std::vector<CurvePlace>& places, const std::vector<CurveRange>& curves)
{
  std::vector<std::array<int, 2>> segments = pairsOf(places, curves, false).segments;
  sortPairs(segments);
  return segments;
}

std::vector<std::array<int, 2>> directedEdgesOf(
  const std::vector<CurvePlace>& places, const std::vector<CurveRange>& curves, bool all)
{
  std::vector<std::array<int, 2>> edges = pairsOf(places, curves, all).ordered;
  for (std::array<int, 2>& edge : edges)
  {
    std::swap(edge[0], edge[1]);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void renumber(std::vector<std::array<int, 2>>& pairs, const std::vector<char>& kept)
{
  const std::vector<int> numbers = numbersOf(kept);
  for (std::array<int, 2>& pair : pairs)
  {
    pair = { numbers[pair[0]], numbers[pair[1]] };
  }
}

std::vector<std::array<int, 2>> withoutDropped(
  const std::vector<std::array<int, 2>>& pairs, const std::vector<char>& kept)
{
  std::vector<std::vector<int>> neighbors(kept.size());
  for (const auto& [a, b] : pairs)
  {
    neighbors[a].push_back(b);
    neighbors[b].push_back(a);
  }
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    if (kept[i])
    {
      continue;
    }
    const std::vector<int> around = std::move(neighbors[i]);
    for (const int a : around)
    {
      std::vector<int>& others = neighbors[a];
      others.erase(std::remove(others.begin(), others.end(), static_cast<int>(i)), others.end());
    }
    if (around.size() == 2)
    {
      neighbors[around[0]].push_back(around[1]);
      neighbors[around[1]].push_back(around[0]);
    }
    neighbors[i].clear();
  }
  const std::vector<int> numbers = numbersOf(kept);
  std::vector<std::array<int, 2>> result;
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    for (const int other : neighbors[i])
    {
      result.push_back({ numbers[i], numbers[other] });
    }
  }
  sortPairs(result);
  return result;
}

} // namespace hop
