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

/// Threads that wait for loops, for callers whose own threads are started anew for each loop: a run has hundreds of
/// loops, and many take no longer than the start of a thread.
class ThreadTeam
{
public:
  /// \param size threads that a loop runs in, the caller's own included; at least 1
  explicit ThreadTeam(int size);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Runs a loop, see ParallelFor. Loops that are asked for meanwhile, by its own body or by a second caller, run in
  /// the thread that asks.
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
  // The members below are read and written only by the thread that holds the mutex.
  Loop* Open = nullptr;
  std::size_t LoopCount = 0;
  bool Ends = false;
};

} // namespace hop
