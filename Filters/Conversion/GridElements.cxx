#include "Conversion/GridElements.h"

#include "Conversion/CellValues.h"
#include "Conversion/ConvertCells.h"
#include "Conversion/DeriveCells.h"
#include "Conversion/NodeOrder.h"
#include "Elements/CornerNumbers.h"
#include "Support/KeepMarked.h"

#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{

namespace
{

/// Room that elements need in a mesh.
struct Room
{
  std::size_t elements = 0;
  std::size_t coefficients = 0;
  std::size_t exactFields = 0;
  std::size_t exactCoefficients = 0;
  bool anyRational = false;

  void add(const Room& other)
  {
    this->elements += other.elements;
    this->coefficients += other.coefficients;
    this->exactFields += other.exactFields;
    this->exactCoefficients += other.exactCoefficients;
    this->anyRational = this->anyRational || other.anyRational;
  }
};

/// The cells of a range with an element that does not hold its derived field.
SkippedCells unresolvedCells(const JudgedCells& range)
{
  SkippedCells cells;
  vtkIdType last = -1;
  for (std::size_t i = 0; i < range.derived.size(); ++i)
  {
    const vtkIdType cell = range.kept[i].cell;
    if (!range.derived[i].isResolved && cell != last)
    {
      cells.add(cell);
      last = cell;
    }
  }
  return cells;
}

/// The room that the exact field of kept cell i needs.
Room roomForExact(const JudgedCells& range, std::size_t i)
{
  Room room;
  room.exactCoefficients = range.derived.empty() ? 0 : range.derived[i].exact.coefficients.size();
  room.exactFields = room.exactCoefficients > 0 ? 1 : 0;
  return room;
}

/// The cells of one kind with elements.
struct KindOfCells
{
  const CellBasis* cell = nullptr;
  std::vector<BlockCell> folded;
  std::vector<BlockCell> sound;

  bool areMostFolded() const
  {
    // Of fewer cells nothing is said: a few bad cells are more likely than a wrong order. Chosen by experiment.
    constexpr std::size_t leastToTell = 10;
    return this->folded.size() >= leastToTell && this->folded.size() > this->sound.size();
  }
};

/// Parts of a cell stand one after the other.
void addOnce(const BlockCell& where, std::vector<BlockCell>& cells)
{
  if (cells.empty() || cells.back().block != where.block || cells.back().cell != where.cell)
  {
    cells.push_back(where);
  }
}

/// Builds elements of judged cells.
class Builder
{
public:
  /// \param areDivided whether elements are parts of cells
  Builder(const InputBlocks& blocks, const std::vector<double>& isovalues, bool areDivided,
    GridElements& result, const ParallelFor& parallelFor)
    : Blocks(blocks)
    , Isovalues(isovalues)
    , AreDivided(areDivided)
    , Parallel(parallelFor)
    , Result(result)
  {
  }

  void build(const std::vector<JudgedCells>& judged);

private:
  void makeElements(const std::vector<JudgedCells>& ranges);
  std::vector<JacobianSign> writeDerived(const std::vector<JudgedCells>& ranges);
  Room roomFor(const JudgedCells& range) const;
  Element elementOf(const JudgedCells& range, std::size_t i) const;
  void makeElements(const JudgedCells& range, const Room& before);
  void dropMisordered(std::vector<JacobianSign>& signs);
  void drop(const MisorderedCells& misordered, std::vector<JacobianSign>& signs);
  std::vector<KindOfCells> sortByKind(const std::vector<JacobianSign>& signs) const;
  void dropCollapsed(const std::vector<JacobianSign>& signs);
  void keep(const std::vector<char>& marks);

  const InputBlocks& Blocks;
  const std::vector<double>& Isovalues;
  bool AreDivided;
  const ParallelFor& Parallel;
  GridElements& Result;
};

void Builder::build(const std::vector<JudgedCells>& judged)
{
  this->makeElements(judged);
  std::vector<JacobianSign> signs = this->Blocks.isDerived()
    ? this->writeDerived(judged)
    : convertCells(this->Blocks, this->Result.bases, { this->Isovalues, this->Result.origin },
        this->Result.units, this->Result.mesh, this->Parallel);
  this->dropMisordered(signs);
  this->dropCollapsed(signs);
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
    this->Result.census[ranges[r].block].unresolved.add(unresolvedCells(ranges[r]));
  }
  ElementMesh& mesh = this->Result.mesh;
  mesh.elements.resize(all.elements);
  this->Result.bases.resize(all.elements);
  this->Result.parts.resize(this->AreDivided ? all.elements : 0);
  mesh.coefficients.resize(all.coefficients);
  mesh.weights.resize(all.anyRational ? all.coefficients : 0);
  mesh.exactFields.resize(all.exactFields);
  mesh.exactCoefficients.resize(all.exactCoefficients);
  forAll(this->Parallel, ranges.size(),
    [&](std::size_t r) { this->makeElements(ranges[r], before[r]); });
}

/// The room that the cells to keep of a range need.
Room Builder::roomFor(const JudgedCells& range) const
{
  Room room;
  room.elements = range.kept.size();
  for (std::size_t i = 0; i < range.kept.size(); ++i)
  {
    const Element element = this->elementOf(range, i);
    room.coefficients += coefficientCount(element.domain, element.degrees);
    room.anyRational = room.anyRational || element.rational;
    room.add(roomForExact(range, i));
  }
  return room;
}

/// \param before the room that the elements of earlier ranges need
void Builder::makeElements(const JudgedCells& range, const Room& before)
{
  Room next = before;
  for (std::size_t i = 0; i < range.kept.size(); ++i)
  {
    Element& element = this->Result.mesh.elements[before.elements + i];
    element = this->elementOf(range, i);
    element.firstCoefficient = next.coefficients;
    const Room exact = roomForExact(range, i);
    if (exact.exactFields > 0)
    {
      element.exactField = static_cast<int>(next.exactFields);
      this->Result.mesh.exactFields[next.exactFields].firstCoefficient = next.exactCoefficients;
    }
    next.add(exact);
    this->Result.bases[before.elements + i] = range.kept[i].basis;
    if (!this->Result.parts.empty())
    {
      this->Result.parts[before.elements + i] = range.derived[i].place;
    }
    next.coefficients += coefficientCount(element.domain, element.degrees);
  }
}

/// The element of kept cell i of a range, but for the place of its coefficients. Squares have twice the degree.
Element Builder::elementOf(const JudgedCells& range, std::size_t i) const
{
  const CellBasis& cell = *range.kept[i].basis;
  const Degrees& d = cell.basis.degrees();
  Element element;
  element.domain = cell.basis.domain();
  element.cell = this->Blocks.firstCell(range.block) + range.kept[i].cell;
  if (this->Blocks.isDerived())
  {
    element.degrees = range.derived[i].element.degrees;
    element.partsOfCell = static_cast<std::uint16_t>(range.derived[i].partsOfCell);
    element.rational = !range.derived[i].element.weights.empty();
  }
  else
  {
    element.degrees = this->Result.squared ? Degrees{ 2 * d[0], 2 * d[1], 2 * d[2] } : d;
    element.rational = rationalWeights(this->Blocks[range.block], cell) != nullptr;
  }
  return element;
}

/// Writes the coefficients of derived fields.
std::vector<JacobianSign> Builder::writeDerived(const std::vector<JudgedCells>& ranges)
{
  ElementMesh& mesh = this->Result.mesh;
  std::vector<JacobianSign> signs;
  for (const JudgedCells& range : ranges)
  {
    for (const DerivedCell& cell : range.derived)
    {
      signs.push_back(hop::writeDerived(cell, this->Blocks.quantity(), this->Result.units.value,
        mesh.elements[signs.size()], mesh));
    }
  }
  return signs;
}

/// Removes elements whose cells have their nodes in another order than VTK; their signs, too.
void Builder::dropMisordered(std::vector<JacobianSign>& signs)
{
  for (const KindOfCells& kind : this->sortByKind(signs))
  {
    CellBases& kinds = *this->Result.kinds;
    const CellBasis& cell = *kind.cell;
    if (!kind.folded.empty())
    {
      this->drop(findMisordered(
                   this->Blocks, kind.folded, kind.areMostFolded(), cell, kinds, this->Parallel),
        signs);
    }
    this->drop(findDisplaced(this->Blocks, kind.sound, cell, kinds, this->Parallel), signs);
  }
}

/// The cells of all elements, kind by kind, in the order of the cells, not of addresses.
std::vector<KindOfCells> Builder::sortByKind(const std::vector<JacobianSign>& signs) const
{
  std::vector<KindOfCells> kinds;
  for (std::size_t e = 0; e < signs.size(); ++e)
  {
    const CellBasis* cell = this->Result.bases[e];
    auto kind = std::find_if(
      kinds.begin(), kinds.end(), [&](const KindOfCells& one) { return one.cell == cell; });
    if (kind == kinds.end())
    {
      kind = kinds.insert(kinds.end(), { cell, {}, {} });
    }
    const BlockCell where = this->Blocks.locate(this->Result.mesh.elements[e].cell);
    if (signs[e] == JacobianSign::Mixed)
    {
      addOnce(where, kind->folded);
    }
    else if (signs[e] == JacobianSign::Positive || signs[e] == JacobianSign::Negative)
    {
      addOnce(where, kind->sound);
    }
  }
  return kinds;
}

/// Counts misordered cells and removes their elements.
void Builder::drop(const MisorderedCells& misordered, std::vector<JacobianSign>& signs)
{
  if (misordered.isEmpty())
  {
    return;
  }
  for (std::size_t b = 0; b < this->Blocks.size(); ++b)
  {
    const std::vector<vtkIdType>& cells = misordered.cells[b];
    if (!cells.empty())
    {
      const int type = this->Blocks[b].grid->GetCellType(cells.front());
      this->Result.census[b].misordered[{ type, misordered.describe() }].add(
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
        (this->Blocks.isDerived() ? census.singular : census.folded).add(cell);
        marks[e] = !this->Blocks.isDerived();
        break;
      case JacobianSign::Positive:
      case JacobianSign::Negative:
        break;
    }
  }
  this->keep(marks);
}

/// Removes elements without a mark.
void Builder::keep(const std::vector<char>& marks)
{
  keepMarked(this->Result.mesh.elements, marks);
  keepMarked(this->Result.bases, marks);
  if (!this->Result.parts.empty())
  {
    keepMarked(this->Result.parts, marks);
  }
}

} // namespace

double usualUnit(const UnitCounts& counts)
{
  std::int64_t all = 0;
  for (const auto& [exponent, count] : counts)
  {
    all += count;
  }
  std::int64_t upTo = 0;
  for (const auto& [exponent, count] : counts)
  {
    upTo += count;
    if (upTo > all / 2)
    {
      return std::ldexp(1.0, exponent);
    }
  }
  return 1.0;
}

double originFor(const std::array<double, 2>& range)
{
  // Largest range, as a fraction of the middle value, at which the middle is subtracted: three digits are won. Where
  // the range is larger there is less to win, and zero stays zero. Chosen by experiment.
  constexpr double little = 1e-3;
  const auto [lowest, highest] = range;
  const double middle = 0.5 * lowest + 0.5 * highest;
  return lowest <= highest && highest - lowest < little * std::abs(middle) ? middle : 0.0;
}

std::array<double, 2> valueRange(const InputBlocks& blocks)
{
  if (blocks.isMagnitude() || blocks.isDerived())
  {
    return { 0.0, 0.0 };
  }
  std::array<double, 2> all{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const auto [lowest, highest] =
      finiteRange(blocks[b].grid, blocks[b].scalars, blocks.component());
    all = { std::min(all[0], lowest), std::max(all[1], highest) };
  }
  return all;
}

int firstHalvings(Quantity quantity)
{
  return isAlwaysSampled(quantity) ? 1 : 0;
}

bool isWorthDividing(Quantity quantity, const ResolvedCounts& counts, int halvings)
{
  // More halvings take eight times the memory and time each. A few elements that are not resolved, beside places where
  // the field is not smooth, are not worth that. Chosen by experiment.
  const int mostHalvings = quantity == Quantity::Lambda2 ? 1 : 2;
  constexpr double fewElements = 0.02;
  const auto number = [&](int kind)
  { return counts.count(kind) > 0 ? static_cast<double>(counts.at(kind)) : 0.0; };
  const double least = halvings == 0 ? 0.0 : fewElements * (number(0) + number(1));
  return halvings < mostHalvings && number(0) > least;
}

GridConversion::GridConversion(const InputBlocks& blocks, NodeSpacing spacing,
  const std::vector<double>& isovalues, double origin, double unitOfLength)
  : Blocks(blocks)
  , Isovalues(isovalues)
{
  this->Result.squared = blocks.isMagnitude() || isSquareRoot(blocks.quantity());
  this->Result.origin = origin;
  this->Result.units.length = unitOfLength;
  this->Result.kinds = std::make_unique<CellBases>(spacing);
  this->Result.census.resize(blocks.size());
}

UnitCounts GridConversion::judge(const ParallelFor& parallelFor)
{
  this->Judged = judgeCells(this->Blocks, this->Isovalues, *this->Result.kinds, parallelFor);
  this->Halvings = firstHalvings(this->Blocks.quantity());
  return this->Blocks.isDerived() ? this->derive(parallelFor) : this->countUnits();
}

ResolvedCounts GridConversion::countResolved() const
{
  ResolvedCounts counts;
  for (const JudgedCells& range : this->Judged)
  {
    for (const DerivedCell& cell : range.derived)
    {
      ++counts[cell.isResolved ? 1 : 0];
    }
  }
  return counts;
}

UnitCounts GridConversion::divideCells(int halvings, const ParallelFor& parallelFor)
{
  this->Halvings = halvings;
  return this->derive(parallelFor);
}

UnitCounts GridConversion::derive(const ParallelFor& parallelFor)
{
  deriveCells(this->Blocks, this->Isovalues,
    this->Halvings == 0 ? DerivingBy::Products : DerivingBy::Samples, this->Halvings,
    this->Result.units.length, this->Judged, parallelFor);
  return this->countUnits();
}

UnitCounts GridConversion::countUnits() const
{
  UnitCounts counts;
  for (const JudgedCells& range : this->Judged)
  {
    for (const KeptCell& kept : range.kept)
    {
      ++counts[std::ilogb(unitOf(kept.change))];
    }
  }
  return counts;
}

GridElements GridConversion::convert(double unitOfValue, const ParallelFor& parallelFor)
{
  this->Result.units.value = unitOfValue;
  Builder(this->Blocks, this->Isovalues, this->Halvings > 0, this->Result, parallelFor)
    .build(this->Judged);
  this->Judged.clear();
  return std::move(this->Result);
}

GridElements buildGridElements(const InputBlocks& blocks, NodeSpacing spacing,
  const std::vector<double>& isovalues, const ParallelFor& parallelFor)
{
  GridConversion conversion(blocks, spacing, isovalues, originFor(valueRange(blocks)), 1.0);
  UnitCounts counts = conversion.judge(parallelFor);
  for (int halvings = firstHalvings(blocks.quantity());
       isWorthDividing(blocks.quantity(), conversion.countResolved(), halvings);)
  {
    counts = conversion.divideCells(++halvings, parallelFor);
  }
  const double unit = usualUnit(counts);
  GridElements elements = conversion.convert(unit, parallelFor);
  joinElements(elements.mesh, parallelFor);
  return elements;
}

} // namespace hop
