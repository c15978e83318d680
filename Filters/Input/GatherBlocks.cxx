#include "Input/GatherBlocks.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

namespace hop
{

namespace
{

std::string nameOf(vtkDataObjectTreeIterator* node)
{
  const char* name = node->HasCurrentMetaData()
    ? node->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME())
    : nullptr;
  return name ? name : "";
}

GatheredBlocks gatherLeaves(vtkDataObjectTree* input, vtkDataObjectTree* output)
{
  GatheredBlocks result;
  // In a collection the partitioned data sets have names; its leaves, their pieces, have none.
  const bool isCollection = vtkPartitionedDataSetCollection::SafeDownCast(input) != nullptr;
  std::string nameOfPieces;
  const auto node = vtk::TakeSmartPointer(input->NewTreeIterator());
  node->VisitOnlyLeavesOff();
  for (node->InitTraversal(); !node->IsDoneWithTraversal(); node->GoToNextItem())
  {
    vtkDataObject* data = node->GetCurrentDataObject();
    std::string name = nameOf(node);
    if (vtkCompositeDataSet::SafeDownCast(data))
    {
      nameOfPieces = isCollection ? name : "";
      continue;
    }
    name = name.empty() ? nameOfPieces : name;
    const std::string number = "block " + std::to_string(node->GetCurrentFlatIndex());
    name = name.empty() ? number : number + " '" + name + "'";
    if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
    {
      const vtkNew<vtkPolyData> particles;
      output->SetDataSet(node, particles);
      result.blocks.push_back({ grid, nullptr, particles, name });
    }
    else
    {
      result.others.push_back(name);
    }
  }
  return result;
}

} // namespace

GatheredBlocks gatherBlocks(vtkDataObject* input, vtkDataObject* output)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  if (!tree)
  {
    return { { { vtkUnstructuredGrid::SafeDownCast(input), nullptr,
               vtkPolyData::SafeDownCast(output), "" } },
      {} };
  }
  auto* outputTree = vtkDataObjectTree::SafeDownCast(output);
  outputTree->CopyStructure(tree);
  outputTree->GetFieldData()->PassData(tree->GetFieldData());
  return gatherLeaves(tree, outputTree);
}

} // namespace hop
