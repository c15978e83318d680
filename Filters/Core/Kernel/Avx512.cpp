#include "Kernel/MakeKernels.h"

// Compiled with AVX-512 switched on; called only where the processor has it.
namespace hop::kernel
{

Kernels avx512Kernels()
{
  // A coefficient (x, y, z, f) has no more than four components.
  return makeKernels<DoublesIn<512>, DoublesIn<256>>();
}

} // namespace hop::kernel
