#pragma once

#include "Conversion/CellBases.h"
#include "Conversion/CellValues.h"
#include "Conversion/RunUnits.h"
#include "Elements/ElementMesh.h"
#include "Input/InputBlocks.h"

#include <vector>

namespace hop
{

/// How the values of the chosen scalar are changed when they are converted.
struct FieldRange
{
  /// A coefficient that cannot be told from one of these isovalues takes its value.
  const std::vector<double>& isovalues;
  /// See GridElements::origin.
  double origin = 0.0;
};

/// Writes the coefficients of all elements, in the given units. Rational cells receive homogeneous coefficients and weights; where a
/// magnitude is contoured, the coefficients describe its square.
/// \param bases of the elements' cells, one an element
/// \param mesh elements that lack only coefficients and corners, and room for the coefficients
/// \return the sign of the Jacobian determinant, one an element
std::vector<JacobianSign> convertCells(const InputBlocks& blocks,
  const std::vector<const CellBasis*>& bases, const FieldRange& range, const RunUnits& units,
  ElementMesh& mesh, const ParallelFor& parallelFor);

/// The sign of the Jacobian determinant that a cell has if its nodes are taken in an order: first node order[0] of the
/// mesh, then node order[1], and so on.
/// \param values memory to use
/// \return NotFinite also where the cell cannot be read
JacobianSign signInOrder(const InputBlocks& blocks, const BlockCell& where, const CellBasis& cell,
  const std::vector<int>& order, CellValues& values);

} // namespace hop
