#pragma once

#include "Common/Monitor.h"
#include "Conversion/CellBases.h"
#include "Conversion/CellCensus.h"
#include "Elements/ElementMesh.h"
#include "Input/InputBlocks.h"

#include <functional>
#include <memory>
#include <vector>

namespace hop
{

/// Grids seen as elements: those that can hold one of the isosurfaces in Bernstein form, joined at
/// their faces within and across blocks, and the bases by which further arrays can be evaluated on them.
struct GridElements
{
  /// Its elements name their cells by the number that InputBlocks gives them.
  ElementMesh mesh;
  /// Of all kinds of cells.
  std::unique_ptr<CellBases> kinds;
  /// One an element, of those.
  std::vector<const CellBasis*> bases;
  /// Whether the mesh's field is the square of the chosen scalar: the magnitude of a vector is no
  /// polynomial, its square is, and |v| = c where |v|^2 = c^2.
  bool squared = false;
  /// What is subtracted from the chosen scalar where it is large and changes little, as rounding would hide that.
  double origin = 0.0;
  /// One a block.
  std::vector<CellCensus> census;

  /// Whether the chosen scalar can have a value at all: a magnitude is never negative.
  bool canBe(double isovalue) const { return !this->squared || isovalue >= 0.0; }

  /// The value of the mesh's field on the isosurface of the chosen scalar.
  /// \pre canBe(isovalue)
  double fieldIsovalue(double isovalue) const
  {
    return this->squared ? isovalue * isovalue : isovalue - this->origin;
  }
};

/// \param isovalues of the chosen scalar, at least one
/// \param reached is told what share of the work is done, 0 to 1; may throw to end it early
GridElements buildGridElements(
  const InputBlocks& blocks, NodeSpacing spacing, const std::vector<double>& isovalues,
  const ParallelFor& parallelFor, const std::function<void(double)>& reached = [](double) {});

} // namespace hop
