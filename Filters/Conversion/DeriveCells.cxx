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
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>

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

/// How long a thread derives cells of one range before the others have their turn. Longer: the caller is asked less often
/// whether to go on; shorter: threads start anew more often.
constexpr std::chrono::milliseconds TimeOfTurn{ 20 };

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

/// The elements of one cell, and how much its field changes.
struct Found
{
  std::vector<DerivedCell> cells;
  double change = 0.0;
};

/// A part of a cell that is still to be derived.
struct OpenPart
{
  ReferencePart place;
  /// How often it may be halved.
  int halvings = 0;
};

/// A cell that is derived part by part, in several turns if it takes long.
struct SampledCell
{
  /// \param common what its parts have in common
  /// \param function outlives the cell
  SampledCell(const SourceElement& of, ControlNet ofCell, DerivedCell common, Quantity quantity,
    const FieldFunction& function, double noise)
    : net(std::move(ofCell))
    , source{ of.domain, of.degrees, of.width, net.control, net.weights, of.isRational,
      of.coordinateError }
    , standIn(standInFor(quantity, source))
    , rounding(noise)
    , whole(std::move(common))
    , sampler(source, quantity, function, noise, standIn)
  {
  }
  SampledCell(const SampledCell&) = delete;
  SampledCell& operator=(const SampledCell&) = delete;

  /// \param halvings that each part may take
  void open(const std::vector<ReferencePart>& parts, int halvings)
  {
    std::transform(parts.rbegin(), parts.rend(), std::back_inserter(this->openParts),
      [halvings](const ReferencePart& part) {
        return OpenPart{ part, halvings };
      });
  }

  ControlNet net;
  SourceElement source;
  StandIn standIn;
  double rounding;
  DerivedCell whole;
  FieldSampler sampler;
  /// The next one last.
  std::vector<OpenPart> openParts;
  Found found;
  Verdict verdict = Verdict::Drop;
};

/// A range whose cells are derived in turns.
struct RangeInTurns
{
  JudgedCells& range;
  /// The next of its kept cells.
  std::size_t next = 0;
  /// The cell that a turn has ended in, if any.
  std::unique_ptr<SampledCell> open;
  /// The cells that are kept in the end.
  std::vector<KeptCell> kept;

  bool isDone() const { return this->next == this->range.kept.size(); }
};

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

  /// Derives cells of a range, or parts of them, for a while. Where a turn ends, changes nothing of what is found.
  void takeTurn(RangeInTurns& turns, CellValues& values) const;

private:
  void begin(RangeInTurns& turns, CellValues& values) const;
  void finish(RangeInTurns& turns, Verdict verdict, Found& found) const;
  Verdict derive(std::size_t block, const KeptCell& kept, CellValues& values, Found& found,
    std::unique_ptr<SampledCell>& sampled) const;
  Verdict findByProducts(
    const SourceElement& source, double rounding, DerivedCell cell, Found& found) const;
  void findInNextPart(SampledCell& cell) const;
  std::optional<Verdict> findInPart(const OpenPart& part, SampledCell& cell) const;
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

void Deriver::takeTurn(RangeInTurns& turns, CellValues& values) const
{
  const auto end = std::chrono::steady_clock::now() + TimeOfTurn;
  while (!turns.isDone() && std::chrono::steady_clock::now() < end)
  {
    if (!turns.open)
    {
      this->begin(turns, values);
    }
    else if (!turns.open->openParts.empty())
    {
      this->findInNextPart(*turns.open);
    }
    else
    {
      const std::unique_ptr<SampledCell> done = std::move(turns.open);
      this->finish(turns, done->verdict, done->found);
    }
  }
}

/// Derives the next cell, or opens it.
void Deriver::begin(RangeInTurns& turns, CellValues& values) const
{
  const std::vector<KeptCell>& cells = turns.range.kept;
  const KeptCell& cell = cells[turns.next];
  if (turns.next > 0 && cells[turns.next - 1].cell == cell.cell)
  {
    ++turns.next; // another part of it
    return;
  }
  Found found;
  const Verdict verdict = this->derive(turns.range.block, cell, values, found, turns.open);
  if (!turns.open)
  {
    this->finish(turns, verdict, found);
  }
}

/// Ends the next cell, and the range if it is its last one.
void Deriver::finish(RangeInTurns& turns, Verdict verdict, Found& found) const
{
  JudgedCells& range = turns.range;
  const KeptCell& cell = range.kept[turns.next];
  if (verdict == Verdict::Keep)
  {
    for (DerivedCell& derived : found.cells)
    {
      derived.partsOfCell = found.cells.size();
      turns.kept.push_back({ cell.cell, cell.basis, found.change });
      range.derived.push_back(std::move(derived));
    }
  }
  else
  {
    range.census.count(verdict, cell.cell, this->Blocks[range.block].grid->GetCellType(cell.cell));
  }
  ++turns.next;
}

/// \param sampled receives the cell, and the verdict is not final, if it is derived part by part
Verdict Deriver::derive(std::size_t block, const KeptCell& kept, CellValues& values, Found& found,
  std::unique_ptr<SampledCell>& sampled) const
{
  const CellBasis& cell = *kept.basis;
  const BlockCell where{ block, kept.cell };
  const Verdict verdict = readCell(this->Blocks, where, cell, values);
  if (verdict != Verdict::Keep)
  {
    return verdict;
  }
  const int unit = this->Blocks.quantity() == Quantity::Expression ? 0 : scaleField(values);
  ControlNet net = controlNet(this->Blocks, where, cell, values, this->UnitOfLength);
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
  if (this->Way == DerivingBy::Products)
  {
    return this->findByProducts(source, rounding, std::move(derived), found);
  }
  sampled = std::make_unique<SampledCell>(
    source, std::move(net), std::move(derived), this->Blocks.quantity(), this->Function, rounding);
  sampled->open(this->Parts[static_cast<std::size_t>(sampled->source.domain)],
    sampled->standIn == StandIn::Proof ? MostHalvingsOfParts : 0);
  return Verdict::Keep;
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

/// Derives the next part of a cell. A part in which the field is undefined or singular ends the cell.
void Deriver::findInNextPart(SampledCell& cell) const
{
  const OpenPart part = cell.openParts.back();
  cell.openParts.pop_back();
  const std::optional<Verdict> verdict = this->findInPart(part, cell);
  if (verdict == Verdict::Undefined || verdict == Verdict::Singular)
  {
    cell.openParts.clear();
    cell.verdict = *verdict;
  }
  else if (verdict && cell.verdict != Verdict::Keep)
  {
    cell.verdict = *verdict;
  }
}

/// Derives a part of a cell.
/// \return nothing where the part's polynomial loses a component, so that its halves are opened instead
std::optional<Verdict> Deriver::findInPart(const OpenPart& open, SampledCell& cell) const
{
  const auto& [place, halvings] = open;
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
    cell.open(halvesOf(cell.source.domain, place), halvings - 1);
    return std::nullopt;
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
  std::vector<RangeInTurns> all;
  for (JudgedCells& range : ranges)
  {
    range.derived.clear();
    all.push_back({ range, 0, nullptr, {} });
  }
  std::vector<RangeInTurns*> open;
  std::transform(
    all.begin(), all.end(), std::back_inserter(open), [](RangeInTurns& turns) { return &turns; });
  while (!open.empty())
  {
    runParallel(parallelFor, static_cast<std::ptrdiff_t>(open.size()),
      [&](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        CellValues values;
        for (std::ptrdiff_t r = begin; r < end; ++r)
        {
          deriver.takeTurn(*open[r], values);
        }
      });
    open.erase(std::remove_if(open.begin(), open.end(),
                 [](const RangeInTurns* turns) { return turns->isDone(); }),
      open.end());
  }
  for (RangeInTurns& turns : all)
  {
    turns.range.kept = std::move(turns.kept);
  }
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
