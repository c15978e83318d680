#include "Output/FieldReports.h"

#include "Output/OutputArrays.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <cstdint>
#include <set>
#include <type_traits>
#include <variant>

namespace hop
{

namespace
{

/// Sums the reports of all isovalues.
/// \param begin, end the cells of the block are those from begin to end - 1
BlockReport reportOf(const std::vector<IsovalueParticles>& isovalues, const CellCensus& census,
  std::int64_t begin, std::int64_t end)
{
  BlockReport result{ {}, census, {} };
  DistributionReport& sum = result.sum;
  std::set<std::int64_t> undecided;
  for (const IsovalueParticles& some : isovalues)
  {
    const DistributionReport& report = some.distribution.report;
    sum.evaluations += report.evaluations;
    sum.iterations += report.iterations;
    sum.boxesUndecided += report.boxesUndecided;
    sum.singularPoints += report.singularPoints;
    undecided.insert(report.undecidedCells.begin(), report.undecidedCells.end());
    sum.particlesRejected += report.particlesRejected;
    sum.particlesUndersampled += report.particlesUndersampled;
    sum.facesReached += report.facesReached;
    sum.facesEnded += report.facesEnded;
  }
  const auto last = undecided.lower_bound(end);
  for (auto cell = undecided.lower_bound(begin); cell != last; ++cell)
  {
    result.undecidedCells.push_back(*cell - begin);
  }
  return result;
}

/// Sums the reports of all isovalues' meshes.
MeshNumbers meshReportOf(const std::vector<IsovalueParticles>& isovalues, double unitOfLength)
{
  MeshNumbers sum;
  for (const IsovalueParticles& some : isovalues)
  {
    sum.openLoops += some.mesh.openLoops;
    sum.unusedParticles += some.mesh.unusedParticles;
    sum.turnedTriangles += some.mesh.turnedTriangles;
    sum.openLength += unitOfLength * some.mesh.openLength;
    sum.straightNodes += some.mesh.straightNodes;
    sum.components += some.mesh.components;
    sum.unprovenComponents += some.mesh.unprovenComponents;
    sum.isProven = sum.isProven && some.mesh.isProven;
  }
  return sum;
}

/// An empty array in the field data, for values of a type: ids for integers.
template <class Value>
vtkDataArray& addArray(const char* name, vtkFieldData* to)
{
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(std::is_integral_v<Value> ? static_cast<vtkDataArray*>(vtkIdTypeArray::New())
                                                : vtkDoubleArray::New());
  array->SetName(name);
  array->SetNumberOfComponents(std::is_same_v<Value, glm::dvec3> ? 3 : 1);
  hideInPanels(*array);
  to->AddArray(array);
  return *array;
}

void append(std::int64_t value, vtkDataArray& to)
{
  vtkIdTypeArray::SafeDownCast(&to)->InsertNextValue(value);
}

void append(double value, vtkDataArray& to)
{
  to.InsertNextTuple1(value);
}

void append(const glm::dvec3& value, vtkDataArray& to)
{
  to.InsertNextTuple3(value.x, value.y, value.z);
}

/// One tuple for each component of the meshes.
void addComponents(const std::vector<IsovalueParticles>& isovalues, double unitOfLength,
  const ComponentArray& column, vtkFieldData* to)
{
  std::visit(
    [&](const auto& valueOf)
    {
      using Value = std::invoke_result_t<decltype(valueOf), const ComponentRow&>;
      vtkDataArray& array = addArray<Value>(column.name, to);
      for (const IsovalueParticles& some : isovalues)
      {
        for (const MeshComponent& component : some.mesh.parts)
        {
          append(valueOf({ component, some.isovalue, unitOfLength }), array);
        }
      }
    },
    column.value);
}

} // namespace

void removeReports(vtkFieldData* from)
{
  const auto remove = [&](const auto& arrays)
  {
    for (const auto& array : arrays)
    {
      from->RemoveArray(array.name);
    }
  };
  remove(reportArrays());
  remove(meshReportArrays());
  remove(componentArrays());
}

void addRunReport(const std::vector<IsovalueParticles>& isovalues, const InputBlocks& blocks,
  std::size_t block, const CellCensus& census, vtkFieldData* to)
{
  const std::int64_t first = blocks.firstCell(block);
  const BlockReport report =
    reportOf(isovalues, census, first, first + blocks[block].grid->GetNumberOfCells());
  for (const ReportArray& row : reportArrays())
  {
    vtkDataArray& array = addArray<vtkIdType>(row.name, to);
    for (const vtkIdType value : row.values(report))
    {
      append(static_cast<std::int64_t>(value), array);
    }
  }
}

void addMeshReports(
  const std::vector<IsovalueParticles>& isovalues, double unitOfLength, vtkFieldData* to)
{
  const MeshNumbers report = meshReportOf(isovalues, unitOfLength);
  for (const MeshReportArray& row : meshReportArrays())
  {
    std::visit(
      [&](const auto& valueOf)
      {
        const auto value = valueOf(report);
        append(value, addArray<std::decay_t<decltype(value)>>(row.name, to));
      },
      row.value);
  }
  for (const ComponentArray& column : componentArrays())
  {
    addComponents(isovalues, unitOfLength, column, to);
  }
}

} // namespace hop
