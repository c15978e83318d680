#include "Kernel/MakeKernels.h"

// Compiled with AVX2 and FMA switched on; only called where the processor has them.
namespace hop::kernel
{

Kernels avx2Kernels()
{
  return makeKernels<4, 4>();
}

} // namespace hop::kernel
