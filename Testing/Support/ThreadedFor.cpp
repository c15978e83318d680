#include "ThreadedFor.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace hop::testing
{

ParallelFor threadedFor(int threads)
{
  return [threads](std::ptrdiff_t count, const LoopBody& body)
  {
    constexpr std::ptrdiff_t piece = 7;
    std::atomic<std::ptrdiff_t> next{ 0 };
    const auto work = [&]
    {
      for (std::ptrdiff_t begin = next.fetch_add(piece); begin < count;
           begin = next.fetch_add(piece))
      {
        body(begin, std::min(begin + piece, count));
      }
    };
    std::vector<std::thread> team;
    for (int t = 0; t < threads; ++t)
    {
      team.emplace_back(work);
    }
    for (std::thread& member : team)
    {
      member.join();
    }
  };
}

} // namespace hop::testing
