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

/// A cell in Bernstein form, with all components of its field.
struct ControlNet
{
  /// 3 + number of the field's components.
  int width = 4;
  /// Rows of x, y, z and the field's components, homogeneous where the cell is rational.
  std::vector<double> control;
  /// Ones where the cell is not rational.
  std::vector<double> weights;
  bool isRational = false;
};

/// \param values what readCell() has read, with the field in the unit in which it is wanted
/// \param unitOfLength divides the coordinates
ControlNet controlNet(const InputBlocks& blocks, const BlockCell& where, const CellBasis& cell,
  const CellValues& values, double unitOfLength);

/// Of the Jacobian determinant. NotFinite and Zero: there is no element. Zero also for cells that are points beside the
/// bounds of all input.
JacobianSign signOf(const CellBasis& cell, const ControlNet& net);

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
