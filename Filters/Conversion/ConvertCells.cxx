#include "Conversion/ConvertCells.h"

#include "Conversion/GatherValues.h"
#include "Elements/BernsteinProduct.h"

#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace hop
{

namespace
{

/// Whether the numerics can compute with a nodal value.
/// \param value in the unit of the run
bool isUsable(double value)
{
  // The gradient of the square of a magnitude can still be squared: 1e75 to the fourth power is 1e300, below the
  // largest double, 1.8e308. Larger values overflow.
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

/// Sets coefficients that cannot be told from an isovalue to the isovalue: a surface in a face of the element would
/// else cross the face to and fro by rounding errors.
/// \param amplification by which the conversion enlarges the rounding errors of the nodal values; these errors belong
/// to the values before the origin was subtracted
void snapToIsovalues(std::vector<Coefficient>& coefficients, const FieldRange& range, double unit,
  double amplification)
{
  const auto [lowest, highest] = std::minmax_element(coefficients.begin(), coefficients.end(),
    [](const Coefficient& a, const Coefficient& b) { return a.w < b.w; });
  // Largest change of a coefficient, as a fraction of the range of the element's coefficients: larger values would move
  // the surface where the conversion enlarges rounding errors much. Chosen by experiment.
  constexpr double mostOfRange = 1e-8;
  // Four rounding errors of the largest value.
  const double origin = range.origin / unit;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * amplification *
    std::max(std::abs(lowest->w + origin), std::abs(highest->w + origin));
  const double slack = std::min(rounding, mostOfRange * (highest->w - lowest->w));
  for (Coefficient& c : coefficients)
  {
    for (const double isovalue : range.isovalues)
    {
      const double value = (isovalue - range.origin) / unit;
      c.w = std::abs(c.w - value) <= slack ? value : c.w;
    }
  }
}

/// Rows of x, y, z and the field's components, one row a node, times the node's weight if there is one.
/// \param unitOfLength divides the coordinates
std::vector<double> nodalRows(
  vtkUnstructuredGrid* grid, int nodes, const CellValues& values, double unitOfLength)
{
  const int width = 3 + values.components;
  std::vector<double> nodal(static_cast<std::size_t>(nodes) * width);
  for (int c = 0; c < 3; ++c)
  {
    gatherComponent(grid->GetPoints()->GetData(), values.ids, nodes, c, nodal.data() + c, width);
  }
  for (int node = 0; node < nodes; ++node)
  {
    double* row = &nodal[static_cast<std::size_t>(node) * width];
    for (int c = 0; c < 3; ++c)
    {
      row[c] /= unitOfLength;
    }
    std::copy_n(&values.field[static_cast<std::size_t>(node) * values.components],
      values.components, row + 3);
    for (int c = 0; c < width && !values.weights.empty(); ++c)
    {
      row[c] *= values.weights[node];
    }
  }
  return nodal;
}

/// The Bernstein coefficients of nodal rows, in rows of the same width.
std::vector<double> controlRows(const CellBasis& cell, std::vector<double> nodal, int width)
{
  // Differences from the first node are converted where the conversion enlarges rounding errors: they are smaller.
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

/// Bernstein coefficients of the weights; ones where the cell is not rational.
std::vector<double> controlWeights(const CellBasis& cell, const CellValues& values)
{
  std::vector<double> weights(cell.basis.coefficientCount(), 1.0);
  if (!values.weights.empty())
  {
    cell.basis.toBernstein(values.weights.data(), 1, weights.data());
  }
  return weights;
}

/// Control rows with one number for the field. For a vector this is the sum of its components, which only tells whether
/// they are finite.
std::vector<Coefficient> coefficientsOf(const std::vector<double>& control, int width)
{
  std::vector<Coefficient> coefficients(control.size() / width);
  const double* row = control.data();
  for (Coefficient& c : coefficients)
  {
    c = { row[0], row[1], row[2], std::accumulate(row + 3, row + width, 0.0) };
    row += width;
  }
  return coefficients;
}

/// Whether all control points lie in one place, as far as doubles of the size of the grid's bounds tell places apart.
bool isPoint(const std::vector<Coefficient>& control)
{
  // Largest extent of a cell that counts as a point, in units of the sides of the bounds of all input: a few times the
  // spacing of doubles there. Squares of spacings in smaller cells leave the range of single precision.
  constexpr double extentOfPoint = 1e-15;
  glm::dvec3 farthest(0.0);
  for (const Coefficient& c : control)
  {
    farthest = glm::max(farthest, glm::abs(glm::dvec3(c - control.front())));
  }
  return std::max({ farthest.x, farthest.y, farthest.z }) < extentOfPoint;
}

JacobianSign jacobianSign(const CellBasis& cell, const BernsteinForm& form)
{
  // Largest relative rounding error of coefficients that is allowed for. At the highest degrees the bound on the error
  // is far above the errors of coordinates that vary smoothly; with it, sound elements would be taken for doubtful
  // ones. Chosen by experiment.
  constexpr double largestRounding = 1e-6;
  return cell.jacobian.sign(form, std::min(cell.basis.conversionError(), largestRounding));
}

/// Writes the coefficients of one element.
JacobianSign convert(const InputBlocks& blocks, const CellBasis& cell, const FieldRange& range,
  const RunUnits& units, const Element& element, ElementMesh& mesh, CellValues& values)
{
  const BlockCell where = blocks.locate(element.cell);
  readCell(blocks, where, cell, values);
  for (double& value : values.field)
  {
    value = (value - range.origin) / units.value;
  }
  if (!std::all_of(values.field.begin(), values.field.end(), isUsable))
  {
    return JacobianSign::NotFinite;
  }
  ControlNet net = controlNet(blocks, where, cell, values, units.length);
  const JacobianSign sign = signOf(cell, net);
  if (sign == JacobianSign::NotFinite || sign == JacobianSign::Zero)
  {
    return sign;
  }
  Coefficient* coefficients = &mesh.coefficients[element.firstCoefficient];
  if (blocks.isMagnitude())
  {
    net.weights = squareField(
      cell.basis.domain(), cell.basis.degrees(), net.width, net.control, net.weights, coefficients);
  }
  else
  {
    std::vector<Coefficient> plain = coefficientsOf(net.control, net.width);
    if (!element.rational)
    {
      snapToIsovalues(plain, range, units.value, cell.basis.conversionNorm());
    }
    std::copy(plain.begin(), plain.end(), coefficients);
  }
  if (element.rational)
  {
    std::copy(net.weights.begin(), net.weights.end(), &mesh.weights[element.firstCoefficient]);
  }
  return sign;
}

} // namespace

ControlNet controlNet(const InputBlocks& blocks, const BlockCell& where, const CellBasis& cell,
  const CellValues& values, double unitOfLength)
{
  ControlNet net;
  net.width = 3 + values.components;
  net.control = controlRows(cell,
    nodalRows(blocks[where.block].grid, cell.basis.nodeCount(), values, unitOfLength), net.width);
  net.weights = controlWeights(cell, values);
  net.isRational = !values.weights.empty();
  return net;
}

JacobianSign signOf(const CellBasis& cell, const ControlNet& net)
{
  const std::vector<Coefficient> plain = coefficientsOf(net.control, net.width);
  const JacobianSign sign = jacobianSign(cell,
    { cell.basis.domain(), cell.basis.degrees(), plain.data(),
      net.isRational ? net.weights.data() : nullptr });
  return sign != JacobianSign::NotFinite && isPoint(plain) ? JacobianSign::Zero : sign;
}

std::vector<JacobianSign> convertCells(const InputBlocks& blocks,
  const std::vector<const CellBasis*>& bases, const FieldRange& range, const RunUnits& units,
  ElementMesh& mesh, const ParallelFor& parallelFor)
{
  std::vector<JacobianSign> signs(mesh.elements.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(signs.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      CellValues values;
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        signs[e] = convert(blocks, *bases[e], range, units, mesh.elements[e], mesh, values);
      }
    });
  return signs;
}

JacobianSign signInOrder(const InputBlocks& blocks, const BlockCell& where, const CellBasis& cell,
  const std::vector<int>& order, CellValues& values)
{
  if (readCell(blocks, where, cell, values) != Verdict::Keep)
  {
    return JacobianSign::NotFinite;
  }
  std::vector<vtkIdType> ids;
  std::vector<double> weights;
  for (const int node : order)
  {
    ids.push_back(values.ids[node]);
    if (!values.weights.empty())
    {
      weights.push_back(values.weights[node]);
    }
  }
  values.ids = ids.data();
  values.weights = std::move(weights);
  values.components = 0; // the field does not matter
  constexpr int width = 3;
  // The sign does not depend on the unit; products of tiny or huge coordinates would not be finite, though.
  std::vector<double> nodal =
    nodalRows(blocks[where.block].grid, cell.basis.nodeCount(), values, 1.0);
  const auto [lowest, highest] = std::minmax_element(nodal.begin(), nodal.end());
  const double unit = unitOf(std::max(-*lowest, *highest));
  for (double& coordinate : nodal)
  {
    coordinate /= unit;
  }
  const std::vector<Coefficient> coefficients =
    coefficientsOf(controlRows(cell, std::move(nodal), width), width);
  const std::vector<double> control = controlWeights(cell, values);
  const JacobianSign sign = jacobianSign(cell,
    { cell.basis.domain(), cell.basis.degrees(), coefficients.data(),
      values.weights.empty() ? nullptr : control.data() });
  values.ids = nullptr; // they end here
  return sign;
}

} // namespace hop
