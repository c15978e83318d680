#include "Common/ThreadTeam.h"

#include <algorithm>
#include <system_error>

namespace hop
{

ThreadTeam::ThreadTeam(int size)
{
  try
  {
    for (int n = 1; n < size; ++n)
    {
      this->Helpers.emplace_back([this]() { this->help(); });
    }
  }
  catch (const std::system_error&)
  {
    // The system gives no more threads: the team is as large as it has become.
  }
}

ThreadTeam::~ThreadTeam()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Ends = true;
  }
  this->Change.notify_all();
  for (std::thread& helper : this->Helpers)
  {
    helper.join();
  }
}

/// Runs pieces as long as there are any that no thread has taken.
void ThreadTeam::Loop::take()
{
  for (std::ptrdiff_t piece = this->next++; piece < this->pieces; piece = this->next++)
  {
    this->body(piece * this->count / this->pieces, (piece + 1) * this->count / this->pieces);
  }
}

/// While this object lives, helpers may join the loop; none is in it any more when it is gone.
class ThreadTeam::Opening
{
public:
  Opening(ThreadTeam& team, Loop& loop)
    : Team(team)
    , Opened(loop)
  {
    {
      const std::lock_guard<std::mutex> lock(this->Team.Mutex);
      this->Team.Open = &loop;
      ++this->Team.LoopCount;
    }
    this->Team.Change.notify_all();
  }
  ~Opening()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Team.Mutex);
      this->Team.Open = nullptr;
    }
    while (this->Opened.helpers > 0)
    {
      std::this_thread::yield();
    }
    this->Team.Busy = false;
  }
  Opening(const Opening&) = delete;
  Opening& operator=(const Opening&) = delete;

private:
  ThreadTeam& Team;
  Loop& Opened;
};

void ThreadTeam::run(std::ptrdiff_t count, const LoopBody& body)
{
  // Chosen by experiment. With fewer, threads wait for the last one where pieces take different times; with more, they
  // spend their time taking pieces.
  constexpr std::ptrdiff_t piecesPerThread = 16;
  if (count <= 0)
  {
    return;
  }
  if (this->Helpers.empty() || this->Busy.exchange(true))
  {
    body(0, count);
    return;
  }
  const auto threads = static_cast<std::ptrdiff_t>(this->Helpers.size()) + 1;
  Loop loop{ body, count, std::min(count, piecesPerThread * threads) };
  const Opening opening(*this, loop);
  loop.take();
}

void ThreadTeam::help()
{
  std::size_t seen = 0;
  std::unique_lock<std::mutex> lock(this->Mutex);
  const auto hasWork = [&]() { return this->Ends || (this->Open && this->LoopCount != seen); };
  for (this->Change.wait(lock, hasWork); !this->Ends; this->Change.wait(lock, hasWork))
  {
    Loop& loop = *this->Open;
    seen = this->LoopCount;
    ++loop.helpers;
    lock.unlock();
    loop.take();
    --loop.helpers;
    lock.lock();
  }
}

} // namespace hop
