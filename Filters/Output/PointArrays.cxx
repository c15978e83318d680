#include "Output/PointArrays.h"

#include "Conversion/CellValues.h"
#include "Conversion/GatherValues.h"
#include "Elements/BatchEvaluator.h"
#include "Input/VtkCompatibility.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace hop
{

namespace
{

/// Number of components that the evaluators of the core take at once: elsewhere these are x, y, z and the field.
constexpr int groupSize = 4;

/// The place of a component in an output array.
struct Target
{
  /// Of the first row.
  double* values = nullptr;
  /// Doubles from one row to the next.
  int stride = 0;
};

/// The array of a grid that goes on a block's array in this grid; nullptr if there is none.
vtkDataArray* continuationOf(vtkDataArray* array, vtkUnstructuredGrid* grid)
{
  vtkDataArray* other = grid->GetPointData()->GetArray(array->GetName());
  return other && other->GetNumberOfComponents() == array->GetNumberOfComponents() ? other
                                                                                   : nullptr;
}

/// Evaluates all arrays at some rows. Each thread has an evaluator of its own.
class ArrayEvaluator
{
public:
  ArrayEvaluator(const InputBlocks& blocks, std::size_t block, const GridElements& elements,
    const std::vector<EvaluatedArray>& arrays, const std::vector<ParticleRow>& rows)
    : Blocks(blocks)
    , Block(block)
    , Elements(elements)
    , Arrays(arrays)
    , Rows(rows)
  {
    for (const EvaluatedArray& array : arrays)
    {
      const int components = array.source->GetNumberOfComponents();
      for (int c = 0; c < components; ++c)
      {
        this->Targets.push_back({ array.target + c, components });
      }
    }
  }

  /// Evaluates rows begin to end - 1.
  void evaluate(std::ptrdiff_t begin, std::ptrdiff_t end)
  {
    while (begin < end)
    {
      const int element = this->elementOf(begin);
      this->convert(element);
      for (; begin < end && this->elementOf(begin) == element; begin = this->BatchEnd)
      {
        this->collectPoints(begin, end);
        for (int first = 0; first < this->width(); first += groupSize)
        {
          this->evaluateGroup(element, first, begin);
        }
      }
    }
  }

private:
  int width() const { return static_cast<int>(this->Targets.size()); }
  int elementOf(std::ptrdiff_t row) const { return this->Rows[row].evaluated().element; }

  /// Converts all arrays to Bernstein form on an element: one row of components a coefficient.
  void convert(int element)
  {
    const Element& e = this->Elements.mesh.elements[element];
    const NodalBasis& basis = this->Elements.bases[element]->basis;
    const int nodes = basis.nodeCount();
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    const auto [block, cell] = this->Blocks.locate(e.cell);
    vtkUnstructuredGrid* grid = this->Blocks[block].grid;
    cellPoints(grid->GetCells(), cell, count, ids, this->CopiedIds);
    this->Nodal.resize(static_cast<std::size_t>(nodes) * this->width());
    double* column = this->Nodal.data();
    for (const EvaluatedArray& array : this->Arrays)
    {
      vtkDataArray* source =
        block == this->Block ? array.source : continuationOf(array.source, grid);
      for (int c = 0; c < array.source->GetNumberOfComponents(); ++c, ++column)
      {
        if (source)
        {
          gatherComponent(source, ids, nodes, c, column, this->width());
        }
        else
        {
          for (int n = 0; n < nodes; ++n)
          {
            column[static_cast<std::ptrdiff_t>(n) * this->width()] = 0.0;
          }
        }
      }
    }
    this->Coefficients.resize(static_cast<std::size_t>(basis.coefficientCount()) * this->width());
    basis.toBernstein(this->Nodal.data(), this->width(), this->Coefficients.data());
    this->Weights.clear();
    // Of the cell: its element is rational for a derived field, too.
    if (vtkDataArray* weights =
          rationalWeights(this->Blocks[block], *this->Elements.bases[element]))
    {
      this->Nodal.resize(nodes);
      gatherComponent(weights, ids, nodes, 0, this->Nodal.data());
      this->Weights.resize(basis.coefficientCount());
      basis.toBernstein(this->Nodal.data(), 1, this->Weights.data());
    }
  }

  /// Collects the places of the next rows that share an element, as many as are evaluated at once.
  void collectPoints(std::ptrdiff_t begin, std::ptrdiff_t end)
  {
    // Fewer rows cost more calls of the kernels, more need more memory for their values. Chosen by experiment.
    constexpr std::ptrdiff_t batchSize = 64;
    const int element = this->elementOf(begin);
    this->Points.clear();
    this->BatchEnd = begin;
    for (; this->BatchEnd < std::min(end, begin + batchSize) &&
         this->elementOf(this->BatchEnd) == element;
         ++this->BatchEnd)
    {
      this->Points.push_back(this->Elements.inCell(this->Rows[this->BatchEnd].evaluated()));
    }
  }

  /// Evaluates up to groupSize components, from `first` on, at the collected points, for the rows from `begin` on.
  void evaluateGroup(int element, int first, std::ptrdiff_t begin)
  {
    const NodalBasis& basis = this->Elements.bases[element]->basis;
    const int components = std::min(groupSize, this->width() - first);
    this->Group.assign(basis.coefficientCount(), Coefficient(0.0));
    for (std::size_t i = 0; i < this->Group.size(); ++i)
    {
      const double weight = this->Weights.empty() ? 1.0 : this->Weights[i];
      for (int c = 0; c < components; ++c)
      {
        this->Group[i][c] = weight * this->Coefficients[i * this->width() + first + c];
      }
    }
    evaluateGradients({ basis.domain(), basis.degrees(), this->Group.data(),
                        this->Weights.empty() ? nullptr : this->Weights.data() },
      this->Points.data(), static_cast<int>(this->Points.size()), this->Jets);
    for (int c = 0; c < components; ++c)
    {
      const Target& target = this->Targets[first + c];
      const double* values = this->Jets.row(quantity::value, c);
      for (int n = 0; n < this->Jets.size(); ++n)
      {
        target.values[(begin + n) * target.stride] = values[n];
      }
    }
  }

  const InputBlocks& Blocks;
  std::size_t Block;
  const GridElements& Elements;
  const std::vector<EvaluatedArray>& Arrays;
  const std::vector<ParticleRow>& Rows;
  /// One target a component of all arrays.
  std::vector<Target> Targets;
  vtkNew<vtkIdList> CopiedIds;
  std::vector<double> Nodal;
  std::vector<double> Coefficients;
  std::vector<double> Weights;
  std::vector<ReferencePoint> Points;
  /// One past the last row that collectPoints() took.
  std::ptrdiff_t BatchEnd = 0;
  std::vector<Coefficient> Group;
  JetBatch Jets;
};

/// Rows in blocks that lack an array get the value of their stand-ins.
void copyFromStandIns(const InputBlocks& blocks, const GridElements& elements,
  const std::vector<EvaluatedArray>& arrays, const std::vector<ParticleRow>& rows)
{
  for (std::size_t r = 0; r < rows.size(); ++r)
  {
    if (!rows[r].standIn || rows[r].home)
    {
      continue;
    }
    const int element = rows[r].location().element;
    vtkUnstructuredGrid* grid =
      blocks[blocks.locate(elements.mesh.elements[element].cell).block].grid;
    for (const EvaluatedArray& array : arrays)
    {
      const std::ptrdiff_t width = array.source->GetNumberOfComponents();
      if (!continuationOf(array.source, grid))
      {
        std::copy_n(array.target + rows[r].rowOfStandIn * width, width,
          array.target + static_cast<std::ptrdiff_t>(r) * width);
      }
    }
  }
}

} // namespace

void evaluatePointArrays(const InputBlocks& blocks, std::size_t block, const GridElements& elements,
  const std::vector<EvaluatedArray>& arrays, const std::vector<ParticleRow>& rows,
  const ParallelFor& parallelFor)
{
  if (arrays.empty())
  {
    return;
  }
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(rows.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    { ArrayEvaluator(blocks, block, elements, arrays, rows).evaluate(begin, end); });
  copyFromStandIns(blocks, elements, arrays, rows);
}

} // namespace hop
