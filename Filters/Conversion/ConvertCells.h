#pragma once

#include "Conversion/CellBases.h"
#include "Elements/ElementMesh.h"
#include "Input/InputBlocks.h"

#include <vector>

namespace hop
{

/// Which values of the chosen scalar matter.
struct FieldRange
{
  /// Coefficients that cannot be told from one of these take it.
  const std::vector<double>& isovalues;
  /// Is subtracted from the scalar; not from vectors whose magnitude is contoured.
  double origin = 0.0;
};

/// Writes the coefficients of all elements: homogeneous ones and their weights for rational cells, those of
/// the squared magnitude where that is the field.
/// \param bases of the elements' cells, one an element
/// \param range tells what is done with the chosen scalar
/// \param mesh elements that need no more but coefficients and corners, and room for the coefficients
/// \return what the Jacobian determinant does, one an element
std::vector<JacobianSign> convertCells(const InputBlocks& blocks,
  const std::vector<const CellBasis*>& bases, const FieldRange& range, ElementMesh& mesh,
  const ParallelFor& parallelFor);

} // namespace hop
