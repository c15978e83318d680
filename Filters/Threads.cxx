#include "Threads.h"

#include "vtkSMP.h"
#include "vtkSMPTools.h"

#include <string>

namespace
{

/// Debian's VTK starts with Sequential although it has STDThread.
std::string chooseBackend()
{
  const std::string current = vtkSMPTools::GetBackend();
  if (current != "Sequential")
  {
    return current;
  }
#if VTK_SMP_ENABLE_TBB
  return "TBB";
#elif VTK_SMP_ENABLE_OPENMP
  return "OpenMP";
#elif VTK_SMP_ENABLE_STDTHREAD
  return "STDThread";
#else
  return current;
#endif
}

} // namespace

void withThreads(const std::function<void()>& work)
{
  vtkSMPTools::Config config;
  config.Backend = chooseBackend();
  vtkSMPTools::LocalScope(config, work);
}

hop::ParallelFor smpParallelFor()
{
  return [](std::ptrdiff_t count, const hop::LoopBody& body)
  { vtkSMPTools::For(0, count, [&](vtkIdType begin, vtkIdType end) { body(begin, end); }); };
}
