#include "Kernel/InstructionSet.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>

#if defined(HOP_X86_KERNELS) && defined(_MSC_VER)
#include <intrin.h>
#endif

namespace hop
{
namespace
{

struct CompiledSet
{
  InstructionSet name = InstructionSet::Baseline;
  kernel::Kernels kernels;
};

#if defined(HOP_X86_KERNELS)
/// What the kernels of x86-64 need of the processor and, for wider registers, of the operating system.
struct Processor
{
  bool avx2 = false;
  bool avx512 = false;
};

#if defined(_MSC_VER)
/// The numbers of bits are those of Intel's manual, volume 2, CPUID. This branch has not been tried.
Processor thisProcessor()
{
  const auto has = [](std::uint64_t bits, int bit) { return (bits >> bit & 1) != 0; };
  int registers[4]; // eax, ebx, ecx, edx
  __cpuid(registers, 0);
  const int highestLeaf = registers[0];
  __cpuid(registers, 1);
  const auto ecx1 = static_cast<std::uint32_t>(registers[2]);
  constexpr int fma = 12, osxsave = 27, avx = 28;
  if (highestLeaf < 7 || !has(ecx1, osxsave) || !has(ecx1, avx))
  {
    return {};
  }
  // Registers that the system saves when it changes threads: xmm and ymm; masks and both parts of zmm.
  constexpr std::uint64_t ymmState = 0x06, zmmState = 0xe6;
  const std::uint64_t saved = _xgetbv(0);
  __cpuidex(registers, 7, 0);
  const auto ebx7 = static_cast<std::uint32_t>(registers[1]);
  constexpr int avx2 = 5, avx512f = 16, avx512dq = 17, avx512vl = 31;
  Processor processor;
  processor.avx2 = (saved & ymmState) == ymmState && has(ecx1, fma) && has(ebx7, avx2);
  processor.avx512 = processor.avx2 && (saved & zmmState) == zmmState && has(ebx7, avx512f) &&
    has(ebx7, avx512dq) && has(ebx7, avx512vl);
  return processor;
}
#else
Processor thisProcessor()
{
  __builtin_cpu_init();
  Processor processor;
  processor.avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  processor.avx512 = processor.avx2 && __builtin_cpu_supports("avx512f") &&
    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return processor;
}
#endif
#endif

std::vector<CompiledSet> findAvailable()
{
  std::vector<CompiledSet> sets{ { InstructionSet::Baseline, kernel::baselineKernels() } };
#if defined(HOP_X86_KERNELS)
  const Processor processor = thisProcessor();
  if (processor.avx2)
  {
    sets.push_back({ InstructionSet::Avx2, kernel::avx2Kernels() });
  }
  if (processor.avx512)
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
    case InstructionSet::Baseline:
      return "baseline";
    case InstructionSet::Avx2:
      return "AVX2";
    case InstructionSet::Avx512:
      return "AVX-512";
  }
  return "unknown";
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
    throw std::invalid_argument(std::string("no kernels here for ") + nameOf(set));
  }
  inUse() = &*found;
}

const kernel::Kernels& kernel::current()
{
  return inUse().load(std::memory_order_acquire)->kernels;
}

} // namespace hop
