#pragma once

#include "Common/Monitor.h"
#include "Conversion/CellBases.h"
#include "Conversion/CellCensus.h"
#include "Conversion/JudgeCells.h"
#include "Conversion/RunUnits.h"
#include "Elements/ElementMesh.h"
#include "Input/InputBlocks.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace hop
{

/// Grids as elements: the cells that can hold one of the isosurfaces, in Bernstein form, with the bases to evaluate
/// further arrays on them.
struct GridElements
{
  /// Its elements name their cells by the numbers of InputBlocks.
  ElementMesh mesh;
  /// The bases of all kinds of cells.
  std::unique_ptr<CellBases> kinds;
  /// The basis of each element, owned by `kinds`.
  std::vector<const CellBasis*> bases;
  /// The parts of their cells that elements are; empty where each is a whole cell.
  std::vector<ReferencePart> parts;
  /// Whether the mesh's field is the square of the chosen scalar: the magnitude of a vector is no
  /// polynomial, its square is, and |v| = c where |v|^2 = c^2. So it is with magnitudes of derived fields.
  bool squared = false;
  /// Is subtracted from the chosen scalar where this is large and changes little: rounding errors would hide the
  /// changes. 0 where a magnitude or a derived field is contoured.
  double origin = 0.0;
  /// The mesh's coordinates and fields are those of the input divided by these.
  RunUnits units;
  /// What became of the cells, one census a block.
  std::vector<CellCensus> census;

  /// A place of the mesh in the reference domain of its cell.
  ReferencePoint inCell(const Location& place) const
  {
    return this->parts.empty() ? place.u : this->parts[place.element].inWhole(place.u);
  }

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

/// How often each unit occurs among the changes of the chosen scalar in cells: a power of two by its exponent.
using UnitCounts = std::map<int, std::int64_t>;

/// Numbers of elements of derived fields, by whether they hold the field (1) or not (0).
using ResolvedCounts = std::map<int, std::int64_t>;

/// The unit of the chosen scalar in which it changes by about one in half of the cells: a few cells with values of quite
/// another size do not matter. 1 if there are no cells.
double usualUnit(const UnitCounts& counts);

/// See GridElements::origin: the middle of the range of all values where the range is small, whatever the isovalues.
/// \param range of all values; the lowest above the highest where there are none
double originFor(const std::array<double, 2>& range);

/// The range of the chosen scalar in all blocks, 0 to 0 where a magnitude or a derived field is contoured.
std::array<double, 2> valueRange(const InputBlocks& blocks);

/// How often judge() halves the edges of cells: 0 where elements are whole cells.
int firstHalvings(Quantity quantity);

/// Whether all cells of derived fields are to be divided further: where products have too high a degree, and where
/// interpolations do not hold the field in more than a few elements. Lambda 2 is halved once: where it is not held,
/// particles stand on lambda 2 itself.
/// \param counts of all ranks
bool isWorthDividing(Quantity quantity, const ResolvedCounts& counts, int halvings);

/// Converts the cells of all blocks, stage by stage: between the stages ranks agree on what they have found out.
class GridConversion
{
public:
  /// \param isovalues of the chosen scalar, at least one
  /// \param origin see GridElements
  /// \param unitOfLength of the mesh, world units, a power of two
  /// \pre all arguments outlive the conversion
  GridConversion(const InputBlocks& blocks, NodeSpacing spacing,
    const std::vector<double>& isovalues, double origin, double unitOfLength);

  /// Finds the cells that can hold surface.
  UnitCounts judge(const ParallelFor& parallelFor);

  /// Counts the elements that have been found.
  ResolvedCounts countResolved() const;

  /// Divides each cell into parts and finds those that can hold surface.
  /// \param halvings of all edges: eight times as many parts each
  UnitCounts divideCells(int halvings, const ParallelFor& parallelFor);

  /// Converts the cells that judge() has found. The elements are in the order of their cells, and not joined.
  /// \param unitOfValue usualUnit() of the cells of all ranks
  GridElements convert(double unitOfValue, const ParallelFor& parallelFor);

private:
  const InputBlocks& Blocks;
  const std::vector<double>& Isovalues;
  UnitCounts derive(const ParallelFor& parallelFor);
  UnitCounts countUnits() const;

  std::vector<JudgedCells> Judged;
  /// How often the edges of cells are halved. 0: elements are whole cells.
  int Halvings = 0;
  GridElements Result;
};

/// Converts the cells of all blocks and joins the elements, where there are no other ranks.
/// \param isovalues of the chosen scalar, at least one
GridElements buildGridElements(const InputBlocks& blocks, NodeSpacing spacing,
  const std::vector<double>& isovalues, const ParallelFor& parallelFor);

} // namespace hop
