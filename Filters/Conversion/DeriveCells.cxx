#include "Conversion/DeriveCells.h"

#include "Conversion/CellValues.h"
#include "Conversion/ConvertCells.h"
#include "Conversion/RunUnits.h"

#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hop
{

namespace
{

/// Divides the field by a unit in which it is about one.
/// \return the exponent of the unit, a power of two
int scaleField(CellValues& values)
{
  double largest = 0.0;
  for (const double value : values.field)
  {
    largest = std::max(largest, std::abs(value));
  }
  const double unit = unitOf(largest);
  for (double& value : values.field)
  {
    value /= unit;
  }
  return std::ilogb(unit);
}

/// Largest error of a cell's coordinates, in their unit: they are stored in single or in double precision.
double coordinateError(vtkUnstructuredGrid* grid, const ControlNet& net)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < net.control.size(); i += net.width)
  {
    for (int c = 0; c < 3; ++c)
    {
      largest = std::max(largest, std::abs(net.control[i + c]));
    }
  }
  const bool isDouble = grid->GetPoints()->GetDataType() == VTK_DOUBLE;
  return largest *
    (isDouble ? std::numeric_limits<double>::epsilon()
              : double(std::numeric_limits<float>::epsilon()));
}

/// Derives cells. All threads share one Deriver.
class Deriver
{
public:
  Deriver(const InputBlocks& blocks, const std::vector<double>& isovalues, double unitOfLength)
    : Blocks(blocks)
    , Isovalues(isovalues)
    , UnitOfLength(unitOfLength)
  {
  }

  void derive(JudgedCells& range, CellValues& values) const;

private:
  Verdict derive(std::size_t block, KeptCell& kept, CellValues& values, DerivedCell& derived) const;
  Verdict find(const Derivation& derivation, DerivedCell& derived, double& change) const;
  bool straddles(const Range& range, int exponent) const;

  const InputBlocks& Blocks;
  const std::vector<double>& Isovalues;
  double UnitOfLength;
};

void Deriver::derive(JudgedCells& range, CellValues& values) const
{
  std::vector<KeptCell> kept;
  for (KeptCell& cell : range.kept)
  {
    DerivedCell derived;
    const Verdict verdict = this->derive(range.block, cell, values, derived);
    if (verdict == Verdict::Keep)
    {
      kept.push_back(cell);
      range.derived.push_back(std::move(derived));
    }
    else
    {
      range.census.count(
        verdict, cell.cell, this->Blocks[range.block].grid->GetCellType(cell.cell));
    }
  }
  range.kept = std::move(kept);
}

Verdict Deriver::derive(
  std::size_t block, KeptCell& kept, CellValues& values, DerivedCell& derived) const
{
  const CellBasis& cell = *kept.basis;
  const BlockCell where{ block, kept.cell };
  const Verdict verdict = readCell(this->Blocks, where, cell, values);
  if (verdict != Verdict::Keep)
  {
    return verdict;
  }
  const int unit = scaleField(values);
  const ControlNet net = controlNet(this->Blocks, where, cell, values, this->UnitOfLength);
  derived.sign = net.sign;
  if (net.sign != JacobianSign::Positive && net.sign != JacobianSign::Negative)
  {
    return Verdict::Keep;
  }
  derived.exponent = orderOf(this->Blocks.quantity()) * (unit - std::ilogb(this->UnitOfLength));
  const SourceElement source{ cell.basis.domain(), cell.basis.degrees(), net.width, net.control,
    net.weights, !values.weights.empty(), coordinateError(this->Blocks[block].grid, net) };
  return this->find(Derivation(source, this->Blocks.quantity()), derived, kept.change);
}

/// Derives the element, if it can hold surface.
Verdict Deriver::find(const Derivation& derivation, DerivedCell& derived, double& change) const
{
  if (!this->straddles(derivation.bounds(), derived.exponent))
  {
    return Verdict::Drop;
  }
  derived.element = derivation.element();
  switch (derived.element.state)
  {
    case DerivedElement::State::DegreeTooHigh:
      return Verdict::DegreeTooHigh;
    case DerivedElement::State::Singular:
      return Verdict::Singular;
    case DerivedElement::State::Sound:
      break;
  }
  const DerivedElement& element = derived.element;
  Range range{ std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  for (std::size_t i = 0; i < element.coefficients.size(); ++i)
  {
    range.include(element.coefficients[i].w / (element.weights.empty() ? 1.0 : element.weights[i]));
  }
  const double slack = derivation.rounding();
  if (!this->straddles({ range.lower - slack, range.upper + slack }, derived.exponent))
  {
    return Verdict::Drop;
  }
  const bool isSquare = isSquareRoot(this->Blocks.quantity());
  change = isSquare ? std::sqrt(range.magnitude()) : range.upper - range.lower;
  change = std::ldexp(change, isSquare ? derived.exponent / 2 : derived.exponent);
  return range.upper - range.lower <= slack ? Verdict::Level : Verdict::Keep;
}

/// Whether an isovalue of the quantity lies in a range of the field of a derived cell.
bool Deriver::straddles(const Range& range, int exponent) const
{
  const bool isSquare = isSquareRoot(this->Blocks.quantity());
  return std::any_of(this->Isovalues.begin(), this->Isovalues.end(),
    [&](double c)
    {
      const double level = std::ldexp(c, isSquare ? -exponent / 2 : -exponent);
      const double field = isSquare ? level * level : level;
      return (!isSquare || c >= 0.0) && range.lower <= field && field <= range.upper;
    });
}

} // namespace

void deriveCells(const InputBlocks& blocks, const std::vector<double>& isovalues,
  double unitOfLength, std::vector<JudgedCells>& ranges, const ParallelFor& parallelFor)
{
  const Deriver deriver(blocks, isovalues, unitOfLength);
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(ranges.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      CellValues values;
      for (std::ptrdiff_t r = begin; r < end; ++r)
      {
        deriver.derive(ranges[r], values);
      }
    });
}

JacobianSign writeDerived(const DerivedCell& cell, Quantity quantity, double unitOfValue,
  const Element& element, ElementMesh& mesh)
{
  // The gradient of the field can be squared: 1e75 to the fourth power is below the largest double.
  constexpr double largest = 1e75;
  const int unit = std::ilogb(unitOfValue) * (isSquareRoot(quantity) ? 2 : 1);
  bool isUsable = true;
  for (std::size_t i = 0; i < cell.element.coefficients.size(); ++i)
  {
    Coefficient c = cell.element.coefficients[i];
    c.w = std::ldexp(c.w, cell.exponent - unit);
    isUsable = isUsable && std::abs(c.w) <= largest;
    mesh.coefficients[element.firstCoefficient + i] = c;
  }
  if (element.rational)
  {
    std::copy(cell.element.weights.begin(), cell.element.weights.end(),
      &mesh.weights[element.firstCoefficient]);
  }
  return isUsable ? cell.sign : JacobianSign::NotFinite;
}

} // namespace hop
