#include "Kernel/MakeKernels.h"

// Compiled with AVX-512 switched on; only called where the processor has it.
namespace hop::kernel
{

Kernels avx512Kernels()
{
  return makeKernels<8, 4>();
}

} // namespace hop::kernel
