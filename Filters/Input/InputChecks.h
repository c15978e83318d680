#pragma once

#include "Input/GatherBlocks.h"
#include "Input/UserMessage.h"

#include <vector>

class vtkInformation;

namespace hop
{

/// What to do where no isovalue is given; empty where there are some.
UserMessages checkIsovalues(const std::vector<double>& isovalues, const GatheredBlocks& gathered);

/// What is wrong with the filter's properties, whatever the input; empty where they are sound.
UserMessages checkParameters(
  const std::vector<double>& isovalues, double spacing, double angularDensity, double tolerance);

/// What is wrong with the size of the whole grid.
/// \param diagonal of its bounds
UserMessages checkDiagonal(double diagonal);

/// Blocks that can be contoured, and why others cannot.
struct CheckedBlocks
{
  /// With the array to contour by, of as many components in each, and without arrays that are too short.
  std::vector<InputBlock> sound;
  UserMessages messages;
};

/// \param asked names the array: vtkAlgorithm::GetInputArrayInformation
CheckedBlocks checkBlocks(const GatheredBlocks& gathered, vtkInformation* asked);

} // namespace hop
