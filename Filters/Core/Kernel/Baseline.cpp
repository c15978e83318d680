#include "Kernel/MakeKernels.h"

// For any processor of the architecture: 128 bits (SSE2, NEON).
namespace hop::kernel
{

Kernels baselineKernels()
{
  return makeKernels<DoublesIn<128>, DoublesIn<128>>();
}

} // namespace hop::kernel
