#pragma once

#include "Common/Monitor.h"
#include "Conversion/CellBases.h"
#include "Conversion/CellCensus.h"
#include "Conversion/RunUnits.h"
#include "Elements/ElementMesh.h"
#include "Input/InputBlocks.h"

#include <functional>
#include <memory>
#include <vector>

namespace hop
{

/// Grids as elements: the cells that can hold one of the isosurfaces, in Bernstein form and joined at their faces
/// within and across blocks, with the bases to evaluate further arrays on them.
struct GridElements
{
  /// Its elements name their cells by the numbers of InputBlocks.
  ElementMesh mesh;
  /// The bases of all kinds of cells.
  std::unique_ptr<CellBases> kinds;
  /// The basis of each element, owned by `kinds`.
  std::vector<const CellBasis*> bases;
  /// Whether the mesh's field is the square of the chosen scalar: the magnitude of a vector is no
  /// polynomial, its square is, and |v| = c where |v|^2 = c^2.
  bool squared = false;
  /// Is subtracted from the chosen scalar where this is large and changes little: rounding errors would hide the
  /// changes. 0 where a magnitude is contoured.
  double origin = 0.0;
  /// The mesh's coordinates and fields are those of the input divided by these.
  RunUnits units;
  /// What became of the cells, one census a block.
  std::vector<CellCensus> census;

  /// Whether the chosen scalar can have a value at all: a magnitude is never negative.
  bool canBe(double isovalue) const { return !this->squared || isovalue >= 0.0; }

  /// The value of the mesh's field on the isosurface of the chosen scalar.
  /// \pre canBe(isovalue)
  double fieldIsovalue(double isovalue) const
  {
    const double scaled = (isovalue - this->origin) / this->units.value;
    return this->squared ? scaled * scaled : scaled;
  }
};

/// Converts the cells of all blocks.
/// \param isovalues of the chosen scalar, at least one
/// \param reached receives the fraction of the work that is done, 0 to 1; may throw to end it early
/// \param unitOfLength of the mesh, world units, a power of two
GridElements buildGridElements(
  const InputBlocks& blocks, NodeSpacing spacing, const std::vector<double>& isovalues,
  const ParallelFor& parallelFor, const std::function<void(double)>& reached = [](double) {},
  double unitOfLength = 1.0);

} // namespace hop
