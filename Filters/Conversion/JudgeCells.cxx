#include "Conversion/JudgeCells.h"

#include "Conversion/CellValues.h"
#include "Conversion/RunUnits.h"

#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hop
{

namespace
{

/// All cells in ranges, in ascending order, not yet judged.
std::vector<JudgedCells> rangesOfCells(const InputBlocks& blocks)
{
  // Ranges are the pieces of work that threads take, and each has a list of kept cells. Fewer leave threads without
  // work in the end; more, or smaller ones, cost more lists. Both numbers chosen by experiment.
  constexpr vtkIdType wantedRanges = 1024;
  constexpr vtkIdType mostCells = 4096;
  const vtkIdType cellsAtOnce =
    std::clamp<vtkIdType>(blocks.cellCount() / wantedRanges, 1, mostCells);
  std::vector<JudgedCells> ranges;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const vtkIdType count = blocks[b].grid->GetNumberOfCells();
    for (vtkIdType begin = 0; begin < count; begin += cellsAtOnce)
    {
      ranges.push_back({ b, begin, std::min(count, begin + cellsAtOnce), {}, {}, {} });
    }
  }
  return ranges;
}

/// Whether all nodes have the same values.
bool isConstant(const CellValues& values)
{
  return std::equal(
    values.field.begin() + values.components, values.field.end(), values.field.begin());
}

double largestOf(const std::vector<double>& values)
{
  const auto larger = [](double a, double b) { return std::max(a, std::abs(b)); };
  return std::accumulate(values.begin(), values.end(), 0.0, larger);
}

/// Whether all nodes have the same values up to the rounding of doubles: what such a field is beside them is noise.
bool isConstantToRounding(const CellValues& values)
{
  // Roundings of the largest value. Larger: fields that change by little beside their values lose surface; smaller: noise
  // of a solver's last digits is surface.
  constexpr double roundings = 16.0 * std::numeric_limits<double>::epsilon();
  const double slack = roundings * largestOf(values.field);
  for (std::size_t i = values.components; i < values.field.size(); ++i)
  {
    if (!(std::abs(values.field[i] - values.field[i % values.components]) <= slack))
    {
      return false;
    }
  }
  return true;
}

/// The magnitude of the longest of some vectors. Their squares neither overflow nor underflow.
/// \param components of each vector; `vectors` lists them vector by vector
double longestOf(const std::vector<double>& vectors, int components)
{
  const double unit = unitOf(largestOf(vectors));
  double longest2 = 0.0;
  for (std::size_t i = 0; i < vectors.size(); i += components)
  {
    double length2 = 0.0;
    for (int c = 0; c < components; ++c)
    {
      const double component = vectors[i + c] / unit;
      length2 += component * component;
    }
    longest2 = std::max(longest2, length2);
  }
  return unit * std::sqrt(longest2);
}

/// See KeptCell::change.
double changeOf(const CellValues& values)
{
  if (values.components > 1)
  {
    return largestOf(values.field);
  }
  const auto [lowest, highest] = std::minmax_element(values.field.begin(), values.field.end());
  return *highest - *lowest;
}

/// Judges cells. All threads share one Judge.
class Judge
{
public:
  Judge(const InputBlocks& blocks, const std::vector<double>& isovalues)
    : Blocks(blocks)
    , Isovalues(isovalues)
  {
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      this->Ghosts.push_back(blocks[b].grid->GetCellGhostArray());
    }
  }

  void judge(JudgedCells& range, BasisLookup& bases, CellValues& values) const;

private:
  Verdict judge(const BlockCell& where, const CellBasis* cell, CellValues& values) const;
  bool canHoldSurface(const CellBasis& cell, const CellValues& values) const;
  bool straddles(double lower, double upper) const;

  const InputBlocks& Blocks;
  const std::vector<double>& Isovalues;
  /// The ghost array of each block, or nullptr. They are looked up before threads start, because a grid's first look-up
  /// changes the grid.
  std::vector<vtkUnsignedCharArray*> Ghosts;
};

void Judge::judge(JudgedCells& range, BasisLookup& bases, CellValues& values) const
{
  vtkUnstructuredGrid* grid = this->Blocks[range.block].grid;
  for (vtkIdType cell = range.begin; cell < range.end; ++cell)
  {
    const CellBasis* basis = bases.basisOf(grid, cell);
    const Verdict verdict = this->judge({ range.block, cell }, basis, values);
    if (verdict == Verdict::Keep)
    {
      range.kept.push_back({ cell, basis, changeOf(values) });
    }
    else
    {
      range.census.count(verdict, cell, grid->GetCellType(cell));
    }
  }
}

/// \param cell the cell's basis, or nullptr
Verdict Judge::judge(const BlockCell& where, const CellBasis* cell, CellValues& values) const
{
  if (isGhostCell(this->Ghosts[where.block], where.cell))
  {
    return Verdict::Ghost;
  }
  if (!cell)
  {
    return Verdict::Unsupported;
  }
  const Verdict verdict = readCell(this->Blocks, where, *cell, values);
  if (verdict != Verdict::Keep)
  {
    return verdict;
  }
  if (!this->canHoldSurface(*cell, values))
  {
    return Verdict::Drop;
  }
  const bool isLevel = this->Blocks.quantity() != Quantity::Expression &&
    (this->Blocks.isDerived() ? isConstant(values) : isConstantToRounding(values));
  return isLevel ? Verdict::Level : Verdict::Keep;
}

/// Whether the cell can hold one of the isosurfaces. It can if nodal values lie on both sides of an isovalue; otherwise
/// the convex hull of the Bernstein coefficients decides, widened by the rounding errors of the conversion. A magnitude
/// is at most that of the longest control vector, and equal to it where the vector is constant. Positive weights do not
/// change the hull. A derived field is zero where
/// the array is constant; more is found out by deriveCells().
bool Judge::canHoldSurface(const CellBasis& cell, const CellValues& values) const
{
  if (this->Blocks.quantity() == Quantity::Expression)
  {
    return true; // it may be made of coordinates alone
  }
  if (this->Blocks.isDerived())
  {
    return !isConstant(values) || this->straddles(0.0, 0.0);
  }
  const auto [lowest, highest] = std::minmax_element(values.field.begin(), values.field.end());
  if (!this->Blocks.isMagnitude() && this->straddles(*lowest, *highest))
  {
    return true;
  }
  std::vector<double> control(
    static_cast<std::size_t>(cell.basis.coefficientCount()) * values.components);
  cell.basis.toBernstein(values.field.data(), values.components, control.data());
  const auto [lower, upper] = std::minmax_element(control.begin(), control.end());
  const double slack =
    2.0 * cell.basis.conversionError() * std::max(std::abs(*lowest), std::abs(*highest)) +
    4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(*lower), std::abs(*upper));
  if (!this->Blocks.isMagnitude())
  {
    return this->straddles(*lower - slack, *upper + slack);
  }
  const double longest = longestOf(control, values.components);
  const double margin = values.components * slack;
  return this->straddles(isConstantToRounding(values) ? longest - margin : 0.0, longest + margin);
}

/// Whether an isovalue lies between the bounds.
bool Judge::straddles(double lower, double upper) const
{
  return std::any_of(this->Isovalues.begin(), this->Isovalues.end(),
    [&](double c) { return lower <= c && c <= upper; });
}

} // namespace

std::vector<JudgedCells> judgeCells(const InputBlocks& blocks, const std::vector<double>& isovalues,
  CellBases& kinds, const ParallelFor& parallelFor)
{
  std::vector<JudgedCells> ranges = rangesOfCells(blocks);
  const Judge judge(blocks, isovalues);
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(ranges.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      CellValues values;
      BasisLookup bases(kinds);
      for (std::ptrdiff_t r = begin; r < end; ++r)
      {
        judge.judge(ranges[r], bases, values);
      }
    });
  return ranges;
}

} // namespace hop
