#include "MakeKernelParts.h"

namespace hop::testing
{

KernelParts avx2Parts()
{
  return makeKernelParts<kernel::DoublesIn<256>, kernel::DoublesIn<256>>();
}

} // namespace hop::testing
