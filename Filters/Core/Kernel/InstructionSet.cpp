#include "Kernel/InstructionSet.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>

namespace hop
{
namespace
{

struct CompiledSet
{
  InstructionSet name = InstructionSet::Baseline;
  kernel::Kernels kernels;
};

std::vector<CompiledSet> findAvailable()
{
  std::vector<CompiledSet> sets{ { InstructionSet::Baseline, kernel::baselineKernels() } };
#if defined(HOP_X86_KERNELS)
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2)
  {
    sets.push_back({ InstructionSet::Avx2, kernel::avx2Kernels() });
  }
  if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512vl"))
  {
    sets.push_back({ InstructionSet::Avx512, kernel::avx512Kernels() });
  }
#endif
  return sets;
}

const std::vector<CompiledSet>& available()
{
  static const std::vector<CompiledSet> sets = findAvailable();
  return sets;
}

std::atomic<const CompiledSet*>& inUse()
{
  static std::atomic<const CompiledSet*> set{ &available().back() };
  return set;
}

} // namespace

const char* nameOf(InstructionSet set)
{
  switch (set)
  {
    case InstructionSet::Avx2:
      return "AVX2";
    case InstructionSet::Avx512:
      return "AVX-512";
    default:
      return "baseline";
  }
}

std::vector<InstructionSet> availableInstructionSets()
{
  std::vector<InstructionSet> names;
  for (const CompiledSet& set : available())
  {
    names.push_back(set.name);
  }
  return names;
}

InstructionSet instructionSet()
{
  return inUse().load()->name;
}

void useInstructionSet(InstructionSet set)
{
  const auto found = std::find_if(available().begin(), available().end(),
    [&](const CompiledSet& candidate) { return candidate.name == set; });
  if (found == available().end())
  {
    throw std::invalid_argument(std::string("no evaluator here for ") + nameOf(set));
  }
  inUse() = &*found;
}

const kernel::Kernels& kernel::current()
{
  return inUse().load(std::memory_order_acquire)->kernels;
}

} // namespace hop
