#pragma once

#include "Common/Monitor.h"

#include <cstddef>
#include <vector>

namespace hop
{

/// Thins out items that stand too near to each other: one item after the other is kept, in ascending order, if none
/// that was kept before is too near to it. Threads settle the items that have nobody before them nearby; the others, as
/// a rule few, are settled one by one. The result is the same for any number of threads.
/// \param wanted a mark for each candidate; a candidate without one is dropped, and keeps no other away
/// \param count of all items, >= wanted.size(); those behind the candidates are kept in any case
/// \param visitNear visitNear(i, use) calls use(j) for every j that is too near to i and stands before i or behind the
///   candidates; it may call use for other items as well. Called from several threads
/// \return a mark for each candidate
template <class VisitNear>
std::vector<char> keepFirst(std::vector<char> wanted, std::size_t count,
  const ParallelFor& parallelFor, const VisitNear& visitNear)
{
  const std::size_t candidates = wanted.size();
  wanted.resize(count, 1);
  const auto isClearOf = [&](const std::vector<char>& marks, std::size_t i)
  {
    bool clear = true;
    visitNear(
      i, [&](std::size_t j) { clear = clear && !(marks[j] && (j < i || j >= candidates)); });
    return clear;
  };
  std::vector<char> kept = wanted;
  forAll(
    parallelFor, candidates, [&](std::size_t i) { kept[i] = wanted[i] && isClearOf(wanted, i); });
  for (std::size_t i = 0; i < candidates; ++i)
  {
    if (wanted[i] && !kept[i])
    {
      kept[i] = isClearOf(kept, i);
    }
  }
  kept.resize(candidates);
  return kept;
}

} // namespace hop
