#include "Kernel/MakeKernels.h"

// Compiled with AVX2 and FMA switched on; called only where the processor has them.
namespace hop::kernel
{

Kernels avx2Kernels()
{
  return makeKernels<DoublesIn<256>, DoublesIn<256>>();
}

} // namespace hop::kernel
