#pragma once

#include "Kernel/InstructionSet.h"

#include "KernelParts.h"

#include <gtest/gtest.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace hop::testing
{

/// What was compiled for an instruction set.
struct CompiledParts
{
  InstructionSet set;
  KernelParts parts;
};

/// One for each set of availableInstructionSets().
std::vector<CompiledParts> availableParts();

void PrintTo(const CompiledParts& which, std::ostream* stream);

/// Names of tests: letters and digits only.
std::string nameOfParts(const ::testing::TestParamInfo<CompiledParts>& which);
std::string nameOfSet(const ::testing::TestParamInfo<InstructionSet>& which);

} // namespace hop::testing
