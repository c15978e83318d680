#include "VtkCellComparison.h"

#include "FilterSession.h"

#include <glm/glm.hpp>

#include <vtkBoundingBox.h>
#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hop::testing
{
namespace
{

/// Points of an output that are compared; more take longer.
constexpr vtkIdType Compared = 40;

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec3 vectorOf(const double* x)
{
  return { x[0], x[1], x[2] };
}

double largest(const glm::dvec3& v)
{
  const glm::dvec3 size = glm::abs(v);
  return std::max({ size.x, size.y, size.z });
}

/// Of the points that are finite.
double longestSide(vtkPoints& points)
{
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < points.GetNumberOfPoints(); ++i)
  {
    double x[3];
    points.GetPoint(i, x);
    if (std::isfinite(x[0] + x[1] + x[2]))
    {
      box.AddPoint(x);
    }
  }
  return box.IsValid() ? box.GetMaxLength() : 1.0;
}

/// What VTK's own cell says of a place.
struct Sample
{
  glm::dvec3 position{ 0.0 };
  /// Of the contoured component, or the magnitude of all.
  double value = 0.0;
  /// By how much the value may change over the tolerance; infinite in flat cells.
  double rise = infinity;
  /// Sizes of the numbers that are added up to the position and to the value.
  double roundingOfPosition = 0.0, roundingOfValue = 0.0;
};

/// The values of a cell's nodes: those of one component, or all, row by row.
struct NodalValues
{
  std::vector<double> numbers;
  int components = 1;
};

NodalValues nodalValues(vtkCell& cell, vtkDataArray& field, int component)
{
  const bool isOne = component < field.GetNumberOfComponents();
  NodalValues values{ {}, isOne ? 1 : field.GetNumberOfComponents() };
  for (vtkIdType n = 0; n < cell.GetNumberOfPoints(); ++n)
  {
    for (int c = 0; c < values.components; ++c)
    {
      values.numbers.push_back(field.GetComponent(cell.GetPointId(n), isOne ? component : c));
    }
  }
  return values;
}

double largest(const std::vector<double>& numbers)
{
  double most = 0.0;
  for (const double number : numbers)
  {
    most = std::max(most, std::abs(number));
  }
  return most;
}

/// Length of a vector of any size, without overflow.
double magnitude(const std::vector<double>& numbers)
{
  const double unit = largest(numbers);
  double sum = 0.0;
  for (const double number : numbers)
  {
    sum += unit > 0.0 ? (number / unit) * (number / unit) : 0.0;
  }
  return unit * std::sqrt(sum);
}

/// What VTK's shape functions give at a place of a cell.
struct Interpolated
{
  glm::dvec3 position{ 0.0 };
  /// From the first node: sums of differences have no rounding of coordinates that are far from the origin.
  glm::dvec3 offset{ 0.0 };
  std::vector<double> value, weights;
};

Interpolated interpolate(vtkCell& cell, const double* place, const NodalValues& values)
{
  const auto count = static_cast<std::size_t>(cell.GetNumberOfPoints());
  Interpolated result;
  result.weights.resize(count);
  result.value.assign(static_cast<std::size_t>(values.components), 0.0);
  int subId = 0;
  double position[3];
  cell.EvaluateLocation(subId, place, position, result.weights.data());
  result.position = vectorOf(position);
  const glm::dvec3 first = vectorOf(cell.GetPoints()->GetPoint(0));
  for (std::size_t n = 0; n < count; ++n)
  {
    const auto node = static_cast<vtkIdType>(n);
    result.offset += result.weights[n] * (vectorOf(cell.GetPoints()->GetPoint(node)) - first);
    for (std::size_t c = 0; c < result.value.size(); ++c)
    {
      result.value[c] += result.weights[n] * values.numbers[n * result.value.size() + c];
    }
  }
  return result;
}

/// By how much the field may change over a distance, by central differences: VTK's own derivatives are wrong in Bezier
/// cells and in quadratic pyramids. Infinite where the cell is flat.
double riseOver(double distance, vtkCell& cell, const double* place, const NodalValues& values)
{
  constexpr double step = 1e-6;
  const double length = longestSide(*cell.GetPoints());
  const double height = std::max(largest(values.numbers), std::numeric_limits<double>::min());
  // Rows: by parametric coordinate. Numbers of order one do not overflow.
  glm::dmat3 positions(0.0);
  std::array<std::vector<double>, 3> slopes;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 ahead = vectorOf(place), behind = ahead;
    ahead[axis] += step;
    behind[axis] -= step;
    const Interpolated there = interpolate(cell, &ahead.x, values);
    const Interpolated back = interpolate(cell, &behind.x, values);
    positions[axis] = (there.offset - back.offset) / (2.0 * step * length);
    for (std::size_t c = 0; c < there.value.size(); ++c)
    {
      slopes[axis].push_back((there.value[c] - back.value[c]) / (2.0 * step * height));
    }
  }
  const glm::dmat3 toWorld = glm::inverse(glm::transpose(positions));
  double sum = 0.0;
  for (std::size_t c = 0; c < slopes[0].size(); ++c)
  {
    const glm::dvec3 gradient = toWorld * glm::dvec3(slopes[0][c], slopes[1][c], slopes[2][c]);
    sum += glm::dot(gradient, gradient);
  }
  const double slope = std::sqrt(sum);
  return slope > 0.0 && slope < infinity ? slope * (distance / length) * height : infinity;
}

bool isBezier(int type)
{
  return type >= VTK_BEZIER_TETRAHEDRON && type <= VTK_BEZIER_WEDGE;
}

Sample sampleOf(vtkCell& cell, const double* place, const NodalValues& values, double distance)
{
  const Interpolated here = interpolate(cell, place, values);
  double rounding = 0.0, farthest = 0.0;
  for (std::size_t n = 0; n < here.weights.size(); ++n)
  {
    rounding += std::abs(here.weights[n]);
    farthest =
      std::max(farthest, largest(vectorOf(cell.GetPoints()->GetPoint(static_cast<vtkIdType>(n)))));
  }
  // Shape functions of high degrees add numbers much larger than their sum.
  return { here.position, here.value.size() == 1 ? here.value[0] : magnitude(here.value),
    riseOver(distance, cell, place, values), rounding * farthest,
    rounding * largest(values.numbers) };
}

bool isEvaluatedByVtk(const GridRecipe& recipe, int type)
{
  const bool isRational = isBezier(type) && recipe.count("weights") > 0;
  return type != VTK_VOXEL && !isRational;
}

/// By how much a point may be off its cell, as a share of the numbers that are added up. Derived fields take the lowest
/// degrees that hold the coordinates up to their rounding, in at most three times the degree steps.
double shareOfPosition(const GridRecipe& recipe, vtkUnstructuredGrid& grid)
{
  constexpr double ofRounding = 1e-8;
  const bool isSingle = grid.GetPoints()->GetDataType() == VTK_FLOAT;
  const double steps = 3.0 * std::max(2.0, recipe["order"]);
  return isSingle && recipe.count("Quantity") > 0
    ? ofRounding + steps * double(std::numeric_limits<float>::epsilon())
    : ofRounding;
}

bool isComparable(const GridRecipe& recipe)
{
  return recipe.count("NodeSpacing") == 0 && recipe.count("bad") < 7;
}

} // namespace

void compareWithVtk(const FilterSession& session, vtkUnstructuredGrid& grid, vtkPointSet& output,
  std::vector<std::string>& found)
{
  const GridRecipe& recipe = session.recipe();
  if (!isComparable(recipe))
  {
    return;
  }
  vtkPointData& data = *output.GetPointData();
  vtkDataArray& field = *grid.GetPointData()->GetArray("f");
  const double side = longestSide(*grid.GetPoints());
  const double share = shareOfPosition(recipe, grid);
  const vtkIdType count = output.GetNumberOfPoints();
  const vtkNew<vtkGenericCell> cell;
  for (vtkIdType n = 0; n < std::min(Compared, count); ++n)
  {
    const vtkIdType row = n * (count - 1) / std::max<vtkIdType>(1, std::min(Compared, count) - 1);
    const auto id = static_cast<vtkIdType>(data.GetArray("vtkOriginalCellIds")->GetTuple1(row));
    if (!isEvaluatedByVtk(recipe, grid.GetCellType(id)))
    {
      continue;
    }
    const glm::dvec3 point = vectorOf(output.GetPoint(row));
    const glm::dvec3 place = vectorOf(data.GetArray("ParametricCoordinates")->GetTuple3(row));
    const double isovalue = data.GetArray("Isovalue")->GetTuple1(row);
    grid.GetCell(id, cell);
    // A diagonal is 1.7 sides at most; coordinates far from the origin are rounded, and each step of an evaluation is.
    const double tolerance = 4.0 * recipe["Tolerance"] * side + 5e-15 * largest(point);
    const NodalValues values = nodalValues(*cell, field, recipe.count("Component"));
    const Sample sample = sampleOf(*cell, &place.x, values, tolerance);
    if (!(largest(sample.position - point) / sample.roundingOfPosition <= share))
    {
      found.emplace_back("a particle is not where its parametric coordinates are");
      return;
    }
    const bool isContoured = recipe.count("Quantity") == 0 && recipe.count("Derivatives") == 0;
    if (isContoured &&
      !(std::abs(sample.value - isovalue) <= sample.rise + 1e-8 * sample.roundingOfValue))
    {
      found.emplace_back("a particle is off the surface");
      return;
    }
  }
}

} // namespace hop::testing
