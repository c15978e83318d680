#include "Conversion/GridElements.h"

#include "Conversion/CellValues.h"
#include "Conversion/ConvertCells.h"
#include "Conversion/JudgeCells.h"
#include "Conversion/NodeOrder.h"
#include "Elements/CornerNumbers.h"
#include "Support/KeepMarked.h"

#include "vtkDataArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hop
{

namespace
{

/// Room that elements need in a mesh.
struct Room
{
  std::size_t elements = 0;
  std::size_t coefficients = 0;
  bool anyRational = false;

  void add(const Room& other)
  {
    this->elements += other.elements;
    this->coefficients += other.coefficients;
    this->anyRational = this->anyRational || other.anyRational;
  }
};

/// See GridElements::origin: the middle of the range of all values where the range is small, whatever the isovalues.
double originOf(const InputBlocks& blocks)
{
  // Largest range, as a fraction of the middle value, at which the middle is subtracted: three digits are won. Where
  // the range is larger there is less to win, and zero stays zero. Chosen by experiment.
  constexpr double little = 1e-3;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (std::size_t b = 0; b < blocks.size() && !blocks.isMagnitude(); ++b)
  {
    double range[2];
    blocks[b].scalars->GetFiniteRange(range, blocks.component());
    lowest = std::min(lowest, range[0]);
    highest = std::max(highest, range[1]);
  }
  const double middle = 0.5 * lowest + 0.5 * highest;
  return lowest <= highest && highest - lowest < little * std::abs(middle) ? middle : 0.0;
}

/// The unit of the chosen scalar in which it changes by about one in half of the cells: a few cells with values of quite
/// another size do not matter. 1 if there are no cells.
double usualUnit(const std::vector<JudgedCells>& ranges)
{
  std::vector<double> units;
  for (const JudgedCells& range : ranges)
  {
    for (const KeptCell& kept : range.kept)
    {
      units.push_back(unitOf(kept.change));
    }
  }
  if (units.empty())
  {
    return 1.0;
  }
  const auto median = units.begin() + static_cast<std::ptrdiff_t>(units.size() / 2);
  std::nth_element(units.begin(), median, units.end());
  return *median;
}

using Corners = decltype(Element::corners);

/// The corners in an order in which copies of a cell can be compared, which may list them differently.
Corners sortedCorners(const Element& element)
{
  Corners corners = element.corners;
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Fractions of the work that are done after its stages. They only move the progress bar; chosen by experiment.
struct ConversionProgress
{
  static constexpr double Judged = 0.2;
  static constexpr double Converted = 0.3;
  static constexpr double CornersFound = 0.5;
  static constexpr double CornersNumbered = 0.9;
};

/// Builds the elements of all blocks, stage by stage.
class Builder
{
public:
  Builder(const InputBlocks& blocks, NodeSpacing spacing, const std::vector<double>& isovalues,
    const ParallelFor& parallelFor, const std::function<void(double)>& reached, double unitOfLength)
    : Blocks(blocks)
    , Isovalues(isovalues)
    , Parallel(parallelFor)
    , Reached(reached)
  {
    this->Result.squared = blocks.isMagnitude();
    this->Result.origin = originOf(blocks);
    this->Result.units.length = unitOfLength;
    this->Result.kinds = std::make_unique<CellBases>(spacing);
    this->Result.census.resize(blocks.size());
  }

  GridElements build();

private:
  void makeElements(const std::vector<JudgedCells>& ranges);
  Room roomFor(const JudgedCells& range) const;
  void makeElements(const JudgedCells& range, const Room& before);
  Degrees elementDegrees(const CellBasis& cell) const;
  void dropMisordered(std::vector<JacobianSign>& signs);
  void drop(const MisorderedCells& misordered, std::vector<JacobianSign>& signs);
  std::vector<BlockCell> foldedCells(
    const std::vector<JacobianSign>& signs, const CellBasis* cell, bool& areMost) const;
  void dropCollapsed(const std::vector<JacobianSign>& signs);
  void dropDoubledGhosts(std::vector<double>& tolerances);
  void keep(const std::vector<char>& marks);

  const InputBlocks& Blocks;
  const std::vector<double>& Isovalues;
  const ParallelFor& Parallel;
  const std::function<void(double)>& Reached;
  GridElements Result;
};

GridElements Builder::build()
{
  ElementMesh& mesh = this->Result.mesh;
  const std::vector<JudgedCells> judged =
    judgeCells(this->Blocks, this->Isovalues, *this->Result.kinds, this->Parallel);
  this->Result.units.value = usualUnit(judged);
  this->makeElements(judged);
  this->Reached(ConversionProgress::Judged);
  std::vector<JacobianSign> signs = convertCells(this->Blocks, this->Result.bases,
    { this->Isovalues, this->Result.origin }, this->Result.units, mesh, this->Parallel);
  this->Reached(ConversionProgress::Converted);
  this->dropMisordered(signs);
  this->dropCollapsed(signs);
  std::vector<double> tolerances = cornerTolerances(mesh, this->Parallel);
  this->Reached(ConversionProgress::CornersFound);
  numberCorners(mesh, tolerances, this->Parallel);
  this->Reached(ConversionProgress::CornersNumbered);
  this->dropDoubledGhosts(tolerances);
  findFaceNeighbors(mesh, tolerances, this->Parallel);
  return std::move(this->Result);
}

/// Makes elements of the cells to keep, with room for their coefficients.
void Builder::makeElements(const std::vector<JudgedCells>& ranges)
{
  std::vector<Room> before(ranges.size());
  forAll(
    this->Parallel, ranges.size(), [&](std::size_t r) { before[r] = this->roomFor(ranges[r]); });
  Room all;
  for (std::size_t r = 0; r < ranges.size(); ++r)
  {
    const Room start = all;
    all.add(before[r]);
    before[r] = start;
    this->Result.census[ranges[r].block].add(ranges[r].census);
  }
  ElementMesh& mesh = this->Result.mesh;
  mesh.elements.resize(all.elements);
  this->Result.bases.resize(all.elements);
  mesh.coefficients.resize(all.coefficients);
  mesh.weights.resize(all.anyRational ? all.coefficients : 0);
  forAll(this->Parallel, ranges.size(),
    [&](std::size_t r) { this->makeElements(ranges[r], before[r]); });
}

/// The room that the cells to keep of a range need.
Room Builder::roomFor(const JudgedCells& range) const
{
  Room room;
  room.elements = range.kept.size();
  for (const KeptCell& kept : range.kept)
  {
    room.coefficients +=
      coefficientCount(kept.basis->basis.domain(), this->elementDegrees(*kept.basis));
    room.anyRational =
      room.anyRational || rationalWeights(this->Blocks[range.block], *kept.basis) != nullptr;
  }
  return room;
}

/// \param before the room that the elements of earlier ranges need
void Builder::makeElements(const JudgedCells& range, const Room& before)
{
  std::size_t coefficient = before.coefficients;
  for (std::size_t i = 0; i < range.kept.size(); ++i)
  {
    const KeptCell& kept = range.kept[i];
    Element& element = this->Result.mesh.elements[before.elements + i];
    element.domain = kept.basis->basis.domain();
    element.degrees = this->elementDegrees(*kept.basis);
    element.firstCoefficient = coefficient;
    element.rational = rationalWeights(this->Blocks[range.block], *kept.basis) != nullptr;
    element.cell = this->Blocks.firstCell(range.block) + kept.cell;
    this->Result.bases[before.elements + i] = kept.basis;
    coefficient += coefficientCount(element.domain, element.degrees);
  }
}

/// The degrees of a cell's element: squares have twice the degree.
Degrees Builder::elementDegrees(const CellBasis& cell) const
{
  const Degrees& d = cell.basis.degrees();
  return this->Result.squared ? Degrees{ 2 * d[0], 2 * d[1], 2 * d[2] } : d;
}

/// Removes elements whose cells have their nodes in another order than VTK; their signs, too.
void Builder::dropMisordered(std::vector<JacobianSign>& signs)
{
  std::vector<const CellBasis*> folded; // in the order of the cells, not of addresses
  for (std::size_t e = 0; e < signs.size(); ++e)
  {
    const CellBasis* cell = this->Result.bases[e];
    if (signs[e] == JacobianSign::Mixed &&
      std::find(folded.begin(), folded.end(), cell) == folded.end())
    {
      folded.push_back(cell);
    }
  }
  for (const CellBasis* cell : folded)
  {
    bool areMost = false;
    const std::vector<BlockCell> cells = this->foldedCells(signs, cell, areMost);
    const MisorderedCells misordered =
      findMisordered(this->Blocks, cells, areMost, *cell, *this->Result.kinds, this->Parallel);
    if (!misordered.isEmpty())
    {
      this->drop(misordered, signs);
    }
  }
}

/// The folded cells of a kind.
/// \param areMost receives whether these are most of the kind's elements
std::vector<BlockCell> Builder::foldedCells(
  const std::vector<JacobianSign>& signs, const CellBasis* cell, bool& areMost) const
{
  // Of fewer cells nothing is said: a few bad cells are more likely than a wrong order. Chosen by experiment.
  constexpr std::size_t leastToTell = 10;
  std::size_t count = 0;
  std::vector<BlockCell> cells;
  for (std::size_t e = 0; e < signs.size(); ++e)
  {
    const bool isOfKind = this->Result.bases[e] == cell;
    count += isOfKind;
    if (isOfKind && signs[e] == JacobianSign::Mixed)
    {
      cells.push_back(this->Blocks.locate(this->Result.mesh.elements[e].cell));
    }
  }
  areMost = cells.size() >= leastToTell && 2 * cells.size() > count;
  return cells;
}

/// Counts misordered cells and removes their elements.
void Builder::drop(const MisorderedCells& misordered, std::vector<JacobianSign>& signs)
{
  for (std::size_t b = 0; b < this->Blocks.size(); ++b)
  {
    const std::vector<vtkIdType>& cells = misordered.cells[b];
    if (!cells.empty())
    {
      const int type = this->Blocks[b].grid->GetCellType(cells.front());
      this->Result.census[b].misordered[{ type, misordered.remedy }].add(
        { static_cast<vtkIdType>(cells.size()), cells.front() });
    }
  }
  std::vector<char> marks(signs.size(), 1);
  for (std::size_t e = 0; e < signs.size(); ++e)
  {
    const BlockCell where = this->Blocks.locate(this->Result.mesh.elements[e].cell);
    const std::vector<vtkIdType>& cells = misordered.cells[where.block];
    marks[e] = !std::binary_search(cells.begin(), cells.end(), where.cell);
  }
  keepMarked(signs, marks);
  this->keep(marks);
}

/// Removes elements without volume or with coordinates that are not finite.
void Builder::dropCollapsed(const std::vector<JacobianSign>& signs)
{
  std::vector<char> marks(signs.size(), 1);
  for (std::size_t e = 0; e < signs.size(); ++e)
  {
    const auto [block, cell] = this->Blocks.locate(this->Result.mesh.elements[e].cell);
    CellCensus& census = this->Result.census[block];
    switch (signs[e])
    {
      case JacobianSign::NotFinite:
        census.notFinite.add(cell);
        marks[e] = 0;
        break;
      case JacobianSign::Zero:
        census.collapsed.add(cell);
        marks[e] = 0;
        break;
      case JacobianSign::Mixed:
        census.folded.add(cell);
        break;
      case JacobianSign::Positive:
      case JacobianSign::Negative:
        break;
    }
  }
  this->keep(marks);
}

/// Removes ghosts whose original, or another copy, is in the mesh too; readers of files in pieces bring both. Such a
/// ghost would claim the faces of its neighbours a second time.
void Builder::dropDoubledGhosts(std::vector<double>& tolerances)
{
  const std::vector<Element>& elements = this->Result.mesh.elements;
  std::vector<char> marks;
  marks.reserve(elements.size());
  for (const Element& element : elements)
  {
    marks.push_back(!this->Blocks.isGhost(this->Blocks.locate(element.cell)));
  }
  if (std::find(marks.begin(), marks.end(), 0) == marks.end())
  {
    return;
  }
  std::set<Corners> present;
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    if (marks[e])
    {
      present.insert(sortedCorners(elements[e]));
    }
  }
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    marks[e] = marks[e] || present.insert(sortedCorners(elements[e])).second;
  }
  this->keep(marks);
  keepMarked(tolerances, marks);
}

/// Removes elements without a mark.
void Builder::keep(const std::vector<char>& marks)
{
  keepMarked(this->Result.mesh.elements, marks);
  keepMarked(this->Result.bases, marks);
}

} // namespace

GridElements buildGridElements(const InputBlocks& blocks, NodeSpacing spacing,
  const std::vector<double>& isovalues, const ParallelFor& parallelFor,
  const std::function<void(double)>& reached, double unitOfLength)
{
  return Builder(blocks, spacing, isovalues, parallelFor, reached, unitOfLength).build();
}

} // namespace hop
