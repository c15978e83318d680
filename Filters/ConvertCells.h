#pragma once

#include "CellBases.h"
#include "ElementMesh.h"
#include "InputBlocks.h"

#include <vector>

/// Writes the coefficients of all elements: homogeneous ones and their weights for rational cells, those of
/// the squared magnitude where that is the field.
/// \param bases of the elements' cells, one an element
/// \param isovalues of the chosen scalar, which coefficients take that cannot be told from them
/// \param mesh elements that need no more but coefficients and corners, and room for the coefficients
/// \return what the Jacobian determinant does, one an element
std::vector<hop::JacobianSign> convertCells(const InputBlocks& blocks,
  const std::vector<const CellBasis*>& bases, const std::vector<double>& isovalues,
  hop::ElementMesh& mesh, const hop::ParallelFor& parallelFor);
