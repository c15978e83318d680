#include "GuardedRuns.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <new>
#include <stdexcept>
#include <thread>

namespace hop::testing
{
namespace
{

using Clock = std::chrono::steady_clock;

/// How a child that has a complaint ends.
constexpr int HasComplaint = 3;

/// What parent and child both see.
struct Shared
{
  std::atomic<std::size_t> item{ 0 };
  char complaint[1000] = "";
  Tally tally;
};

class SharedMemory
{
public:
  SharedMemory()
    : Place(
        mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
  {
    if (this->Place == MAP_FAILED)
    {
      throw std::runtime_error("no shared memory");
    }
    new (this->Place) Shared;
  }
  ~SharedMemory() { munmap(this->Place, sizeof(Shared)); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  Shared& operator*() const { return *static_cast<Shared*>(this->Place); }

private:
  void* Place;
};

/// Seconds of a child's processor time; 0 once it has ended.
double processorTimeOf(pid_t child)
{
  clockid_t clock{};
  timespec time{};
  return clock_getcpuclockid(child, &clock) == 0 && clock_gettime(clock, &time) == 0
    ? static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec)
    : 0.0;
}

[[noreturn]] void workAsChild(std::size_t begin, std::size_t count, Shared& shared,
  const std::function<std::string(std::size_t, Tally&)>& work)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL); // no child is left behind
  for (std::size_t i = begin; i < count; ++i)
  {
    shared.item = i;
    const std::string complaint = work(i, shared.tally);
    if (!complaint.empty())
    {
      complaint.copy(shared.complaint, sizeof(shared.complaint) - 1);
      std::_Exit(HasComplaint);
    }
  }
  shared.item = count;
  std::exit(0); // a sanitizer looks for leaks
}

/// When the work on an item began.
struct Start
{
  std::size_t item;
  double processorTime;
  Clock::time_point time;
};

/// Waits for a child to end, and ends it if an item takes too long.
/// \return what is wrong
std::string watch(pid_t child, Shared& shared, double limit)
{
  Start start{ shared.item, 0.0, Clock::now() };
  for (;;)
  {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child)
    {
      return WIFSIGNALED(status) ? "the process ended by signal " + std::to_string(WTERMSIG(status))
        : WEXITSTATUS(status) == HasComplaint ? shared.complaint
        : WEXITSTATUS(status) != 0
        ? "the process ended with code " + std::to_string(WEXITSTATUS(status))
        : std::string();
    }
    const double now = processorTimeOf(child);
    if (shared.item != start.item)
    {
      start = { shared.item, now, Clock::now() };
    }
    const std::chrono::duration<double> waited = Clock::now() - start.time;
    if (now - start.processorTime > limit || waited.count() > 20.0 * limit)
    {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return "no end after " + std::to_string(limit) + " s";
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

} // namespace

std::vector<Failure> runGuarded(std::size_t count, double limit,
  const std::function<std::string(std::size_t, Tally&)>& work, Tally& tally)
{
  std::vector<Failure> failures;
  const SharedMemory memory;
  Shared& shared = *memory;
  for (std::size_t begin = 0; begin < count;)
  {
    std::fill(std::begin(shared.complaint), std::end(shared.complaint), '\0');
    shared.item = begin;
    std::fflush(nullptr); // else the child would write what waits once more
    const pid_t child = fork();
    if (child < 0)
    {
      throw std::runtime_error("no child process");
    }
    if (child == 0)
    {
      workAsChild(begin, count, shared, work);
    }
    const std::string complaint = watch(child, shared, limit);
    if (!complaint.empty())
    {
      failures.push_back({ shared.item, complaint });
    }
    begin = complaint.empty() ? count : shared.item + 1;
  }
  tally.runs += shared.tally.runs;
  tally.runsWithPoints += shared.tally.runsWithPoints;
  tally.points += shared.tally.points;
  tally.givenUp += shared.tally.givenUp;
  return failures;
}

} // namespace hop::testing
