#include "Kernel/MakeKernels.h"

namespace hop::kernel
{

Kernels baselineKernels()
{
#if defined(__GNUC__)
  return makeKernels<2, 2>(); // 128 bits: SSE2, NEON
#else
  return makeKernels<1, 1>();
#endif
}

} // namespace hop::kernel
