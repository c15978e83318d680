#include "Input/Fingerprint.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <string>
#include <vector>

namespace hop
{

namespace
{

void addText(const char* text, ByteHash& hash)
{
  hash.add(std::string(text ? text : ""));
}

void addValues(vtkAbstractArray* array, ByteHash& hash)
{
  auto* numbers = vtkDataArray::SafeDownCast(array);
  if (numbers && array->HasStandardMemoryLayout() && array->GetDataTypeSize() > 0)
  {
    const vtkIdType bytes = array->GetNumberOfValues() * array->GetDataTypeSize();
    hash.add(bytes > 0 ? array->GetVoidPointer(0) : nullptr, static_cast<std::size_t>(bytes));
    return;
  }
  // Strings, bits, and arrays that are computed when they are asked for.
  const int components = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    if (numbers)
    {
      hash.add(numbers->GetComponent(i / components, static_cast<int>(i % components)));
    }
    else
    {
      hash.add(array->GetVariantValue(i).ToString());
    }
  }
}

void addArray(vtkAbstractArray* array, ByteHash& hash)
{
  if (!array)
  {
    hash.addWord(0);
    return;
  }
  addText(array->GetName(), hash);
  hash.addWord(static_cast<std::uint64_t>(array->GetDataType()));
  hash.addWord(static_cast<std::uint64_t>(array->GetNumberOfComponents()));
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    addText(array->GetComponentName(c), hash);
  }
  addValues(array, hash);
}

void addArrays(vtkFieldData* data, ByteHash& hash)
{
  hash.addWord(static_cast<std::uint64_t>(data->GetNumberOfArrays()));
  for (int a = 0; a < data->GetNumberOfArrays(); ++a)
  {
    addArray(data->GetAbstractArray(a), hash);
  }
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  for (int role = 0; attributes && role < vtkDataSetAttributes::NUM_ATTRIBUTES; ++role)
  {
    vtkAbstractArray* array = attributes->GetAbstractAttribute(role);
    addText(array ? array->GetName() : nullptr, hash);
  }
}

void addGrid(vtkUnstructuredGrid* grid, ByteHash& hash)
{
  addArray(grid->GetPoints() ? grid->GetPoints()->GetData() : nullptr, hash);
  vtkCellArray* cells = grid->GetCells();
  addArray(cells ? cells->GetOffsetsArray() : nullptr, hash);
  addArray(cells ? cells->GetConnectivityArray() : nullptr, hash);
  std::vector<unsigned char> types(static_cast<std::size_t>(grid->GetNumberOfCells()));
  for (std::size_t cell = 0; cell < types.size(); ++cell)
  {
    types[cell] = static_cast<unsigned char>(grid->GetCellType(static_cast<vtkIdType>(cell)));
  }
  hash.add(types.data(), types.size());
  addArrays(grid->GetPointData(), hash);
  addArrays(grid->GetCellData(), hash);
}

void addTree(vtkDataObjectTree* tree, ByteHash& hash)
{
  vtkSmartPointer<vtkDataObjectTreeIterator> nodes;
  nodes.TakeReference(tree->NewTreeIterator());
  nodes->VisitOnlyLeavesOff();
  nodes->SkipEmptyNodesOff();
  for (nodes->InitTraversal(); !nodes->IsDoneWithTraversal(); nodes->GoToNextItem())
  {
    hash.addWord(nodes->GetCurrentFlatIndex());
    const bool isNamed =
      nodes->HasCurrentMetaData() && nodes->GetCurrentMetaData()->Has(vtkCompositeDataSet::NAME());
    addText(
      isNamed ? nodes->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) : nullptr, hash);
    vtkDataObject* node = nodes->GetCurrentDataObject();
    if (vtkDataObjectTree::SafeDownCast(node))
    {
      addText(node->GetClassName(), hash); // its children follow
    }
    else
    {
      addData(node, hash);
    }
  }
}

} // namespace

void addData(vtkDataObject* data, ByteHash& hash)
{
  addText(data ? data->GetClassName() : nullptr, hash);
  if (!data)
  {
    return;
  }
  addArrays(data->GetFieldData(), hash);
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    addTree(tree, hash);
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    addGrid(grid, hash);
  }
}

} // namespace hop
