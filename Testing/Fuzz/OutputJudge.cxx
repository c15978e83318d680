#include "OutputJudge.h"

#include "FilterSession.h"
#include "MeshJudge.h"
#include "VtkCellComparison.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hop::testing
{
namespace
{

using Complaints = std::vector<std::string>;

bool isFinite(vtkDataArray& array)
{
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array.GetNumberOfComponents(); ++c)
    {
      if (!std::isfinite(array.GetComponent(i, c)))
      {
        return false;
      }
    }
  }
  return true;
}

void judgeNumbers(vtkPointSet& output, Complaints& found)
{
  if (!isFinite(*output.GetPoints()->GetData()))
  {
    found.emplace_back("a point is not finite");
  }
  vtkPointData& data = *output.GetPointData();
  for (int n = 0; n < data.GetNumberOfArrays(); ++n)
  {
    vtkDataArray* array = data.GetArray(n);
    if (!array || array->GetNumberOfTuples() != output.GetNumberOfPoints())
    {
      found.push_back(std::string(data.GetArrayName(n)) + " has not one row a point");
    }
    else if (!isFinite(*array))
    {
      found.push_back(std::string(data.GetArrayName(n)) + " is not finite");
    }
  }
}

/// Least and largest number of an array.
std::array<double, 2> rangeOf(vtkDataArray& array)
{
  std::array<double, 2> range{ HUGE_VAL, -HUGE_VAL };
  for (int c = 0; c < array.GetNumberOfComponents(); ++c)
  {
    const double* some = array.GetRange(c);
    range = { std::min(range[0], some[0]), std::max(range[1], some[1]) };
  }
  return range;
}

void judgeRanges(vtkUnstructuredGrid& grid, vtkPointSet& output, Complaints& found)
{
  vtkPointData& data = *output.GetPointData();
  vtkDataArray& normals = *data.GetArray("Normals");
  for (vtkIdType i = 0; i < normals.GetNumberOfTuples(); ++i)
  {
    const double* n = normals.GetTuple3(i);
    if (std::abs(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) - 1.0) > 2e-7) // floats
    {
      found.emplace_back("a normal is not of unit length");
      break;
    }
  }
  const auto ids = rangeOf(*data.GetArray("vtkOriginalCellIds"));
  if (ids[0] < 0 || ids[1] >= static_cast<double>(grid.GetNumberOfCells()))
  {
    found.emplace_back("a cell id is out of range");
  }
  const auto places = rangeOf(*data.GetArray("ParametricCoordinates"));
  if (places[0] < -1e-9 || places[1] > 1.0 + 1e-9)
  {
    found.emplace_back("a place is outside its cell");
  }
  if (rangeOf(*data.GetArray("Radius"))[0] <= 0.0)
  {
    found.emplace_back("a radius is not positive");
  }
}

double reported(vtkPointSet& output, const char* name)
{
  vtkDataArray* array = output.GetFieldData()->GetArray(name);
  return array && array->GetNumberOfTuples() > 0 ? array->GetComponent(0, 0) : 0.0;
}

Complaints judgePart(
  const FilterSession& session, vtkUnstructuredGrid& grid, vtkPointSet& output, bool isPart)
{
  Complaints found;
  judgeNumbers(output, found);
  if (!found.empty())
  {
    return found;
  }
  judgeRanges(grid, output, found);
  const bool isMesh = session.filter().GetOutputType() != vtkHighOrderParticleIsosurface::PARTICLES;
  if (isMesh)
  {
    judgeMesh(output, isPart, found);
  }
  // Corners may be at home in another block, and nodes of curved triangles off the surface, with a warning.
  const bool isComparable = !isMesh || (!isPart && reported(output, "MeshStraightNodes") == 0.0);
  if (found.empty() && isComparable)
  {
    compareWithVtk(session, grid, output, found);
  }
  return found;
}

void append(vtkDataArray* array, std::string& bytes)
{
  if (array)
  {
    bytes.append(static_cast<const char*>(array->GetVoidPointer(0)),
      static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize());
  }
}

void append(vtkPointSet& output, std::string& bytes)
{
  append(output.GetPoints() ? output.GetPoints()->GetData() : nullptr, bytes);
  for (int n = 0; n < output.GetPointData()->GetNumberOfArrays(); ++n)
  {
    append(output.GetPointData()->GetArray(n), bytes);
  }
  if (output.GetNumberOfCells() > 0)
  {
    append(cellsOf(output).GetConnectivityArray(), bytes);
  }
}

} // namespace

std::vector<std::string> judge(const FilterSession& session)
{
  Complaints found = session.complaints();
  const auto inputs = session.inputs();
  const auto outputs = session.outputs();
  for (std::size_t n = 0; n < outputs.size(); ++n)
  {
    auto* output = vtkPointSet::SafeDownCast(outputs[n]);
    if (output && output->GetNumberOfPoints() > 0)
    {
      const Complaints more = judgePart(session, *inputs[n], *output, outputs.size() > 1);
      found.insert(found.end(), more.begin(), more.end());
    }
  }
  return found;
}

std::string contents(const FilterSession& session)
{
  std::string bytes;
  for (const vtkSmartPointer<vtkDataObject>& part : session.outputs())
  {
    if (auto* output = vtkPointSet::SafeDownCast(part))
    {
      append(*output, bytes);
    }
  }
  return bytes;
}

} // namespace hop::testing
