#include "ParticlePacker.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <string>

namespace
{

/// A particle on its way to its row of the output.
struct Row
{
  const hop::Particle* particle = nullptr;
  double isovalue = 0.0;
};

const std::set<std::string> ownArrays{ "Normals", "Radius", "Mean_Curvature", "Gauss_Curvature",
  "Shape_Operator", "Residual", "Clip_Normal", "Clip_Distance", "Jump", "Isovalue",
  "vtkOriginalCellIds", "ParametricCoordinates" };

/// Rational basis functions R_i = w_i B_i / sum_j w_j B_j from polynomial ones.
void applyRationalWeights(const std::vector<double>& weights, std::vector<double>& basis)
{
  if (weights.empty())
  {
    return;
  }
  std::transform(
    basis.begin(), basis.end(), weights.begin(), basis.begin(), std::multiplies<double>());
  const double sum = std::accumulate(basis.begin(), basis.end(), 0.0);
  std::transform(
    basis.begin(), basis.end(), basis.begin(), [sum](double value) { return value / sum; });
}

class Packer
{
public:
  Packer(vtkUnstructuredGrid* grid, const ScalarChoice& scalars, const GridElements& elements,
    const hop::ParallelFor& parallelFor, vtkPolyData* output)
    : Grid(grid)
    , Scalars(scalars)
    , Elements(elements)
    , Parallel(parallelFor)
    , Output(output)
  {
  }

  void pack(const std::vector<IsovalueParticles>& isovalues);

private:
  void collectRows(const std::vector<IsovalueParticles>& isovalues);
  void addPoints();
  void addVertices();
  void addOwnArrays();
  void addPointArrays();
  void addCellArrays();
  void addReport(const std::vector<IsovalueParticles>& isovalues);
  std::vector<double> rationalWeights(int element, vtkIdList* ids) const;
  void evaluate(vtkDataArray* source, vtkDoubleArray* target);
  void evaluateRun(vtkDataArray* source, vtkDoubleArray* target, std::size_t begin, std::size_t end,
    vtkIdList* ids) const;
  template <class Write>
  vtkSmartPointer<vtkDoubleArray> addArray(
    const std::string& name, int components, const Write& write);
  vtkIdType cellOf(const Row& row) const
  {
    return this->Elements.mesh.elements[row.particle->location.element].cell;
  }

  vtkUnstructuredGrid* Grid;
  ScalarChoice Scalars;
  const GridElements& Elements;
  const hop::ParallelFor& Parallel;
  vtkPolyData* Output;
  std::vector<Row> Rows;
};

void Packer::pack(const std::vector<IsovalueParticles>& isovalues)
{
  this->collectRows(isovalues);
  this->addPoints();
  this->addVertices();
  this->addPointArrays();
  this->addOwnArrays();
  this->addCellArrays();
  this->addReport(isovalues);
}

/// Rows by isovalue, then by element, so that neighbours in memory share an element.
void Packer::collectRows(const std::vector<IsovalueParticles>& isovalues)
{
  vtkUnsignedCharArray* ghosts = this->Grid->GetCellGhostArray();
  for (const IsovalueParticles& some : isovalues)
  {
    const auto begin = static_cast<std::ptrdiff_t>(this->Rows.size());
    for (const hop::Particle& particle : some.distribution.particles)
    {
      const Row row{ &particle, some.isovalue };
      if (!ghosts || ghosts->GetValue(this->cellOf(row)) == 0)
      {
        this->Rows.push_back(row);
      }
    }
    std::stable_sort(this->Rows.begin() + begin, this->Rows.end(),
      [](const Row& a, const Row& b)
      { return a.particle->location.element < b.particle->location.element; });
  }
}

void Packer::addPoints()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Rows.size()));
  for (std::size_t i = 0; i < this->Rows.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), &this->Rows[i].particle->position.xyz.x);
  }
  this->Output->SetPoints(points);
}

void Packer::addVertices()
{
  const auto count = static_cast<vtkIdType>(this->Rows.size());
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    offsets->SetValue(i, i);
    connectivity->SetValue(i, i);
  }
  offsets->SetValue(count, count);
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(offsets, connectivity);
  this->Output->SetVerts(vertices);
}

/// A point array whose row i is filled by write(row, double*).
template <class Write>
vtkSmartPointer<vtkDoubleArray> Packer::addArray(
  const std::string& name, int components, const Write& write)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(this->Rows.size()));
  double* values = array->GetPointer(0);
  hop::runParallel(this->Parallel, static_cast<std::ptrdiff_t>(this->Rows.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        write(this->Rows[i], values + i * components);
      }
    });
  this->Output->GetPointData()->AddArray(array);
  return array;
}

void Packer::addOwnArrays()
{
  const auto writeVector = [](const glm::dvec3& v, double* out)
  {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
  };
  const auto normals = this->addArray(
    "Normals", 3, [&](const Row& row, double* out) { writeVector(row.particle->normal.xyz, out); });
  this->Output->GetPointData()->SetNormals(normals);
  this->addArray("Radius", 1, [](const Row& row, double* out) { *out = row.particle->spacing; });
  this->addArray(
    "Mean_Curvature", 1, [](const Row& row, double* out) { *out = row.particle->curvature.mean; });
  this->addArray("Gauss_Curvature", 1,
    [](const Row& row, double* out) { *out = row.particle->curvature.gauss; });
  this->addArray("Shape_Operator", 6,
    [](const Row& row, double* out)
    {
      const glm::dmat3& shape =
        row.particle->curvature.shape; // in VTK's order of symmetric tensors
      const double components[] = { shape[0][0], shape[1][1], shape[2][2], shape[0][1], shape[1][2],
        shape[0][2] };
      std::copy(std::begin(components), std::end(components), out);
    });
  this->addArray("Residual", 1, [](const Row& row, double* out) { *out = row.particle->residual; });
  this->addArray("Clip_Normal", 6,
    [&](const Row& row, double* out)
    {
      writeVector(row.particle->clips[0].normal.xyz, out);
      writeVector(row.particle->clips[1].normal.xyz, out + 3);
    });
  this->addArray("Clip_Distance", 2,
    [](const Row& row, double* out)
    {
      out[0] = row.particle->clips[0].distance;
      out[1] = row.particle->clips[1].distance;
    });
  this->addArray("Jump", 1, [](const Row& row, double* out) { *out = row.particle->jump; });
  this->addArray("Isovalue", 1, [](const Row& row, double* out) { *out = row.isovalue; });
  // Places on a face may have left the domain by a rounding error.
  this->addArray("ParametricCoordinates", 3,
    [&](const Row& row, double* out)
    {
      const hop::ReferencePoint u{ glm::clamp(row.particle->location.u.xyz, 0.0, 1.0) };
      writeVector(parametricCoordinates(this->Grid->GetCellType(this->cellOf(row)), u).xyz, out);
    });

  vtkNew<vtkIdTypeArray> cells;
  cells->SetName("vtkOriginalCellIds");
  cells->SetNumberOfValues(static_cast<vtkIdType>(this->Rows.size()));
  for (std::size_t i = 0; i < this->Rows.size(); ++i)
  {
    cells->SetValue(static_cast<vtkIdType>(i), this->cellOf(this->Rows[i]));
  }
  this->Output->GetPointData()->AddArray(cells);
}

/// Every numeric point array that means something between the nodes.
void Packer::addPointArrays()
{
  vtkPointData* source = this->Grid->GetPointData();
  for (int a = 0; a < source->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = source->GetArray(a);
    const std::string name = array && array->GetName() ? array->GetName() : "";
    const bool isLabel = array == source->GetGlobalIds() || array == source->GetPedigreeIds() ||
      array == source->GetRationalWeights() || name == vtkDataSetAttributes::GhostArrayName() ||
      name == "vtkOriginalPointIds";
    if (name.empty() || isLabel || ownArrays.count(name) > 0)
    {
      continue;
    }
    vtkNew<vtkDoubleArray> values;
    values->SetName(name.c_str());
    values->SetNumberOfComponents(array->GetNumberOfComponents());
    values->SetNumberOfTuples(static_cast<vtkIdType>(this->Rows.size()));
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      values->SetComponentName(c, array->GetComponentName(c));
    }
    this->Output->GetPointData()->AddArray(values);
    if (array == this->Scalars.array && array->GetNumberOfComponents() == 1)
    {
      // As Contour: this array is the isovalue, not the isovalue with noise of the tolerance's size.
      for (std::size_t i = 0; i < this->Rows.size(); ++i)
      {
        values->SetValue(static_cast<vtkIdType>(i), this->Rows[i].isovalue);
      }
      this->Output->GetPointData()->SetScalars(values);
    }
    else
    {
      this->evaluate(array, values);
    }
  }
}

void Packer::evaluate(vtkDataArray* source, vtkDoubleArray* target)
{
  hop::runParallel(this->Parallel, static_cast<std::ptrdiff_t>(this->Rows.size()),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      vtkNew<vtkIdList> ids;
      for (auto begin = static_cast<std::size_t>(first); begin < static_cast<std::size_t>(last);)
      {
        std::size_t end = begin;
        while (end < static_cast<std::size_t>(last) &&
          this->Rows[end].particle->location.element ==
            this->Rows[begin].particle->location.element)
        {
          ++end;
        }
        this->evaluateRun(source, target, begin, end, ids);
        begin = end;
      }
    });
}

/// Evaluates an array for rows that share an element: converted once, summed for each.
void Packer::evaluateRun(vtkDataArray* source, vtkDoubleArray* target, std::size_t begin,
  std::size_t end, vtkIdList* ids) const
{
  const int element = this->Rows[begin].particle->location.element;
  const CellBasis& cell = *this->Elements.bases[element];
  const hop::NodalBasis& basis = cell.basis;
  const int components = source->GetNumberOfComponents();
  this->Grid->GetCells()->GetCellAtId(this->Elements.mesh.elements[element].cell, ids);
  std::vector<double> nodal(static_cast<std::size_t>(basis.nodeCount()) * components);
  for (int node = 0; node < basis.nodeCount(); ++node)
  {
    for (int c = 0; c < components; ++c)
    {
      nodal[node * components + c] = source->GetComponent(ids->GetId(node), c);
    }
  }
  const int count = basis.coefficientCount();
  std::vector<double> coefficients(static_cast<std::size_t>(count) * components);
  basis.toBernstein(nodal.data(), components, coefficients.data());

  const std::vector<double> rational = this->rationalWeights(element, ids);
  std::vector<double> weights(count);
  for (std::size_t row = begin; row < end; ++row)
  {
    hop::evaluateBasis(
      basis.domain(), basis.degrees(), this->Rows[row].particle->location.u, weights.data());
    applyRationalWeights(rational, weights);
    double* out = target->GetPointer(static_cast<vtkIdType>(row) * components);
    std::fill_n(out, components, 0.0);
    for (int i = 0; i < count; ++i)
    {
      for (int c = 0; c < components; ++c)
      {
        out[c] += weights[i] * coefficients[i * components + c];
      }
    }
  }
}

/// An element's rational weights in the order of its coefficients, or nothing.
std::vector<double> Packer::rationalWeights(int element, vtkIdList* ids) const
{
  if (!this->Elements.mesh.elements[element].rational)
  {
    return {};
  }
  const hop::NodalBasis& basis = this->Elements.bases[element]->basis;
  std::vector<double> nodal;
  for (int node = 0; node < basis.nodeCount(); ++node)
  {
    nodal.push_back(this->Elements.rationalWeights->GetComponent(ids->GetId(node), 0));
  }
  std::vector<double> weights(nodal.size());
  basis.toBernstein(nodal.data(), 1, weights.data());
  return weights;
}

void Packer::addCellArrays()
{
  vtkCellData* source = this->Grid->GetCellData();
  vtkCellData* target = this->Output->GetCellData();
  target->CopyGlobalIdsOff();          // several particles share a cell: its id is no id of theirs
  target->CopyHigherOrderDegreesOff(); // particles have none
  target->CopyFieldOff(vtkDataSetAttributes::GhostArrayName());
  target->CopyAllocate(source, static_cast<vtkIdType>(this->Rows.size()));
  for (std::size_t i = 0; i < this->Rows.size(); ++i)
  {
    target->CopyData(source, this->cellOf(this->Rows[i]), static_cast<vtkIdType>(i));
  }
}

void Packer::addReport(const std::vector<IsovalueParticles>& isovalues)
{
  this->Output->GetFieldData()->PassData(this->Grid->GetFieldData());
  hop::DistributionReport sum;
  std::set<std::int64_t> unresolved;
  for (const IsovalueParticles& some : isovalues)
  {
    const hop::DistributionReport& report = some.distribution.report;
    sum.evaluations += report.evaluations;
    sum.iterations += report.iterations;
    sum.boxesUnresolved += report.boxesUnresolved;
    sum.singularPoints += report.singularPoints;
    unresolved.insert(report.unresolvedCells.begin(), report.unresolvedCells.end());
    sum.particlesRejected += report.particlesRejected;
    sum.particlesUndersampled += report.particlesUndersampled;
  }
  const auto addCount = [this](const char* name, vtkIdType value)
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    this->Output->GetFieldData()->AddArray(array);
  };
  addCount("Evaluations", sum.evaluations);
  addCount("Iterations", sum.iterations);
  addCount("ElementsDropped", this->Elements.census.dropped);
  addCount("CellsSkipped", this->Elements.census.skipped());
  addCount("BoxesUnresolved", sum.boxesUnresolved);
  addCount("SingularPoints", sum.singularPoints);
  addCount("ParticlesRejected", sum.particlesRejected);
  addCount("ParticlesUndersampled", sum.particlesUndersampled);

  vtkNew<vtkIdTypeArray> cells;
  cells->SetName("UnresolvedCellIds");
  for (const std::int64_t cell : unresolved)
  {
    cells->InsertNextValue(cell);
  }
  this->Output->GetFieldData()->AddArray(cells);
}

} // namespace

void packParticles(vtkUnstructuredGrid* grid, const ScalarChoice& scalars,
  const GridElements& elements, const std::vector<IsovalueParticles>& isovalues,
  const hop::ParallelFor& parallelFor, vtkPolyData* output)
{
  Packer(grid, scalars, elements, parallelFor, output).pack(isovalues);
}
