#include "GridElements.h"

#include "BernsteinProduct.h"
#include "CornerNumbers.h"
#include "GatherValues.h"
#include "VtkCompatibility.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace
{

/// What is read of one cell.
struct CellValues
{
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  /// Where the ids are if the grid stores them otherwise.
  vtkNew<vtkIdList> copiedIds;
  /// Nodal values of the field, `components` a node: one, or all of a vector's for its magnitude.
  std::vector<double> field;
  /// Empty unless the cell is rational.
  std::vector<double> weights;
};

/// A cell that can hold surface.
struct KeptCell
{
  vtkIdType cell = 0;
  const CellBasis* basis = nullptr;
};

/// Cells of one block that are looked at by one thread, and what it found.
struct CellRange
{
  std::size_t block = 0;
  vtkIdType begin = 0;
  vtkIdType end = 0;
  CellCensus census;
  std::vector<KeptCell> kept;
  bool anyRational = false;
  /// How many coefficients the elements of the cells kept have.
  std::size_t coefficients = 0;
  /// Where these elements stand in the mesh, and their coefficients.
  std::size_t firstElement = 0;
  std::size_t firstCoefficient = 0;
};

/// Whether gradients can be squared, of magnitudes too, whose squares are contoured.
bool isUsable(double value)
{
  constexpr double largest = 1e75;
  return std::abs(value) <= largest;
}

/// Adds a row, times a factor, to all rows of values.
void addToRows(std::vector<double>& values, double factor, const std::vector<double>& row)
{
  for (std::size_t start = 0; start < values.size(); start += row.size())
  {
    for (std::size_t c = 0; c < row.size(); ++c)
    {
      values[start + c] += factor * row[c];
    }
  }
}

/// Coefficients that cannot be told from an isovalue take it: where the surface lies in a face of the element
/// it would cross that to and fro by rounding errors.
/// \param amplification of the nodal values' rounding errors
void snapToIsovalues(std::vector<hop::Coefficient>& coefficients,
  const std::vector<double>& isovalues, double amplification)
{
  const auto [lowest, highest] = std::minmax_element(coefficients.begin(), coefficients.end(),
    [](const hop::Coefficient& a, const hop::Coefficient& b) { return a.w < b.w; });
  constexpr double mostOfRange = 1e-8;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * amplification *
    std::max(std::abs(lowest->w), std::abs(highest->w));
  const double slack = std::min(rounding, mostOfRange * (highest->w - lowest->w));
  for (hop::Coefficient& c : coefficients)
  {
    for (const double isovalue : isovalues)
    {
      c.w = std::abs(c.w - isovalue) <= slack ? isovalue : c.w;
    }
  }
}

class Builder
{
public:
  Builder(const InputBlocks& blocks, hop::NodeSpacing spacing, const std::vector<double>& isovalues,
    const hop::ParallelFor& parallelFor, const std::function<void(double)>& reached)
    : Blocks(blocks)
    , Isovalues(isovalues)
    , Parallel(parallelFor)
    , Reached(reached)
  {
    this->Result.squared = blocks.component() == InputBlocks::Magnitude;
    this->Result.kinds = std::make_unique<CellBases>(spacing);
    this->Components = this->Result.squared ? blocks[0].scalars->GetNumberOfComponents() : 1;
    this->Result.census.resize(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      this->Ghosts.push_back(blocks[b].grid->GetCellGhostArray());
    }
  }

  GridElements build();

private:
  void judgeCells();
  std::vector<CellRange> rangesOfCells() const;
  void judge(CellRange& range, BasisLookup& bases, CellValues& values) const;
  void makeElements(std::vector<CellRange>& ranges);
  void makeElements(const CellRange& range);
  Verdict judge(const BlockCell& where, const CellBasis* basis, CellValues& values) const;
  Verdict read(const BlockCell& where, const CellBasis& basis, CellValues& values) const;
  void convertElements();
  hop::JacobianSign convert(int element, CellValues& values);
  std::vector<double> controlValues(
    vtkUnstructuredGrid* grid, const CellBasis& cell, const CellValues& values) const;
  void dropDoubledGhosts();
  void dropCollapsed();
  bool canHoldSurface(const CellBasis& basis, const CellValues& values) const;
  bool isConstant(const CellValues& values) const;
  bool straddles(double lower, double upper) const;
  bool isGhost(const hop::Element& element) const;
  bool isRational(std::size_t block, const CellBasis& cell) const;
  hop::Degrees elementDegrees(const hop::NodalBasis& basis) const;

  const InputBlocks& Blocks;
  /// One a block, or nullptr; grids look theirs up when first asked, which is nothing for threads.
  std::vector<vtkUnsignedCharArray*> Ghosts;
  const std::vector<double>& Isovalues;
  const hop::ParallelFor& Parallel;
  const std::function<void(double)>& Reached;
  int Components = 1;
  GridElements Result;
  std::vector<hop::JacobianSign> Signs;
  /// How near to each other coincident corners are, one an element.
  std::vector<double> Tolerances;
};

GridElements Builder::build()
{
  this->judgeCells();
  this->Reached(0.2);
  this->convertElements();
  this->Reached(0.3);
  this->dropCollapsed();
  hop::ElementMesh& mesh = this->Result.mesh;
  this->Tolerances = hop::cornerTolerances(mesh, this->Parallel);
  this->Reached(0.5);
  hop::numberCorners(mesh, this->Tolerances, this->Parallel);
  this->Reached(0.9);
  this->dropDoubledGhosts();
  hop::findFaceNeighbors(mesh, this->Tolerances, this->Parallel);
  return std::move(this->Result);
}

/// Squares have twice the degree.
hop::Degrees Builder::elementDegrees(const hop::NodalBasis& basis) const
{
  const hop::Degrees& d = basis.degrees();
  return this->Result.squared ? hop::Degrees{ 2 * d[0], 2 * d[1], 2 * d[2] } : d;
}

/// Sorts out which cells become elements. Only values are read here, not coordinates.
void Builder::judgeCells()
{
  std::vector<CellRange> ranges = this->rangesOfCells();
  hop::runParallel(this->Parallel, static_cast<std::ptrdiff_t>(ranges.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      CellValues values;
      BasisLookup bases(*this->Result.kinds);
      for (std::ptrdiff_t r = begin; r < end; ++r)
      {
        this->judge(ranges[r], bases, values);
      }
    });
  this->makeElements(ranges);
}

/// All cells, in order.
std::vector<CellRange> Builder::rangesOfCells() const
{
  constexpr vtkIdType wantedRanges = 1024;
  constexpr vtkIdType mostCells = 4096;
  const vtkIdType cellsAtOnce =
    std::clamp<vtkIdType>(this->Blocks.cellCount() / wantedRanges, 1, mostCells);
  std::vector<CellRange> ranges;
  for (std::size_t b = 0; b < this->Blocks.size(); ++b)
  {
    const vtkIdType count = this->Blocks[b].grid->GetNumberOfCells();
    for (vtkIdType begin = 0; begin < count; begin += cellsAtOnce)
    {
      ranges.emplace_back();
      ranges.back().block = b;
      ranges.back().begin = begin;
      ranges.back().end = std::min(count, begin + cellsAtOnce);
    }
  }
  return ranges;
}

void Builder::judge(CellRange& range, BasisLookup& bases, CellValues& values) const
{
  vtkUnstructuredGrid* grid = this->Blocks[range.block].grid;
  for (vtkIdType cell = range.begin; cell < range.end; ++cell)
  {
    const CellBasis* basis = bases.basisOf(grid, cell);
    const Verdict verdict = this->judge({ range.block, cell }, basis, values);
    if (verdict != Verdict::Keep)
    {
      range.census.count(verdict, cell, grid->GetCellType(cell));
      continue;
    }
    range.kept.push_back({ cell, basis });
    range.anyRational = range.anyRational || this->isRational(range.block, *basis);
    range.coefficients +=
      hop::coefficientCount(basis->basis.domain(), this->elementDegrees(basis->basis));
  }
}

/// \param basis of the cell, or nullptr
Verdict Builder::judge(const BlockCell& where, const CellBasis* basis, CellValues& values) const
{
  vtkUnsignedCharArray* ghosts = this->Ghosts[where.block];
  if (ghosts && (ghosts->GetValue(where.cell) & vtkDataSetAttributes::HIDDENCELL))
  {
    return Verdict::Hidden;
  }
  if (!basis)
  {
    return Verdict::Unsupported;
  }
  const Verdict verdict = this->read(where, *basis, values);
  if (verdict != Verdict::Keep)
  {
    return verdict;
  }
  if (!this->canHoldSurface(*basis, values))
  {
    return Verdict::Drop;
  }
  return this->isConstant(values) ? Verdict::Level : Verdict::Keep;
}

/// Whether all nodes have the same values.
bool Builder::isConstant(const CellValues& values) const
{
  return std::equal(
    values.field.begin() + this->Components, values.field.end(), values.field.begin());
}

/// Elements of the cells to keep, with room for their coefficients.
void Builder::makeElements(std::vector<CellRange>& ranges)
{
  hop::ElementMesh& mesh = this->Result.mesh;
  std::size_t elements = 0;
  std::size_t coefficients = 0;
  bool anyRational = false;
  for (CellRange& range : ranges)
  {
    range.firstElement = elements;
    range.firstCoefficient = coefficients;
    elements += range.kept.size();
    coefficients += range.coefficients;
    anyRational = anyRational || range.anyRational;
    this->Result.census[range.block].add(range.census);
  }
  mesh.elements.resize(elements);
  this->Result.bases.resize(elements);
  mesh.coefficients.resize(coefficients);
  mesh.weights.resize(anyRational ? coefficients : 0);
  hop::forAll(this->Parallel, ranges.size(), [&](std::size_t r) { this->makeElements(ranges[r]); });
}

void Builder::makeElements(const CellRange& range)
{
  std::size_t coefficient = range.firstCoefficient;
  for (std::size_t i = 0; i < range.kept.size(); ++i)
  {
    const auto& [cell, basis] = range.kept[i];
    hop::Element& element = this->Result.mesh.elements[range.firstElement + i];
    element.domain = basis->basis.domain();
    element.degrees = this->elementDegrees(basis->basis);
    element.firstCoefficient = coefficient;
    element.rational = this->isRational(range.block, *basis);
    element.cell = this->Blocks.firstCell(range.block) + cell;
    this->Result.bases[range.firstElement + i] = basis;
    coefficient += hop::coefficientCount(element.domain, element.degrees);
  }
}

bool Builder::isRational(std::size_t block, const CellBasis& cell) const
{
  return cell.bezier && this->Blocks[block].grid->GetPointData()->GetRationalWeights();
}

Verdict Builder::read(const BlockCell& where, const CellBasis& basis, CellValues& values) const
{
  const InputBlock& block = this->Blocks[where.block];
  cellPoints(block.grid->GetCells(), where.cell, values.count, values.ids, values.copiedIds);
  const vtkIdType points = block.grid->GetNumberOfPoints();
  const auto isOutside = [points](vtkIdType id) { return id < 0 || id >= points; };
  if (std::any_of(values.ids, values.ids + values.count, isOutside))
  {
    return Verdict::BrokenConnectivity;
  }
  values.field.resize(values.count * this->Components);
  for (int c = 0; c < this->Components; ++c)
  {
    gatherComponent(block.scalars, values.ids, values.count,
      this->Result.squared ? c : this->Blocks.component(), values.field.data() + c,
      this->Components);
  }
  if (!std::all_of(values.field.begin(), values.field.end(), isUsable))
  {
    return Verdict::NotFinite;
  }
  values.weights.clear();
  vtkDataArray* weights = block.grid->GetPointData()->GetRationalWeights();
  if (basis.bezier && weights)
  {
    values.weights.resize(values.count);
    gatherComponent(weights, values.ids, values.count, 0, values.weights.data());
  }
  const auto isGood = [](double weight) { return weight > 0.0 && std::isfinite(weight); };
  return std::all_of(values.weights.begin(), values.weights.end(), isGood) ? Verdict::Keep
                                                                           : Verdict::BadWeights;
}

bool Builder::straddles(double lower, double upper) const
{
  return std::any_of(this->Isovalues.begin(), this->Isovalues.end(),
    [&](double c) { return lower <= c && c <= upper; });
}

/// Nodal values on both sides of an isovalue decide at once; else the convex hull of the Bernstein
/// coefficients does, widened by the rounding errors of the conversion. A magnitude is no larger
/// than the longest control vector, and no smaller either where the vector is constant. Positive weights
/// change no hull.
bool Builder::canHoldSurface(const CellBasis& cell, const CellValues& values) const
{
  const auto [lowest, highest] = std::minmax_element(values.field.begin(), values.field.end());
  if (!this->Result.squared && this->straddles(*lowest, *highest))
  {
    return true;
  }
  std::vector<double> control(
    static_cast<std::size_t>(cell.basis.coefficientCount()) * this->Components);
  cell.basis.toBernstein(values.field.data(), this->Components, control.data());
  const auto [lower, upper] = std::minmax_element(control.begin(), control.end());
  const double slack =
    2.0 * cell.basis.conversionError() * std::max(std::abs(*lowest), std::abs(*highest)) +
    4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(*lower), std::abs(*upper));
  if (!this->Result.squared)
  {
    return this->straddles(*lower - slack, *upper + slack);
  }
  double longest2 = 0.0;
  for (std::size_t i = 0; i < control.size(); i += this->Components)
  {
    longest2 = std::max(
      longest2, std::inner_product(&control[i], &control[i] + this->Components, &control[i], 0.0));
  }
  const double longest = std::sqrt(longest2);
  const double margin = this->Components * slack;
  return this->straddles(this->isConstant(values) ? longest - margin : 0.0, longest + margin);
}

void Builder::convertElements()
{
  this->Signs.resize(this->Result.mesh.elements.size());
  hop::runParallel(this->Parallel, static_cast<std::ptrdiff_t>(this->Signs.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      CellValues values;
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        this->Signs[e] = this->convert(static_cast<int>(e), values);
      }
    });
}

/// Writes an element's coefficients: homogeneous ones and their weights for a rational cell, those of
/// the squared magnitude where that is the field.
hop::JacobianSign Builder::convert(int element, CellValues& values)
{
  hop::ElementMesh& mesh = this->Result.mesh;
  const hop::Element& e = mesh.elements[element];
  const CellBasis& cell = *this->Result.bases[element];
  const BlockCell where = this->Blocks.locate(e.cell);
  this->read(where, cell, values);
  const std::vector<double> control =
    this->controlValues(this->Blocks[where.block].grid, cell, values);
  const int width = 3 + this->Components;
  const int count = cell.basis.coefficientCount();
  std::vector<double> weights(count, 1.0);
  if (e.rational)
  {
    cell.basis.toBernstein(values.weights.data(), 1, weights.data());
  }
  std::vector<hop::Coefficient> plain(count);
  for (int i = 0; i < count; ++i)
  {
    const double* row = &control[static_cast<std::size_t>(i) * width];
    plain[i] = { row[0], row[1], row[2], std::accumulate(row + 3, row + width, 0.0) };
  }
  const hop::BernsteinForm form{ cell.basis.domain(), cell.basis.degrees(), plain.data(),
    e.rational ? weights.data() : nullptr };
  // At the highest degrees the bound is far above what coordinates suffer that vary smoothly.
  constexpr double largestRounding = 1e-6;
  const hop::JacobianSign sign =
    cell.jacobian.sign(form, std::min(cell.basis.conversionError(), largestRounding));

  hop::Coefficient* coefficients = &mesh.coefficients[e.firstCoefficient];
  if (this->Result.squared)
  {
    weights = hop::squareField(form.domain, form.degrees, width, control, weights, coefficients);
  }
  else
  {
    if (!e.rational)
    {
      snapToIsovalues(plain, this->Isovalues, cell.basis.conversionNorm());
    }
    std::copy(plain.begin(), plain.end(), coefficients);
  }
  if (e.rational)
  {
    std::copy(weights.begin(), weights.end(), &mesh.weights[e.firstCoefficient]);
  }
  return sign;
}

/// Bernstein coefficients of x, y, z and the field's components, times the weight if there is one.
std::vector<double> Builder::controlValues(
  vtkUnstructuredGrid* grid, const CellBasis& cell, const CellValues& values) const
{
  const int width = 3 + this->Components;
  const int nodes = cell.basis.nodeCount();
  std::vector<double> nodal(static_cast<std::size_t>(nodes) * width);
  for (int c = 0; c < 3; ++c)
  {
    gatherComponent(grid->GetPoints()->GetData(), values.ids, nodes, c, nodal.data() + c, width);
  }
  for (int node = 0; node < nodes; ++node)
  {
    double* row = &nodal[static_cast<std::size_t>(node) * width];
    std::copy_n(
      &values.field[static_cast<std::size_t>(node) * this->Components], this->Components, row + 3);
    for (int c = 0; c < width && !values.weights.empty(); ++c)
    {
      row[c] *= values.weights[node];
    }
  }
  // The conversion enlarges rounding errors, so it is given differences from the first node.
  std::vector<double> origin(width, 0.0);
  if (cell.basis.conversionNorm() > 1.0)
  {
    std::copy_n(nodal.begin(), width, origin.begin());
  }
  addToRows(nodal, -1.0, origin);
  std::vector<double> control(static_cast<std::size_t>(cell.basis.coefficientCount()) * width);
  cell.basis.toBernstein(nodal.data(), width, control.data());
  addToRows(control, 1.0, origin);
  return control;
}

/// Takes out elements without volume and those whose coordinates are not finite.
void Builder::dropCollapsed()
{
  hop::ElementMesh& mesh = this->Result.mesh;
  std::size_t kept = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    const auto [block, cell] = this->Blocks.locate(mesh.elements[e].cell);
    CellCensus& census = this->Result.census[block];
    const hop::JacobianSign sign = this->Signs[e];
    if (sign == hop::JacobianSign::NotFinite)
    {
      census.notFinite.add(cell);
      continue;
    }
    if (sign == hop::JacobianSign::Zero)
    {
      census.collapsed.add(cell);
      continue;
    }
    if (sign == hop::JacobianSign::Mixed)
    {
      census.folded.add(cell);
    }
    mesh.elements[kept] = mesh.elements[e];
    this->Result.bases[kept++] = this->Result.bases[e];
  }
  mesh.elements.resize(kept);
  this->Result.bases.resize(kept);
}

bool Builder::isGhost(const hop::Element& element) const
{
  const auto [block, cell] = this->Blocks.locate(element.cell);
  return isGhostCell(this->Ghosts[block], cell);
}

/// A ghost whose original, or another copy, is here too would claim the faces of its neighbours a
/// second time: readers of files in pieces bring both together.
void Builder::dropDoubledGhosts()
{
  hop::ElementMesh& mesh = this->Result.mesh;
  std::vector<char> ghosts;
  for (const hop::Element& element : mesh.elements)
  {
    ghosts.push_back(this->isGhost(element));
  }
  if (std::find(ghosts.begin(), ghosts.end(), true) == ghosts.end())
  {
    return;
  }
  const auto sortedCorners = [](const hop::Element& element)
  {
    auto corners = element.corners;
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::set<decltype(hop::Element::corners)> present;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    if (!ghosts[e])
    {
      present.insert(sortedCorners(mesh.elements[e]));
    }
  }
  std::size_t kept = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    if (!ghosts[e] || present.insert(sortedCorners(mesh.elements[e])).second)
    {
      mesh.elements[kept] = mesh.elements[e];
      this->Tolerances[kept] = this->Tolerances[e];
      this->Result.bases[kept++] = this->Result.bases[e];
    }
  }
  mesh.elements.resize(kept);
  this->Tolerances.resize(kept);
  this->Result.bases.resize(kept);
}

} // namespace

GridElements buildGridElements(const InputBlocks& blocks, hop::NodeSpacing spacing,
  const std::vector<double>& isovalues, const hop::ParallelFor& parallelFor,
  const std::function<void(double)>& reached)
{
  return Builder(blocks, spacing, isovalues, parallelFor, reached).build();
}
