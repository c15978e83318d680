#include "Common/VtkThreads.h"

#include "Common/ThreadTeam.h"

#include "vtkSMP.h"
#include "vtkSMPTools.h"

#include <string>

namespace
{

/// The best threaded back end, or none.
std::string bestBackend()
{
#if VTK_SMP_ENABLE_TBB
  return "TBB";
#elif VTK_SMP_ENABLE_OPENMP
  return "OpenMP";
#elif VTK_SMP_ENABLE_STDTHREAD
  return "STDThread";
#else
  return "Sequential";
#endif
}

/// Calls work(loops) with loops of vtkSMPTools::For, but of a ThreadTeam where the back end is STDThread: that of VTK
/// 9.1 starts threads for every loop, and in all versions the caller's own thread does nothing meanwhile.
void withLoops(const std::function<void(const hop::ParallelFor&)>& work)
{
  if (std::string(vtkSMPTools::GetBackend()) == "STDThread")
  {
    hop::ThreadTeam team(vtkSMPTools::GetEstimatedNumberOfThreads());
    work([&](std::ptrdiff_t count, const hop::LoopBody& body) { team.run(count, body); });
    return;
  }
  work([](std::ptrdiff_t count, const hop::LoopBody& body)
    { vtkSMPTools::For(0, count, [&](vtkIdType begin, vtkIdType end) { body(begin, end); }); });
}

} // namespace

void withThreads(const std::function<void(const hop::ParallelFor&)>& work)
{
  if (std::string(vtkSMPTools::GetBackend()) != "Sequential")
  {
    withLoops(work);
    return;
  }
  // Debian's VTK begins with Sequential although it has STDThread.
  vtkSMPTools::Config config;
  config.Backend = bestBackend();
  vtkSMPTools::LocalScope(config, [&]() { withLoops(work); });
}
