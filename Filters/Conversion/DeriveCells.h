#pragma once

#include "Common/Monitor.h"
#include "Conversion/JudgeCells.h"
#include "Elements/ElementMesh.h"

#include <vector>

namespace hop
{

/// Derives the field of each judged cell and keeps the cells that can hold one of the isosurfaces: first by bounds on
/// the derivatives, which are cheap, then by the coefficients of the derived field. Cells that are inside out or without
/// volume are kept without an element, to be counted later.
/// \param unitOfLength of the run, a power of two
void deriveCells(const InputBlocks& blocks, const std::vector<double>& isovalues,
  double unitOfLength, std::vector<JudgedCells>& ranges, const ParallelFor& parallelFor);

/// Writes the coefficients of a cell's element.
/// \param unitOfValue of the quantity, a power of two
/// \return the sign of the Jacobian determinant; NotFinite also where the field is too large for the numerics
JacobianSign writeDerived(const DerivedCell& cell, Quantity quantity, double unitOfValue,
  const Element& element, ElementMesh& mesh);

} // namespace hop
