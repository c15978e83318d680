#include "AvailableParts.h"

#include <algorithm>
#include <ostream>

namespace hop::testing
{
namespace
{

KernelParts partsOf(InstructionSet set)
{
  switch (set)
  {
#if defined(HOP_X86_KERNELS)
    case InstructionSet::Avx2:
      return avx2Parts();
    case InstructionSet::Avx512:
      return avx512Parts();
#else
    case InstructionSet::Avx2:
    case InstructionSet::Avx512:
#endif
    case InstructionSet::Baseline:
      return baselineParts();
  }
  return {};
}

} // namespace

std::vector<CompiledParts> availableParts()
{
  std::vector<CompiledParts> all;
  for (const InstructionSet set : availableInstructionSets())
  {
    all.push_back({ set, partsOf(set) });
  }
  return all;
}

void PrintTo(const CompiledParts& which, std::ostream* stream)
{
  *stream << nameOf(which.set);
}

std::string nameOfParts(const ::testing::TestParamInfo<CompiledParts>& which)
{
  return nameOfSet({ which.param.set, which.index });
}

std::string nameOfSet(const ::testing::TestParamInfo<InstructionSet>& which)
{
  std::string name = nameOf(which.param);
  name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
  return name;
}

} // namespace hop::testing
