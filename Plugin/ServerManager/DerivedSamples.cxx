#include "DerivedSamples.h"

#include "Elements/FieldExpression.h"

#include "vtkCell.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkHighOrderParticleIsosurface.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <cmath>
#include <stdexcept>

namespace hop
{

namespace
{

/// The middle eigenvalue of the symmetric part of g g.
double lambda2(const std::vector<double>& g)
{
  double symmetric[3][3] = {};
  double vectors[3][3];
  double* rows[3] = { symmetric[0], symmetric[1], symmetric[2] };
  double* ofVectors[3] = { vectors[0], vectors[1], vectors[2] };
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int k = 0; k < 3; ++k)
      {
        symmetric[i][j] += 0.5 * (g[3 * i + k] * g[3 * k + j] + g[3 * j + k] * g[3 * k + i]);
      }
    }
  }
  double values[3]; // from the largest to the smallest
  vtkMath::Jacobi(rows, values, ofVectors);
  return values[1];
}

/// \param g rows of three derivatives, one a component
double valueOf(int quantity, const std::vector<double>& g)
{
  double sum = 0.0;
  switch (quantity)
  {
    case vtkHighOrderParticleIsosurface::DIVERGENCE:
      return g[0] + g[4] + g[8];
    case vtkHighOrderParticleIsosurface::VORTICITY_MAGNITUDE:
      return std::hypot(g[7] - g[5], g[2] - g[6], g[3] - g[1]);
    case vtkHighOrderParticleIsosurface::Q_CRITERION:
      return -0.5 * (g[0] * g[0] + g[4] * g[4] + g[8] * g[8]) - g[1] * g[3] - g[2] * g[6] -
        g[5] * g[7];
    case vtkHighOrderParticleIsosurface::LAMBDA_2:
      return lambda2(g);
    default:
      for (const double derivative : g)
      {
        sum = std::hypot(sum, derivative);
      }
      return sum;
  }
}

/// The values of components first to first + count - 1 at the nodes of a cell, node by node.
std::vector<double> nodalValues(vtkCell* cell, vtkDataArray* array, int first, int count)
{
  std::vector<double> nodal;
  for (vtkIdType n = 0; n < cell->GetNumberOfPoints(); ++n)
  {
    for (int i = first; i < first + count; ++i)
    {
      nodal.push_back(array->GetComponent(cell->GetPointId(static_cast<int>(n)), i));
    }
  }
  return nodal;
}

std::vector<NamedArray> pointArraysOf(vtkDataSet* data)
{
  std::vector<NamedArray> arrays;
  for (int a = 0; a < data->GetPointData()->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = data->GetPointData()->GetArray(a);
    if (array && array->GetName() && array->GetNumberOfTuples() >= data->GetNumberOfPoints())
    {
      arrays.push_back({ array->GetName(), array->GetNumberOfComponents() });
    }
  }
  return arrays;
}

/// What a formula is told of the middle of a cell.
FieldPoint middleOf(vtkCell* cell, vtkDataSet* data, const std::vector<NamedArray>& arrays)
{
  double middle[3];
  int sub = cell->GetParametricCenter(middle);
  std::vector<double> weights(cell->GetNumberOfPoints() + 1); // rational cells write beyond
  FieldPoint at;
  cell->EvaluateLocation(sub, middle, &at.x.x, weights.data());
  for (const NamedArray& named : arrays)
  {
    const int count = named.components;
    const std::vector<double> nodal =
      nodalValues(cell, data->GetPointData()->GetArray(named.name.c_str()), 0, count);
    std::vector<double> gradient(3 * static_cast<std::size_t>(count));
    cell->Derivatives(sub, middle, nodal.data(), count, gradient.data());
    for (int i = 0; i < count; ++i)
    {
      double value = 0.0;
      for (vtkIdType n = 0; n < cell->GetNumberOfPoints(); ++n)
      {
        value += weights[n] * nodal[n * count + i];
      }
      at.values.push_back(value);
      at.gradients.emplace_back(gradient[3 * i], gradient[3 * i + 1], gradient[3 * i + 2]);
    }
  }
  return at;
}

/// Calls visit(cell) for every step-th cell that has a volume.
template <class Visit>
void visitCells(vtkDataSet* data, long long step, const Visit& visit)
{
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); c += step)
  {
    data->GetCell(c, cell);
    if (cell->GetCellDimension() == 3)
    {
      visit(cell.Get());
    }
  }
}

} // namespace

std::vector<double> sampleDerived(
  vtkDataSet* data, vtkDataArray* array, int component, int quantity, long long step)
{
  const int all = array->GetNumberOfComponents();
  const bool isGradient = quantity == vtkHighOrderParticleIsosurface::GRADIENT_MAGNITUDE;
  std::vector<double> values;
  if (!isGradient && all != 3)
  {
    return values;
  }
  const bool isOne = isGradient && (all == 1 || component < all);
  const int first = isOne && all > 1 ? component : 0;
  const int count = isOne ? 1 : all;
  std::vector<double> gradient(3 * static_cast<std::size_t>(count));
  visitCells(data, step,
    [&](vtkCell* cell)
    {
      const std::vector<double> nodal = nodalValues(cell, array, first, count);
      double middle[3];
      const int sub = cell->GetParametricCenter(middle);
      cell->Derivatives(sub, middle, nodal.data(), count, gradient.data());
      const double value = valueOf(quantity, gradient);
      if (std::isfinite(value))
      {
        values.push_back(value);
      }
    });
  return values;
}

std::vector<double> sampleExpression(vtkDataSet* data, const std::string& text, long long step)
{
  std::vector<double> values;
  try
  {
    const FieldExpression expression(text, pointArraysOf(data));
    visitCells(data, step,
      [&](vtkCell* cell)
      {
        const double value = expression(middleOf(cell, data, expression.arrays()));
        if (std::isfinite(value))
        {
          values.push_back(value);
        }
      });
  }
  catch (const std::invalid_argument&)
  {
    values.clear(); // while it is being typed
  }
  return values;
}

} // namespace hop
