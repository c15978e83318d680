#include "Output/DerivativeArrays.h"

#include "Conversion/CellValues.h"
#include "Conversion/ConvertCells.h"
#include "Elements/BatchEvaluator.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hop
{

namespace
{

constexpr const char* GradientArray = "Gradient";
constexpr const char* VorticityArray = "Vorticity";
constexpr const char* QCriterionArray = "Q_Criterion";

double finite(double number)
{
  return std::isfinite(number) ? number : std::numeric_limits<double>::max();
}

/// An array of the output, by its first number.
double* newArray(vtkPointData* target, const char* name, int components, std::size_t rows)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(rows));
  target->AddArray(array);
  return array->GetPointer(0);
}

/// Evaluates the gradient of one row after the other. Each thread has one of its own.
class GradientEvaluator
{
public:
  /// \param blocks contoured by all components
  GradientEvaluator(
    const InputBlocks& blocks, const GridElements& elements, const std::vector<ParticleRow>& rows)
    : Blocks(blocks)
    , Elements(elements)
    , Rows(rows)
  {
  }

  /// Writes the gradients of rows begin to end - 1.
  void evaluate(std::ptrdiff_t begin, std::ptrdiff_t end, double* gradients)
  {
    int converted = -1;
    for (std::ptrdiff_t r = begin; r < end; ++r)
    {
      const int element = this->Rows[r].location().element;
      if (element >= 0 && element != converted)
      {
        this->convert(element);
        converted = element;
      }
      if (element >= 0)
      {
        this->evaluate(element, this->Elements.inCell(this->Rows[r].location()),
          gradients + r * 3 * this->Values.components);
      }
    }
  }

private:
  void convert(int element)
  {
    const CellBasis& cell = *this->Elements.bases[element];
    const BlockCell where = this->Blocks.locate(this->Elements.mesh.elements[element].cell);
    readCell(this->Blocks, where, cell, this->Values);
    this->Net = controlNet(this->Blocks, where, cell, this->Values, this->Elements.units.length);
  }

  /// Component by component, each in the place of the field of an element.
  void evaluate(int element, const ReferencePoint& u, double* gradient)
  {
    const NodalBasis& basis = this->Elements.bases[element]->basis;
    const std::size_t width = this->Net.width;
    this->Coefficients.resize(basis.coefficientCount());
    for (std::size_t c = 3; c < width; ++c)
    {
      for (std::size_t i = 0; i < this->Coefficients.size(); ++i)
      {
        const double* row = &this->Net.control[i * width];
        this->Coefficients[i] = { row[0], row[1], row[2], row[c] };
      }
      evaluateGradients({ basis.domain(), basis.degrees(), this->Coefficients.data(),
                          this->Values.weights.empty() ? nullptr : this->Net.weights.data() },
        &u, 1, this->Jets);
      const Jet jet = this->Jets.jet(0);
      const glm::dmat3 jacobian{ glm::dvec3(jet.first[0]), glm::dvec3(jet.first[1]),
        glm::dvec3(jet.first[2]) };
      const glm::dvec3 inRun = gradientOf(jet) * glm::inverse(jacobian);
      for (int j = 0; j < 3; ++j)
      {
        *gradient++ = finite(inRun[j] / this->Elements.units.length);
      }
    }
  }

  const InputBlocks& Blocks;
  const GridElements& Elements;
  const std::vector<ParticleRow>& Rows;
  CellValues Values;
  ControlNet Net;
  std::vector<Coefficient> Coefficients;
  JetBatch Jets;
};

/// \param g nine numbers of Gradient
void writeOfVector(const double* g, double* vorticity, double& qCriterion)
{
  vorticity[0] = finite(g[7] - g[5]);
  vorticity[1] = finite(g[2] - g[6]);
  vorticity[2] = finite(g[3] - g[1]);
  const double diagonal = g[0] * g[0] + g[4] * g[4] + g[8] * g[8];
  qCriterion = finite(-0.5 * diagonal - (g[1] * g[3] + g[2] * g[6] + g[5] * g[7]));
}

} // namespace

bool isDerivativeArray(const std::string& name)
{
  return name == GradientArray || name == VorticityArray || name == QCriterionArray;
}

void addDerivatives(const InputBlocks& blocks, const GridElements& elements,
  const std::vector<ParticleRow>& rows, vtkPointData* target, const ParallelFor& parallelFor)
{
  const InputBlocks all = blocks.withComponent(InputBlocks::Magnitude);
  const int components = blocks[0].scalars->GetNumberOfComponents();
  const std::ptrdiff_t width = 3 * static_cast<std::ptrdiff_t>(components);
  double* gradients = newArray(target, GradientArray, static_cast<int>(width), rows.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(rows.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    { GradientEvaluator(all, elements, rows).evaluate(begin, end, gradients); });
  for (std::size_t r = 0; r < rows.size(); ++r)
  {
    if (rows[r].location().element < 0)
    {
      std::copy_n(gradients + rows[r].rowOfStandIn * width, width,
        gradients + static_cast<std::ptrdiff_t>(r) * width);
    }
  }
  if (components == 3)
  {
    double* vorticity = newArray(target, VorticityArray, 3, rows.size());
    double* qCriterion = newArray(target, QCriterionArray, 1, rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
    {
      writeOfVector(gradients + 9 * r, vorticity + 3 * r, qCriterion[r]);
    }
  }
}

} // namespace hop
