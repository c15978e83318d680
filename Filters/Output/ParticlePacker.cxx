#include "Output/ParticlePacker.h"

#include "Output/DerivativeArrays.h"
#include "Output/FieldReports.h"
#include "Output/OutputArrays.h"
#include "Output/PointArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace hop
{

namespace
{

/// Whether an array is a field, with values between the nodes; ids, ghost marks and weights are none.
bool isField(vtkPointData* data, vtkDataArray* array)
{
  const std::string name = array && array->GetName() ? array->GetName() : "";
  const bool isLabel = array == data->GetGlobalIds() || array == data->GetPedigreeIds() ||
    array == data->GetRationalWeights() || name == vtkDataSetAttributes::GhostArrayName() ||
    name == "vtkOriginalPointIds" || name == OriginalCellIdsArray;
  return !name.empty() && !isLabel;
}

/// Whether the output has an array of its own in the place of a point array.
bool isReplaced(const InputBlock& block, vtkDataArray* array, const PassedArrays& passed)
{
  const std::string name = array->GetName();
  // The contoured array has the isovalue at every particle, which is what the output's own array holds.
  const bool isSame =
    array == block.scalars && array->GetNumberOfComponents() == 1 && name == IsovalueArray;
  return (isOwnPointArray(name) && !isSame) || (passed.derivatives && isDerivativeArray(name));
}

/// Adds the names of the block's arrays that are not passed on.
void addReplaced(const InputBlock& block, const PassedArrays& passed, std::set<std::string>& names)
{
  vtkPointData* points = block.grid->GetPointData();
  for (int a = 0; a < points->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = points->GetArray(a);
    if (isField(points, array) && isReplaced(block, array, passed))
    {
      names.insert(std::string("point array '") + array->GetName() + "'");
    }
  }
  const auto addField = [&](const char* name)
  {
    if (block.grid->GetFieldData()->HasArray(name))
    {
      names.insert(std::string("field array '") + name + "'");
    }
  };
  for (const ReportArray& array : reportArrays())
  {
    addField(array.name);
  }
  for (const MeshReportArray& array : meshReportArrays())
  {
    addField(array.name);
  }
  for (const ComponentArray& array : componentArrays())
  {
    addField(array.name);
  }
}

/// Whether all values of each component are the same.
bool isConstant(vtkDataArray* array)
{
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const double* range = array->GetRange(c);
    if (range[0] < range[1])
    {
      return false;
    }
  }
  return true;
}

/// Writes the output of one block.
class Packer
{
public:
  Packer(const InputBlocks& blocks, std::size_t block, const GridElements& elements, BlockRows rows,
    const PassedArrays& passed, Interruptible& work)
    : Blocks(blocks)
    , Block(block)
    , Grid(blocks[block].grid)
    , Scalars(blocks[block].scalars)
    , Elements(elements)
    , Cells(blocks, block, elements)
    , Passed(passed)
    , Work(work)
    , Output(blocks[block].particles)
    , Content(std::move(rows))
    , Rows(this->Content.rows)
  {
  }

  void pack(const std::vector<IsovalueParticles>& isovalues);
  ForeignCorners foreignCorners() const;

private:
  void addPoints();
  void addVertices();
  void addMeshCells();
  void addOwnArrays();
  void addIds(const char* name, RowWriter<vtkIdType> write, vtkSmartPointer<vtkIdTypeArray>& same);
  void addPointArrays();
  void addCellArrays();
  void copyCellData(const vtkIdType* cellIds, vtkIdType begin, vtkIdType end);
  void addFieldData(const std::vector<IsovalueParticles>& isovalues);
  template <class Array>
  vtkSmartPointer<Array> newArray(const std::string& name, int components) const;
  template <class Array, class Write>
  vtkSmartPointer<Array> addArray(const std::string& name, int components, const Write& write);
  template <class Write>
  void fillWith(const Write& write);
  void fillRows();
  vtkIdType rowCount() const { return static_cast<vtkIdType>(this->Rows.size()); }

  const InputBlocks& Blocks;
  std::size_t Block;
  vtkUnstructuredGrid* Grid;
  vtkDataArray* Scalars;
  const GridElements& Elements;
  const RowCells Cells;
  const PassedArrays& Passed;
  Interruptible& Work;
  vtkPointSet* Output;
  const BlockRows Content;
  const std::vector<ParticleRow>& Rows;
  /// Each writes rows begin to end - 1 of one array.
  std::vector<std::function<void(std::ptrdiff_t begin, std::ptrdiff_t end)>> Writers;
  std::vector<EvaluatedArray> Evaluated;
  bool HasSeveralIsovalues = false;
  bool HasCreases = false;
};

void Packer::pack(const std::vector<IsovalueParticles>& isovalues)
{
  this->HasSeveralIsovalues = isovalues.size() > 1;
  this->HasCreases = std::any_of(isovalues.begin(), isovalues.end(),
    [](const IsovalueParticles& some) { return some.mesh.hasCreases; });
  this->addPoints();
  if (this->Content.nodesPerCell > 0)
  {
    this->addMeshCells();
  }
  else
  {
    this->addVertices();
  }
  this->addPointArrays();
  this->addOwnArrays();
  this->fillRows();
  if (this->Passed.derivatives)
  {
    addDerivatives(
      this->Blocks, this->Elements, this->Rows, this->Output->GetPointData(), std::ref(this->Work));
  }
  this->addCellArrays();
  this->addFieldData(isovalues);
}

ForeignCorners Packer::foreignCorners() const
{
  ForeignCorners result;
  result.arrays = this->Evaluated;
  for (std::size_t r = 0; r < this->Rows.size(); ++r)
  {
    const ParticleRow& row = this->Rows[r];
    if (row.home)
    {
      result.corners.push_back({ static_cast<std::ptrdiff_t>(r), *row.home, row.location().u });
    }
  }
  return result;
}

/// Lets fillRows() call write(row number, row) for every row.
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

/// Fills all arrays at once, a few rows at a time, so that each particle is fetched from memory once.
void Packer::fillRows()
{
  // Fewer rows cost more calls; particles of many more rows leave the cache between two arrays. Chosen by experiment.
  constexpr std::ptrdiff_t rowsAtOnce = 128;
  runParallel(std::ref(this->Work), this->rowCount(),
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
    this->Blocks, this->Block, this->Elements, this->Evaluated, this->Rows, std::ref(this->Work));
}

void Packer::addPoints()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(this->rowCount());
  auto* positions = static_cast<double*>(points->GetVoidPointer(0));
  this->fillWith(
    [this, positions](std::ptrdiff_t i, const ParticleRow& row)
    {
      const WorldPoint position = this->Cells.position(row);
      std::copy_n(&position.xyz.x, 3, positions + 3 * i);
    });
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
  if (auto* polydata = vtkPolyData::SafeDownCast(this->Output))
  {
    polydata->SetVerts(vertices);
  } // else there is no surface to be curved triangles
}

/// Triangles, or Lagrange triangles.
void Packer::addMeshCells()
{
  const vtkIdType perCell = this->Content.nodesPerCell;
  const auto count = static_cast<vtkIdType>(this->Content.cells.size());
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  offsets->SetNumberOfValues(count + 1);
  for (vtkIdType c = 0; c <= count; ++c)
  {
    offsets->SetValue(c, perCell * c);
  }
  connectivity->SetNumberOfValues(perCell * count);
  std::copy(this->Content.nodes.begin(), this->Content.nodes.end(), connectivity->GetPointer(0));
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  if (auto* curved = vtkUnstructuredGrid::SafeDownCast(this->Output))
  {
    curved->SetCells(VTK_LAGRANGE_TRIANGLE, cells);
  }
  else
  {
    vtkPolyData::SafeDownCast(this->Output)->SetPolys(cells);
  }
}

/// A point array of the output, yet to be filled.
template <class Array>
vtkSmartPointer<Array> Packer::newArray(const std::string& name, int components) const
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(this->rowCount());
  this->Output->GetPointData()->AddArray(array);
  return array;
}

/// A point array whose rows are filled by write(row, pointer to its first component).
template <class Array, class Write>
vtkSmartPointer<Array> Packer::addArray(const std::string& name, int components, const Write& write)
{
  auto array = this->newArray<Array>(name, components);
  auto* values = array->GetPointer(0);
  this->fillWith([values, components, write](std::ptrdiff_t i, const ParticleRow& row)
    { write(row, values + i * components); });
  return array;
}

/// A point array of ids. If an array has the same ids, it shares its memory.
void Packer::addIds(
  const char* name, RowWriter<vtkIdType> write, vtkSmartPointer<vtkIdTypeArray>& same)
{
  if (same)
  {
    vtkNew<vtkIdTypeArray> alias;
    alias->ShallowCopy(same);
    alias->SetName(name);
    this->Output->GetPointData()->AddArray(alias);
    return;
  }
  same = this->addArray<vtkIdTypeArray>(name, 1,
    [this, write](const ParticleRow& row, vtkIdType* out) { write(row, this->Cells, out); });
}

void Packer::addOwnArrays()
{
  std::map<RowWriter<vtkIdType>, vtkSmartPointer<vtkIdTypeArray>> idsOf;
  for (const ParticleArray& array : particleArrays())
  {
    if ((array.use == ArrayUse::Diagnostic && !this->Passed.diagnostics) ||
      (array.use == ArrayUse::HiddenOfCreases && !this->HasCreases))
    {
      continue;
    }
    if (const auto* reals = std::get_if<RowWriter<double>>(&array.write))
    {
      this->addArray<vtkDoubleArray>(array.name, array.components,
        [this, write = *reals](const ParticleRow& row, double* out)
        { write(row, this->Cells, out); });
    }
    else if (const auto* singles = std::get_if<RowWriter<float>>(&array.write))
    {
      this->addArray<vtkFloatArray>(array.name, array.components,
        [this, write = *singles](const ParticleRow& row, float* out)
        { write(row, this->Cells, out); });
    }
    else if (const auto* ids = std::get_if<RowWriter<vtkIdType>>(&array.write))
    {
      this->addIds(array.name, *ids, idsOf[*ids]);
    }
    if (array.use == ArrayUse::Hidden || array.use == ArrayUse::HiddenOfCreases)
    {
      hideInPanels(*this->Output->GetPointData()->GetAbstractArray(array.name));
    }
  }
  this->Output->GetPointData()->SetActiveNormals(NormalsArray);
}

/// Adds every numeric point array of the grid that is a field.
void Packer::addPointArrays()
{
  vtkPointData* source = this->Grid->GetPointData();
  for (int a = 0; a < source->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = source->GetArray(a);
    if (!isField(source, array) || isOwnPointArray(array->GetName()) ||
      (this->Passed.derivatives && isDerivativeArray(array->GetName())))
    {
      continue;
    }
    const std::string name = array->GetName();
    const int components = array->GetNumberOfComponents();
    vtkSmartPointer<vtkDoubleArray> values;
    if (array == this->Scalars && components == 1 && !this->Blocks.isDerived())
    {
      // Contour does the same: the array holds the isovalue, without noise of the tolerance's size.
      values = this->addArray<vtkDoubleArray>(
        name, 1, [](const ParticleRow& row, double* out) { *out = row.isovalue; });
      // ParaView colours by the active scalars at first: on one isosurface that would be one colour of a legend.
      if (this->HasSeveralIsovalues)
      {
        this->Output->GetPointData()->SetScalars(values);
      }
    }
    else
    {
      values = this->newArray<vtkDoubleArray>(name, components);
      this->Evaluated.push_back({ array, values->GetPointer(0) });
    }
    for (int c = 0; c < components; ++c)
    {
      values->SetComponentName(c, array->GetComponentName(c));
    }
  }
  // Where no array of the input is contoured, as on slices, its active scalars are what is looked at.
  if (source->GetScalars() && !source->HasArray(this->Scalars->GetName()))
  {
    this->Output->GetPointData()->SetActiveScalars(source->GetScalars()->GetName());
  }
}

void Packer::addCellArrays()
{
  vtkCellData* source = this->Grid->GetCellData();
  vtkCellData* target = this->Output->GetCellData();
  target->CopyGlobalIdsOff();          // several particles share a cell: its id is no id of theirs
  target->CopyHigherOrderDegreesOff(); // vertices have no degrees
  target->CopyFieldOff(vtkDataSetAttributes::GhostArrayName());
  const bool isMesh = this->Content.nodesPerCell > 0;
  const vtkIdType count =
    isMesh ? static_cast<vtkIdType>(this->Content.cells.size()) : this->rowCount();
  target->CopyAllocate(source, count);
  const vtkIdType* cellIds = isMesh
    ? this->Content.cells.data()
    : vtkIdTypeArray::SafeDownCast(this->Output->GetPointData()->GetArray(CellIdsArray))
        ->GetPointer(0);
  // Rows between two questions whether to end early: fewer cost more calls, more delay an abort. Chosen by experiment.
  constexpr vtkIdType rowsAtOnce = 65536;
  for (vtkIdType begin = 0; begin < count; begin += rowsAtOnce)
  {
    this->Work.ask();
    this->copyCellData(cellIds, begin, std::min(count, begin + rowsAtOnce));
  }
  if (isMesh)
  {
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName(CellIdsArray);
    ids->SetNumberOfValues(count);
    std::copy_n(cellIds, count, ids->GetPointer(0));
    target->AddArray(ids);
  }
  // ParaView colours by the active scalars at first: constant ones would be one colour of a legend.
  if (target->GetScalars() && isConstant(target->GetScalars()))
  {
    target->SetActiveScalars(nullptr);
  }
}

/// Copies the cell data of rows begin to end - 1.
void Packer::copyCellData(const vtkIdType* cellIds, vtkIdType begin, vtkIdType end)
{
  vtkNew<vtkIdList> cells;
  vtkNew<vtkIdList> rows;
  cells->SetNumberOfIds(end - begin);
  rows->SetNumberOfIds(end - begin);
  std::copy(cellIds + begin, cellIds + end, cells->GetPointer(0));
  std::iota(rows->GetPointer(0), rows->GetPointer(0) + (end - begin), begin);
  this->Output->GetCellData()->CopyData(this->Grid->GetCellData(), cells, rows);
}

/// Passes the grid's field data, and tells of the run and of the mesh.
void Packer::addFieldData(const std::vector<IsovalueParticles>& isovalues)
{
  vtkFieldData* target = this->Output->GetFieldData();
  target->PassData(this->Grid->GetFieldData());
  removeReports(target);
  if (this->Passed.diagnostics)
  {
    addRunReport(isovalues, this->Blocks, this->Block, this->Elements.census[this->Block], target);
  }
  if (this->Content.nodesPerCell > 0)
  {
    addMeshReports(isovalues, this->Elements.units.length, target);
  }
}

} // namespace

std::vector<std::string> replacedArrays(
  const std::vector<InputBlock>& blocks, const PassedArrays& passed)
{
  std::set<std::string> names;
  for (const InputBlock& block : blocks)
  {
    addReplaced(block, passed, names);
  }
  return { names.begin(), names.end() };
}

std::vector<ForeignCorners> packParticles(const InputBlocks& blocks, const GridElements& elements,
  const std::vector<IsovalueParticles>& isovalues, const PassedArrays& passed, Interruptible& work)
{
  std::vector<BlockRows> rows = shareOutToBlocks(blocks, elements.mesh, isovalues, work);
  std::vector<ForeignCorners> foreign;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    work.raiseFraction(static_cast<double>(b) / static_cast<double>(blocks.size()));
    work.ask();
    Packer packer(blocks, b, elements, std::move(rows[b]), passed, work);
    packer.pack(isovalues);
    foreign.push_back(packer.foreignCorners());
  }
  return foreign;
}

} // namespace hop
