#include "Output/ParticlePacker.h"

#include "Output/PointArrays.h"
#include "Support/SortedBy.h"

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
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace
{

const std::set<std::string> ownPointArrays{ "Normals", "Radius", "Mean_Curvature",
  "Gauss_Curvature", "Shape_Operator", "Residual", "Clip_Normal", "Clip_Distance", "Clip_Angle",
  "Clip_Curvature", "Jump", "Isovalue", "vtkOriginalCellIds", "ParametricCoordinates" };
const std::set<std::string> ownFieldArrays{ "Evaluations", "Iterations", "ElementsDropped",
  "CellsSkipped", "BoxesUnresolved", "SingularPoints", "ParticlesRejected", "ParticlesUndersampled",
  "UnresolvedCellIds" };

/// Whether an array's values mean something between the nodes; ids, ghost marks and weights do not.
bool isField(vtkPointData* data, vtkDataArray* array)
{
  const std::string name = array && array->GetName() ? array->GetName() : "";
  const bool isLabel = array == data->GetGlobalIds() || array == data->GetPedigreeIds() ||
    array == data->GetRationalWeights() || name == vtkDataSetAttributes::GhostArrayName() ||
    name == "vtkOriginalPointIds" || name == "vtkOriginalCellIds";
  return !name.empty() && !isLabel;
}

bool isReplaced(const InputBlock& block, vtkDataArray* array)
{
  const std::string name = array->GetName();
  // The values of a contoured array are those of the output's array of that name.
  const bool isKnown =
    array == block.scalars && array->GetNumberOfComponents() == 1 && name == "Isovalue";
  return isOwnPointArray(name) && !isKnown;
}

void addReplaced(const InputBlock& block, std::set<std::string>& names)
{
  vtkPointData* points = block.grid->GetPointData();
  for (int a = 0; a < points->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = points->GetArray(a);
    if (isField(points, array) && isReplaced(block, array))
    {
      names.insert(std::string("point array '") + array->GetName() + "'");
    }
  }
  for (const std::string& name : ownFieldArrays)
  {
    if (block.grid->GetFieldData()->HasArray(name.c_str()))
    {
      names.insert("field array '" + name + "'");
    }
  }
}

class Packer
{
public:
  Packer(const InputBlocks& blocks, std::size_t block, const GridElements& elements,
    std::vector<ParticleRow> rows, hop::Interruptible& work)
    : Blocks(blocks)
    , Grid(blocks[block].grid)
    , Scalars(blocks[block].scalars)
    , FirstCell(blocks.firstCell(block))
    , Elements(elements)
    , Census(elements.census[block])
    , Work(work)
    , Output(blocks[block].particles)
    , Rows(std::move(rows))
  {
  }

  void pack(const std::vector<IsovalueParticles>& isovalues);

private:
  void addPoints();
  void addVertices();
  void addOwnArrays();
  void addPointArrays();
  void addCellIds();
  void addCellArrays();
  void copyCellData(vtkIdType begin, vtkIdType end);
  void addReport(const std::vector<IsovalueParticles>& isovalues);
  vtkSmartPointer<vtkDoubleArray> newArray(const std::string& name, int components) const;
  template <class Write>
  vtkSmartPointer<vtkDoubleArray> addArray(
    const std::string& name, int components, const Write& write);
  template <class Write>
  void fillWith(const Write& write);
  void fillRows();
  vtkIdType rowCount() const { return static_cast<vtkIdType>(this->Rows.size()); }
  vtkIdType cellOf(const ParticleRow& row) const
  {
    return this->Elements.mesh.elements[row.particle->location.element].cell - this->FirstCell;
  }

  const InputBlocks& Blocks;
  vtkUnstructuredGrid* Grid;
  vtkDataArray* Scalars;
  std::int64_t FirstCell;
  const GridElements& Elements;
  const CellCensus& Census;
  hop::Interruptible& Work;
  vtkPolyData* Output;
  std::vector<ParticleRow> Rows;
  /// Of each row; in the output.
  vtkIdType* CellIds = nullptr;
  /// What writes rows begin to end - 1 of some array.
  std::vector<std::function<void(std::ptrdiff_t begin, std::ptrdiff_t end)>> Writers;
  std::vector<EvaluatedArray> Evaluated;
};

void Packer::pack(const std::vector<IsovalueParticles>& isovalues)
{
  this->addPoints();
  this->addVertices();
  this->addPointArrays();
  this->addOwnArrays();
  this->addCellIds();
  this->fillRows();
  this->addCellArrays();
  this->addReport(isovalues);
}

/// Has write(row number, row) called for every row when rows are filled.
template <class Write>
void Packer::fillWith(const Write& write)
{
  this->Writers.push_back(
    [this, write](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (std::ptrdiff_t i = begin; i < end; ++i)
      {
        write(i, this->Rows[i]);
      }
    });
}

/// All arrays at once, a few rows at a time, so that each particle is fetched from memory once.
void Packer::fillRows()
{
  constexpr std::ptrdiff_t rowsAtOnce = 128;
  hop::runParallel(std::ref(this->Work), this->rowCount(),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      for (; begin < end; begin += rowsAtOnce)
      {
        for (const auto& write : this->Writers)
        {
          write(begin, std::min(end, begin + rowsAtOnce));
        }
      }
    });
  evaluatePointArrays(
    this->Blocks, this->Elements, this->Evaluated, this->Rows, std::ref(this->Work));
}

void Packer::addPoints()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(this->rowCount());
  auto* positions = static_cast<double*>(points->GetVoidPointer(0));
  this->fillWith([positions](std::ptrdiff_t i, const ParticleRow& row)
    { std::copy_n(&row.particle->position.xyz.x, 3, positions + 3 * i); });
  this->Output->SetPoints(points);
}

void Packer::addVertices()
{
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  offsets->SetNumberOfValues(this->rowCount() + 1);
  connectivity->SetNumberOfValues(this->rowCount());
  vtkIdType* offset = offsets->GetPointer(0);
  vtkIdType* vertex = connectivity->GetPointer(0);
  this->fillWith([offset, vertex](std::ptrdiff_t i, const ParticleRow&)
    { offset[i] = vertex[i] = static_cast<vtkIdType>(i); });
  offsets->SetValue(this->rowCount(), this->rowCount());
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(offsets, connectivity);
  this->Output->SetVerts(vertices);
}

/// A point array of the output, yet to be filled.
vtkSmartPointer<vtkDoubleArray> Packer::newArray(const std::string& name, int components) const
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(this->rowCount());
  this->Output->GetPointData()->AddArray(array);
  return array;
}

/// A point array whose rows are filled by write(row, double*).
template <class Write>
vtkSmartPointer<vtkDoubleArray> Packer::addArray(
  const std::string& name, int components, const Write& write)
{
  const auto array = this->newArray(name, components);
  double* values = array->GetPointer(0);
  this->fillWith([values, components, write](std::ptrdiff_t i, const ParticleRow& row)
    { write(row, values + i * components); });
  return array;
}

void Packer::addOwnArrays()
{
  const auto writeVector = [](const glm::dvec3& v, double* out) { std::copy_n(&v.x, 3, out); };
  const auto normals = this->addArray("Normals", 3,
    [=](const ParticleRow& row, double* out) { writeVector(row.particle->normal.xyz, out); });
  this->Output->GetPointData()->SetNormals(normals);
  this->addArray("Radius", 1,
    [](const ParticleRow& row, double* out)
    { *out = row.particle->shrink * row.particle->spacing; });
  this->addArray("Mean_Curvature", 1,
    [](const ParticleRow& row, double* out) { *out = row.particle->curvature.mean; });
  this->addArray("Gauss_Curvature", 1,
    [](const ParticleRow& row, double* out) { *out = row.particle->curvature.gauss; });
  this->addArray("Shape_Operator", 6,
    [](const ParticleRow& row, double* out)
    {
      const glm::dmat3& shape = row.particle->curvature.shape;
      const double components[] = { shape[0][0], shape[1][1], shape[2][2], shape[0][1], shape[1][2],
        shape[0][2] }; // VTK's order of symmetric tensors
      std::copy(std::begin(components), std::end(components), out);
    });
  this->addArray(
    "Residual", 1, [](const ParticleRow& row, double* out) { *out = row.particle->residual; });
  this->addArray("Clip_Normal", 6,
    [=](const ParticleRow& row, double* out)
    {
      writeVector(row.particle->clips[0].normal.xyz, out);
      writeVector(row.particle->clips[1].normal.xyz, out + 3);
    });
  this->addArray("Clip_Distance", 2,
    [](const ParticleRow& row, double* out)
    {
      out[0] = row.particle->clips[0].distance;
      out[1] = row.particle->clips[1].distance;
    });
  this->addArray("Clip_Angle", 2,
    [](const ParticleRow& row, double* out)
    {
      out[0] = glm::degrees(row.particle->clips[0].dihedralAngle);
      out[1] = glm::degrees(row.particle->clips[1].dihedralAngle);
    });
  this->addArray("Clip_Curvature", 2,
    [](const ParticleRow& row, double* out)
    {
      out[0] = row.particle->clips[0].bend;
      out[1] = row.particle->clips[1].bend;
    });
  this->addArray("Jump", 1, [](const ParticleRow& row, double* out) { *out = row.particle->jump; });
  this->addArray("Isovalue", 1, [](const ParticleRow& row, double* out) { *out = row.isovalue; });
  // Places on a face may have left the domain by a rounding error.
  this->addArray("ParametricCoordinates", 3,
    [=](const ParticleRow& row, double* out)
    {
      const hop::ReferencePoint u{ glm::clamp(row.particle->location.u.xyz, 0.0, 1.0) };
      writeVector(parametricCoordinates(this->Grid->GetCellType(this->cellOf(row)), u).xyz, out);
    });
}

void Packer::addCellIds()
{
  vtkNew<vtkIdTypeArray> cells;
  cells->SetName("vtkOriginalCellIds");
  cells->SetNumberOfValues(this->rowCount());
  this->CellIds = cells->GetPointer(0);
  this->fillWith(
    [this](std::ptrdiff_t i, const ParticleRow& row) { this->CellIds[i] = this->cellOf(row); });
  this->Output->GetPointData()->AddArray(cells);
}

/// Every numeric point array that means something between the nodes.
void Packer::addPointArrays()
{
  vtkPointData* source = this->Grid->GetPointData();
  for (int a = 0; a < source->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = source->GetArray(a);
    if (!isField(source, array) || ownPointArrays.count(array->GetName()) > 0)
    {
      continue;
    }
    const std::string name = array->GetName();
    const int components = array->GetNumberOfComponents();
    vtkSmartPointer<vtkDoubleArray> values;
    if (array == this->Scalars && components == 1)
    {
      // As Contour: this array is the isovalue, not the isovalue with noise of the tolerance's size.
      values =
        this->addArray(name, 1, [](const ParticleRow& row, double* out) { *out = row.isovalue; });
      this->Output->GetPointData()->SetScalars(values);
    }
    else
    {
      values = this->newArray(name, components);
      this->Evaluated.push_back({ array, values->GetPointer(0) });
    }
    for (int c = 0; c < components; ++c)
    {
      values->SetComponentName(c, array->GetComponentName(c));
    }
  }
}

void Packer::addCellArrays()
{
  vtkCellData* source = this->Grid->GetCellData();
  vtkCellData* target = this->Output->GetCellData();
  target->CopyGlobalIdsOff();          // several particles share a cell: its id is no id of theirs
  target->CopyHigherOrderDegreesOff(); // particles have none
  target->CopyFieldOff(vtkDataSetAttributes::GhostArrayName());
  target->CopyAllocate(source, this->rowCount());
  constexpr vtkIdType rowsAtOnce = 65536;
  for (vtkIdType begin = 0; begin < this->rowCount(); begin += rowsAtOnce)
  {
    this->Work.ask();
    this->copyCellData(begin, std::min(this->rowCount(), begin + rowsAtOnce));
  }
}

void Packer::copyCellData(vtkIdType begin, vtkIdType end)
{
  vtkNew<vtkIdList> cells;
  vtkNew<vtkIdList> rows;
  cells->SetNumberOfIds(end - begin);
  rows->SetNumberOfIds(end - begin);
  std::copy(this->CellIds + begin, this->CellIds + end, cells->GetPointer(0));
  std::iota(rows->GetPointer(0), rows->GetPointer(0) + (end - begin), begin);
  this->Output->GetCellData()->CopyData(this->Grid->GetCellData(), cells, rows);
}

void Packer::addReport(const std::vector<IsovalueParticles>& isovalues)
{
  this->Output->GetFieldData()->PassData(this->Grid->GetFieldData());
  hop::DistributionReport sum;
  std::set<std::int64_t> undecided;
  for (const IsovalueParticles& some : isovalues)
  {
    const hop::DistributionReport& report = some.distribution.report;
    sum.evaluations += report.evaluations;
    sum.iterations += report.iterations;
    sum.boxesUndecided += report.boxesUndecided;
    sum.singularPoints += report.singularPoints;
    undecided.insert(report.undecidedCells.begin(), report.undecidedCells.end());
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
  addCount("ElementsDropped", this->Census.dropped);
  addCount("CellsSkipped", this->Census.skipped());
  addCount("BoxesUnresolved", sum.boxesUndecided);
  addCount("SingularPoints", sum.singularPoints);
  addCount("ParticlesRejected", sum.particlesRejected);
  addCount("ParticlesUndersampled", sum.particlesUndersampled);

  vtkNew<vtkIdTypeArray> cells;
  cells->SetName("UnresolvedCellIds");
  const auto end = undecided.lower_bound(this->FirstCell + this->Grid->GetNumberOfCells());
  for (auto cell = undecided.lower_bound(this->FirstCell); cell != end; ++cell)
  {
    cells->InsertNextValue(*cell - this->FirstCell);
  }
  this->Output->GetFieldData()->AddArray(cells);
}

/// Adds the rows of one isovalue, sorted by element so that neighbours in memory share one, to those of
/// their blocks.
void addRows(const InputBlocks& blocks, const hop::ElementMesh& mesh, const IsovalueParticles& some,
  hop::Interruptible& work, std::vector<std::vector<ParticleRow>>& rowsOfBlocks)
{
  const hop::Buffer<hop::Particle>& particles = some.distribution.particles;
  const hop::Grouping ofElements = hop::groupedBy(
    particles, mesh.elements.size(),
    [](const hop::Particle& particle) { return particle.location.element; }, std::ref(work));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    const BlockCell where = blocks.locate(mesh.elements[e].cell);
    const bool isGhost = blocks.isGhost(where);
    for (int n = ofElements.start[e]; n < ofElements.start[e + 1] && !isGhost; ++n)
    {
      rowsOfBlocks[where.block].push_back({ &particles[ofElements.order[n]], some.isovalue });
    }
  }
}

} // namespace

bool isOwnPointArray(const std::string& name)
{
  return ownPointArrays.count(name) > 0;
}

std::vector<std::string> replacedArrays(const std::vector<InputBlock>& blocks)
{
  std::set<std::string> names;
  for (const InputBlock& block : blocks)
  {
    addReplaced(block, names);
  }
  return { names.begin(), names.end() };
}

void packParticles(const InputBlocks& blocks, const GridElements& elements,
  const std::vector<IsovalueParticles>& isovalues, hop::Interruptible& work)
{
  std::vector<std::vector<ParticleRow>> rows(blocks.size());
  for (const IsovalueParticles& some : isovalues)
  {
    work.ask();
    addRows(blocks, elements.mesh, some, work, rows);
  }
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    work.raiseFraction(static_cast<double>(b) / static_cast<double>(blocks.size()));
    work.ask();
    Packer(blocks, b, elements, std::move(rows[b]), work).pack(isovalues);
  }
}
