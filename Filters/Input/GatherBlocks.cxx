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

/// What messages call a leaf: "block 3", or "block 3 'name'".
std::string labelOf(unsigned int flatIndex, const std::string& name)
{
  std::string label = "block " + std::to_string(flatIndex);
  if (!name.empty())
  {
    label += " '" + name + "'";
  }
  return label;
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
    const std::string ownName = nameOf(node);
    if (vtkCompositeDataSet::SafeDownCast(data))
    {
      nameOfPieces = isCollection ? ownName : "";
      continue;
    }
    const std::string name =
      labelOf(node->GetCurrentFlatIndex(), ownName.empty() ? nameOfPieces : ownName);
    if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
    {
      const vtkNew<vtkPolyData> particles;
      output->SetDataSet(node, particles);
      result.blocks.push_back(
        { grid, nullptr, particles, name, 0, static_cast<int>(node->GetCurrentFlatIndex()) });
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
