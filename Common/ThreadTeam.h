#pragma once

#include "Common/Monitor.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

namespace hop
{

/// Threads that wait for loops, for callers whose own threads are started anew for each loop: a run of
/// ours has hundreds, many of them no longer than that takes.
class ThreadTeam
{
public:
  /// \param size threads that a loop runs in, the caller's own among them; at least 1
  explicit ThreadTeam(int size);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Runs a loop, see ParallelFor. Loops within it, and those of a second caller meanwhile, run in the thread
  /// that asks for them.
  void run(std::ptrdiff_t count, const LoopBody& body);

private:
  struct Loop
  {
    const LoopBody& body;
    std::ptrdiff_t count, pieces;
    std::atomic<std::ptrdiff_t> next{ 0 };
    std::atomic<int> helpers{ 0 };

    void take();
  };
  class Opening;
  void help();

  std::vector<std::thread> Helpers;
  std::mutex Mutex;
  std::condition_variable Change;
  std::atomic<bool> Busy{ false };
  // Of these the mutex takes care.
  Loop* Open = nullptr;
  std::size_t LoopCount = 0;
  bool Ends = false;
};

} // namespace hop
