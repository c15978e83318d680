#include "Conversion/DeriveCells.h"

#include "Conversion/CellValues.h"
#include "Conversion/ConvertCells.h"
#include "Conversion/RunUnits.h"
#include "Elements/DerivativeBounds.h"
#include "Elements/FieldExpression.h"
#include "Elements/RangeArithmetic.h"
#include "Elements/SampledField.h"

#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hop
{

namespace
{

/// Highest degree of products on curved cells, before their degrees are lowered. Larger: particles of such cells cost more
/// than those of their interpolated parts; smaller: cubic cells are interpolated, too, and are not exact any more.
constexpr int MostOfProducts = 16;

/// How often parts are halved on, each alone, where the polynomials lose a component and particles stand on the field
/// itself. Fewer: components beside creases of lambda 2 are missed (test_derived_components.py); more: parts of many small
/// ones cost more.
constexpr int MostHalvingsOfParts = 3;

/// The eight parts that halving all edges of a part gives.
std::vector<ReferencePart> halvesOf(Domain domain, const ReferencePart& part)
{
  std::vector<ReferencePart> halves = partsOf(domain, 1);
  for (ReferencePart& half : halves)
  {
    half = { part.inWhole({ half.origin }).xyz, part.axes * half.axes };
  }
  return halves;
}

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

/// Of the control points, and so of all values of a component.
Range hullOf(const SourceElement& source, int component)
{
  const std::size_t count = source.control.size() / source.width;
  const auto point = [&](std::size_t i)
  {
    const double weight = source.isRational ? source.weights[i] : 1.0;
    return source.control[i * source.width + component] / weight;
  };
  Range range{ point(0), point(0) };
  for (std::size_t i = 1; i < count; ++i)
  {
    range.include(point(i));
  }
  return range;
}

/// Whether particles can stand on the quantity of the cell's own polynomials, so that others only find the surface.
StandIn standInFor(Quantity quantity, const SourceElement& source)
{
  const bool hasExact = quantity != Quantity::Expression && source.width - 3 <= MostExactComponents;
  return hasExact ? StandIn::Proof : StandIn::Surface;
}

/// The field of a run whose coordinates are divided by a unit. A formula is told of world units.
FieldFunction functionIn(const InputBlocks& blocks, double unitOfLength)
{
  if (blocks.quantity() != Quantity::Expression)
  {
    return functionOf(blocks.quantity());
  }
  return [expression = blocks.expression(), unitOfLength](const FieldPoint& at)
  {
    FieldPoint inWorld = at;
    inWorld.x *= unitOfLength;
    for (glm::dvec3& gradient : inWorld.gradients)
    {
      gradient /= unitOfLength;
    }
    return (*expression)(inWorld);
  };
}

/// Derives cells. All threads share one Deriver.
class Deriver
{
public:
  Deriver(const InputBlocks& blocks, const std::vector<double>& isovalues, DerivingBy way,
    int halvings, double unitOfLength)
    : Blocks(blocks)
    , Isovalues(isovalues)
    , Way(way)
    , UnitOfLength(unitOfLength)
    , Function(functionIn(blocks, unitOfLength))
    , Parts{ partsOf(Domain::Hexahedron, halvings), partsOf(Domain::Tetrahedron, halvings),
      partsOf(Domain::Wedge, halvings) }
  {
  }

  void derive(JudgedCells& range, CellValues& values) const;

private:
  /// The elements of one cell, and how much its field changes.
  struct Found
  {
    std::vector<DerivedCell> cells;
    double change = 0.0;
  };

  /// A cell that is derived part by part.
  struct SampledCell
  {
    const SourceElement& source;
    StandIn standIn = StandIn::Surface;
    double rounding = 0.0;
    /// What its parts have in common.
    DerivedCell whole;
    FieldSampler sampler;
    Found& found;
  };

  Verdict derive(std::size_t block, const KeptCell& kept, CellValues& values, Found& found) const;
  Verdict findByProducts(
    const SourceElement& source, double rounding, DerivedCell cell, Found& found) const;
  Verdict findBySamples(
    const SourceElement& source, double rounding, DerivedCell cell, Found& found) const;
  Verdict findInParts(
    const std::vector<ReferencePart>& parts, int halvings, SampledCell& cell) const;
  Verdict findInPart(const ReferencePart& place, int halvings, SampledCell& cell) const;
  Verdict judge(const Range& range, double slack, int exponent, double& change) const;
  std::vector<double> levelsOf(int exponent) const;
  bool straddles(const Range& range, int exponent) const;
  Range boundsOf(const SourceElement& source, const DerivativeBounds& bounds) const;

  const InputBlocks& Blocks;
  const std::vector<double>& Isovalues;
  DerivingBy Way;
  double UnitOfLength;
  FieldFunction Function;
  /// By domain.
  std::array<std::vector<ReferencePart>, 3> Parts;
};

void Deriver::derive(JudgedCells& range, CellValues& values) const
{
  std::vector<KeptCell> kept;
  range.derived.clear();
  for (std::size_t i = 0; i < range.kept.size(); ++i)
  {
    const KeptCell& cell = range.kept[i];
    if (i > 0 && range.kept[i - 1].cell == cell.cell)
    {
      continue; // another part of it
    }
    Found found;
    const Verdict verdict = this->derive(range.block, cell, values, found);
    if (verdict != Verdict::Keep)
    {
      range.census.count(
        verdict, cell.cell, this->Blocks[range.block].grid->GetCellType(cell.cell));
      continue;
    }
    for (DerivedCell& derived : found.cells)
    {
      derived.partsOfCell = found.cells.size();
      kept.push_back({ cell.cell, cell.basis, found.change });
      range.derived.push_back(std::move(derived));
    }
  }
  range.kept = std::move(kept);
}

Verdict Deriver::derive(
  std::size_t block, const KeptCell& kept, CellValues& values, Found& found) const
{
  const CellBasis& cell = *kept.basis;
  const BlockCell where{ block, kept.cell };
  const Verdict verdict = readCell(this->Blocks, where, cell, values);
  if (verdict != Verdict::Keep)
  {
    return verdict;
  }
  const int unit = this->Blocks.quantity() == Quantity::Expression ? 0 : scaleField(values);
  const ControlNet net = controlNet(this->Blocks, where, cell, values, this->UnitOfLength);
  const SourceElement source{ cell.basis.domain(), cell.basis.degrees(), net.width, net.control,
    net.weights, net.isRational, coordinateError(this->Blocks[block].grid, net) };
  const DerivativeBounds bounds(source);
  const int exponent = orderOf(this->Blocks.quantity()) * (unit - std::ilogb(this->UnitOfLength));
  const bool canHoldSurface = this->straddles(this->boundsOf(source, bounds), exponent);
  if (!canHoldSurface && bounds.isRegular())
  {
    return Verdict::Drop;
  }
  DerivedCell derived;
  derived.exponent = exponent;
  derived.sign = signOf(cell, net);
  if (derived.sign != JacobianSign::Positive && derived.sign != JacobianSign::Negative)
  {
    found.cells.push_back(std::move(derived));
    return Verdict::Keep;
  }
  if (!canHoldSurface)
  {
    return Verdict::Drop;
  }
  const double rounding = bounds.rounding(this->Blocks.quantity());
  return this->Way == DerivingBy::Products
    ? this->findByProducts(source, rounding, std::move(derived), found)
    : this->findBySamples(source, rounding, std::move(derived), found);
}

/// Bounds of the quantity, or of its square where that is derived. A formula is told of world units.
Range Deriver::boundsOf(const SourceElement& source, const DerivativeBounds& bounds) const
{
  if (this->Blocks.quantity() != Quantity::Expression)
  {
    return bounds.of(this->Blocks.quantity());
  }
  FieldBounds in{ {}, {}, bounds.gradient() };
  for (std::array<Range, 3>& row : in.gradients)
  {
    for (Range& entry : row)
    {
      entry = scaledBy(1.0 / this->UnitOfLength, entry);
    }
  }
  for (int c = 0; c < source.width; ++c)
  {
    const Range range = hullOf(source, c);
    if (c < 3)
    {
      in.x[c] = scaledBy(this->UnitOfLength, range);
      continue;
    }
    in.values.push_back(range);
  }
  return this->Blocks.expression()->bounds(in);
}

/// Derives the whole cell, if it can hold surface.
Verdict Deriver::findByProducts(
  const SourceElement& source, double rounding, DerivedCell cell, Found& found) const
{
  const Quantity quantity = this->Blocks.quantity();
  const Derivation derivation(source, quantity, standInFor(quantity, source));
  const Degrees most = derivation.degreesAtMost();
  const bool isTooHigh =
    !derivation.isAffine() && *std::max_element(most.begin(), most.end()) > MostOfProducts;
  cell.element.state = DerivedElement::State::DegreeTooHigh;
  if (!isTooHigh)
  {
    cell.element = derivation.element();
  }
  const DerivedElement& element = cell.element;
  if (element.state == DerivedElement::State::Singular)
  {
    return Verdict::Singular;
  }
  cell.isResolved = element.state == DerivedElement::State::Sound;
  if (cell.isResolved)
  {
    Range range{ std::numeric_limits<double>::infinity(),
      -std::numeric_limits<double>::infinity() };
    for (std::size_t i = 0; i < element.coefficients.size(); ++i)
    {
      range.include(
        element.coefficients[i].w / (element.weights.empty() ? 1.0 : element.weights[i]));
    }
    const Verdict verdict = this->judge(range, rounding, cell.exponent, found.change);
    if (verdict != Verdict::Keep)
    {
      return verdict;
    }
    if (element.standIn == StandIn::Proof)
    {
      cell.exact = exactSource(source, quantity);
    }
  }
  found.cells.push_back(std::move(cell));
  return Verdict::Keep;
}

/// Derives the parts of the cell that can hold surface.
Verdict Deriver::findBySamples(
  const SourceElement& source, double rounding, DerivedCell cell, Found& found) const
{
  const StandIn standIn = standInFor(this->Blocks.quantity(), source);
  SampledCell sampled{ source, standIn, rounding, std::move(cell),
    FieldSampler(source, this->Blocks.quantity(), this->Function, rounding, standIn), found };
  const int halvings = standIn == StandIn::Proof ? MostHalvingsOfParts : 0;
  return this->findInParts(this->Parts[static_cast<std::size_t>(source.domain)], halvings, sampled);
}

/// \param halvings that parts may take, see findInPart()
Verdict Deriver::findInParts(
  const std::vector<ReferencePart>& parts, int halvings, SampledCell& cell) const
{
  Verdict verdict = Verdict::Drop;
  for (const ReferencePart& part : parts)
  {
    const Verdict ofPart = this->findInPart(part, halvings, cell);
    if (ofPart == Verdict::Undefined || ofPart == Verdict::Singular)
    {
      return ofPart;
    }
    verdict = verdict == Verdict::Keep ? verdict : ofPart;
  }
  return verdict;
}

/// Derives a part of a cell, or its halves where the part's polynomial loses a component.
/// \param halvings that may follow
Verdict Deriver::findInPart(const ReferencePart& place, int halvings, SampledCell& cell) const
{
  SampledPart sampled = cell.sampler.sample(
    place, [&](const Range& range) { return this->straddles(range, cell.whole.exponent); },
    halvings > 0 ? this->levelsOf(cell.whole.exponent) : std::vector<double>());
  if (sampled.element.state != DerivedElement::State::Sound)
  {
    return sampled.element.state == DerivedElement::State::NotFinite ? Verdict::Undefined
                                                                     : Verdict::Singular;
  }
  if (!sampled.canHoldSurface)
  {
    return Verdict::Drop;
  }
  if (sampled.losesComponents)
  {
    return this->findInParts(halvesOf(cell.source.domain, place), halvings - 1, cell);
  }
  Range range{ std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  for (const Coefficient& coefficient : sampled.element.coefficients)
  {
    range.include(coefficient.w);
  }
  double change = 0.0;
  const Verdict verdict = this->judge(range, cell.rounding, cell.whole.exponent, change);
  if (verdict == Verdict::Keep)
  {
    if (cell.standIn == StandIn::Proof && cell.whole.exact.coefficients.empty())
    {
      cell.whole.exact = exactSource(cell.source, this->Blocks.quantity());
    }
    DerivedCell& part = cell.found.cells.emplace_back(cell.whole);
    part.element = std::move(sampled.element);
    part.place = place;
    part.exact.field.part = place;
    part.isResolved = sampled.isResolved;
    cell.found.change = std::max(cell.found.change, change);
  }
  return verdict;
}
/// Whether a field with that range can hold surface, or is the same throughout.
/// \param change receives how much the quantity changes
Verdict Deriver::judge(const Range& range, double slack, int exponent, double& change) const
{
  if (!this->straddles({ range.lower - slack, range.upper + slack }, exponent))
  {
    return Verdict::Drop;
  }
  const bool isSquare = isSquareRoot(this->Blocks.quantity());
  change = isSquare ? std::sqrt(range.magnitude()) : range.upper - range.lower;
  change = std::ldexp(change, isSquare ? exponent / 2 : exponent);
  return range.upper - range.lower <= slack ? Verdict::Level : Verdict::Keep;
}

/// The isovalues in the field of a derived cell.
std::vector<double> Deriver::levelsOf(int exponent) const
{
  const bool isSquare = isSquareRoot(this->Blocks.quantity());
  std::vector<double> levels;
  for (const double c : this->Isovalues)
  {
    const double level = std::ldexp(c, isSquare ? -exponent / 2 : -exponent);
    if (!isSquare || c >= 0.0)
    {
      levels.push_back(isSquare ? level * level : level);
    }
  }
  return levels;
}

/// Whether an isovalue of the quantity lies in a range of the field of a derived cell.
bool Deriver::straddles(const Range& range, int exponent) const
{
  const std::vector<double> levels = this->levelsOf(exponent);
  return std::any_of(levels.begin(), levels.end(),
    [&](double level) { return range.lower <= level && level <= range.upper; });
}

} // namespace

void deriveCells(const InputBlocks& blocks, const std::vector<double>& isovalues, DerivingBy way,
  int halvings, double unitOfLength, std::vector<JudgedCells>& ranges,
  const ParallelFor& parallelFor)
{
  const Deriver deriver(blocks, isovalues, way, halvings, unitOfLength);
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
  if (element.exactField >= 0)
  {
    ExactField& field = mesh.exactFields[element.exactField];
    const std::size_t first = field.firstCoefficient;
    field = cell.exact.field;
    field.firstCoefficient = first;
    field.scale = std::ldexp(1.0, cell.exponent - unit);
    std::copy(cell.exact.coefficients.begin(), cell.exact.coefficients.end(),
      mesh.exactCoefficients.begin() + static_cast<std::ptrdiff_t>(first));
  }
  if (element.rational)
  {
    std::copy(cell.element.weights.begin(), cell.element.weights.end(),
      &mesh.weights[element.firstCoefficient]);
  }
  return isUsable ? cell.sign : JacobianSign::NotFinite;
}

} // namespace hop
