#pragma once

#include "Common/Monitor.h"
#include "Conversion/JudgeCells.h"
#include "Elements/ElementMesh.h"

#include <vector>

namespace hop
{

/// How the fields of cells are derived.
enum class DerivingBy
{
  /// Products of polynomials: the field itself, to rounding.
  Products,
  /// Interpolation on the parts into which cells are divided.
  Samples
};

/// Derives the field of each kept cell and keeps the cells that can hold one of the isosurfaces: first by bounds on
/// the derivatives, which are cheap, then by the coefficients of the derived field. Cells that are inside out or without
/// volume are kept without an element, to be counted later, and so are cells whose products have too high a degree: they
/// are not resolved.
/// \param halvings by which cells are divided into parts, for samples only
/// \param unitOfLength of the run, a power of two
void deriveCells(const InputBlocks& blocks, const std::vector<double>& isovalues, DerivingBy way,
  int halvings, double unitOfLength, std::vector<JudgedCells>& ranges,
  const ParallelFor& parallelFor);

/// Writes the coefficients of a cell's element.
/// \param unitOfValue of the quantity, a power of two
/// \return the sign of the Jacobian determinant; NotFinite also where the field is too large for the numerics
JacobianSign writeDerived(const DerivedCell& cell, Quantity quantity, double unitOfValue,
  const Element& element, ElementMesh& mesh);

} // namespace hop
