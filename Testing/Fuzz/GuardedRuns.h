#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hop::testing
{

struct Failure
{
  std::size_t item;
  std::string complaint;
};

/// What child processes have done.
struct Tally
{
  /// Of the filter; those that gave particles or triangles; their points; runs that took too long and were aborted.
  std::atomic<std::int64_t> runs{ 0 }, runsWithPoints{ 0 }, points{ 0 }, givenUp{ 0 };
};

/// Calls work(i, tally) for i in [0, count) in child processes: none of them can end this process by a crash, nor hold it up.
/// \param work returns what is wrong, an empty text if nothing is; a child ends with its first complaint, and the next
/// child goes on behind it
/// \param limit seconds of processor time for an item; on the clock, twenty times as many
/// \param tally receives what has been done, by crashed children, too
/// \return items with complaints, items at which a child has crashed or was stopped, and `count` where a sanitizer found
/// something as a child ended
std::vector<Failure> runGuarded(std::size_t count, double limit,
  const std::function<std::string(std::size_t, Tally&)>& work, Tally& tally);

} // namespace hop::testing
