#pragma once

#include "Input/GatherBlocks.h"
#include "Input/UserMessage.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkInformation;

namespace hop
{

/// Advice where no isovalue is given; else empty.
UserMessages checkIsovalues(const std::vector<double>& isovalues, const GatheredBlocks& gathered);

/// What is wrong with the filter's properties, whatever the input; empty if nothing is.
UserMessages checkParameters(const std::vector<double>& isovalues, double spacing,
  double smallestSpacing, double angularDensity, double tolerance);

/// What is wrong with the size of the whole grid; empty if nothing is.
/// \param diagonal of the grid's bounds, world units
UserMessages checkDiagonal(double diagonal);

/// The blocks that can be contoured, and why the other blocks cannot.
struct CheckedBlocks
{
  /// All have the array to contour by, with the same number of components, and no arrays that are too short.
  std::vector<InputBlock> sound;
  UserMessages messages;
  /// What of their scalars is contoured.
  Quantity quantity = Quantity::Value;
  std::shared_ptr<const FieldExpression> expression;
};

/// \param asked vtkAlgorithm::GetInputArrayInformation, which names the array to contour by
CheckedBlocks checkBlocks(const GatheredBlocks& gathered, vtkInformation* asked);

/// The same blocks, or none and an error where their scalars are no vectors, although a quantity needs vectors.
CheckedBlocks checkQuantity(CheckedBlocks checked, Quantity quantity);

/// The same where the scalars are made for each grid.
/// \param time when what they are made of was changed last
CheckedBlocks checkBlocks(const GatheredBlocks& gathered,
  const std::function<vtkSmartPointer<vtkDataArray>(vtkUnstructuredGrid*)>& makeScalars,
  vtkMTimeType time);

} // namespace hop
