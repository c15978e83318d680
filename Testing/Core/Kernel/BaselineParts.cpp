#include "MakeKernelParts.h"

namespace hop::testing
{

KernelParts baselineParts()
{
  return makeKernelParts<kernel::DoublesIn<128>, kernel::DoublesIn<128>>();
}

} // namespace hop::testing
