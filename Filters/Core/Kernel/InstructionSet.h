#pragma once

#include "Kernel/Kernels.h"

#include <vector>

namespace hop
{

/// The instructions that a copy of the kernels is compiled for. Results of two sets differ by rounding only.
enum class InstructionSet
{
  /// 128-bit vectors of any processor of the architecture (SSE2, NEON).
  Baseline,
  /// 256-bit vectors with fused multiply-add.
  Avx2,
  /// 512-bit vectors (AVX-512F, DQ and VL).
  Avx512
};

const char* nameOf(InstructionSet set);

/// The instruction sets that this processor and this build have, the fastest last.
std::vector<InstructionSet> availableInstructionSets();

/// The instruction set in use: the fastest, until useInstructionSet() chooses another one.
InstructionSet instructionSet();

/// For tests and benchmarks. Not to be called while another thread evaluates: its results would change midway.
/// \throw std::invalid_argument if the set is not available
void useInstructionSet(InstructionSet set);

namespace kernel
{

/// Kernels of the instruction set in use.
const Kernels& current();

} // namespace kernel
} // namespace hop
