#include "MakeKernelParts.h"

namespace hop::testing
{

KernelParts avx512Parts()
{
  return makeKernelParts<kernel::DoublesIn<512>, kernel::DoublesIn<256>>();
}

} // namespace hop::testing
