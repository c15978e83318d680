#include "Input/ArrayLengths.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

namespace hop
{

namespace
{

/// "point array 'F' of block 1 (2 tuples for 8 points)" if the array is too short, else empty.
/// \param kind "point" or "cell"
/// \param wanted number of points or cells
std::string describeIfShort(
  const InputBlock& block, vtkAbstractArray* array, const std::string& kind, vtkIdType wanted)
{
  const vtkIdType tuples = array->GetNumberOfTuples();
  const std::string name = array->GetName() ? array->GetName() : "";
  const std::string place = block.name.empty() ? "" : " of " + block.name;
  return tuples >= wanted ? ""
                          : kind + " array '" + name + "'" + place + " (" + std::to_string(tuples) +
      (tuples == 1 ? " tuple for " : " tuples for ") + std::to_string(wanted) + " " + kind + "s)";
}

/// Removes the short arrays from a copy of the block's attributes and adds their descriptions to `dropped`.
void dropShort(const InputBlock& block, vtkDataSetAttributes* attributes, const std::string& kind,
  vtkIdType wanted, std::vector<std::string>& dropped)
{
  for (int a = attributes->GetNumberOfArrays() - 1; a >= 0; --a)
  {
    const std::string text = describeIfShort(block, attributes->GetAbstractArray(a), kind, wanted);
    if (!text.empty())
    {
      attributes->RemoveArray(a);
      dropped.push_back(text);
    }
  }
}

} // namespace

std::string describeShortScalars(const InputBlock& block)
{
  return describeIfShort(block, block.scalars, "point", block.grid->GetNumberOfPoints());
}

std::vector<std::string> dropShortArrays(InputBlock& block)
{
  const auto copy = vtkSmartPointer<vtkUnstructuredGrid>::New();
  copy->ShallowCopy(block.grid);
  std::vector<std::string> dropped;
  dropShort(block, copy->GetPointData(), "point", copy->GetNumberOfPoints(), dropped);
  dropShort(block, copy->GetCellData(), "cell", copy->GetNumberOfCells(), dropped);
  block.grid = dropped.empty() ? block.grid : copy;
  return dropped;
}

} // namespace hop
