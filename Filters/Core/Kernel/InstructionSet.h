#pragma once

#include "Kernel/Kernels.h"

#include <vector>

namespace hop
{

/// What the evaluators are compiled for. Results of two sets differ by rounding only.
enum class InstructionSet
{
  /// 128-bit vectors of any processor of the architecture (SSE2, NEON); without vectors where the
  /// compiler has none.
  Baseline,
  /// 256-bit vectors with fused multiply-add.
  Avx2,
  /// 512-bit vectors (foundation, DQ, VL).
  Avx512
};

const char* nameOf(InstructionSet set);

/// Those that this processor and this build have, the fastest last.
std::vector<InstructionSet> availableInstructionSets();

/// The one in use: the fastest, until told otherwise.
InstructionSet instructionSet();

/// For tests and benchmarks. Not while another thread evaluates: its results would change midway.
/// \throw std::invalid_argument if the set is not available
void useInstructionSet(InstructionSet set);

namespace kernel
{

/// Kernels of the instruction set in use.
const Kernels& current();

} // namespace kernel
} // namespace hop
