#include "SplatInput.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataAssembly.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLinksTemplate.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace hop
{
namespace
{
// Filters such as Threshold and Clip make an unstructured grid of vertices from particles.
vtkSmartPointer<vtkPolyData> PointSetAsParticles(vtkPointSet* input)
{
  auto particles = vtkSmartPointer<vtkPolyData>::New();
  particles->SetPoints(input->GetPoints());
  particles->GetPointData()->ShallowCopy(input->GetPointData());
  particles->GetFieldData()->ShallowCopy(input->GetFieldData());

  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkIdTypeArray> vertexCells;
  vertexCells->SetName(SplatInput::BlockCellIdName);
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    const int type = input->GetCellType(cell);
    if (type == VTK_VERTEX || type == VTK_POLY_VERTEX)
    {
      input->GetCellPoints(cell, points);
      vertices->InsertNextCell(points);
      vertexCells->InsertNextValue(cell);
    }
  }
  particles->SetVerts(vertices);
  particles->GetCellData()->CopyAllocate(input->GetCellData(), vertexCells->GetNumberOfTuples());
  for (vtkIdType i = 0; i < vertexCells->GetNumberOfTuples(); ++i)
  {
    particles->GetCellData()->CopyData(input->GetCellData(), vertexCells->GetValue(i), i);
  }
  particles->GetCellData()->AddArray(vertexCells);
  return particles;
}

vtkSmartPointer<vtkIdTypeArray> Numbers(const char* name, vtkIdType count)
{
  auto numbers = vtkSmartPointer<vtkIdTypeArray>::New();
  numbers->SetName(name);
  numbers->SetNumberOfTuples(count);
  std::iota(numbers->GetPointer(0), numbers->GetPointer(0) + count, vtkIdType(0));
  return numbers;
}

void GiveCells(vtkPolyData* particles, const char* name, unsigned int value)
{
  vtkNew<vtkUnsignedIntArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(particles->GetNumberOfCells());
  array->FillValue(value);
  particles->GetCellData()->AddArray(array);
}

void RememberBlock(vtkPolyData* particles, unsigned int flatIndex)
{
  using namespace SplatInput;
  GiveCells(particles, BlockIndexName, flatIndex);
  EnsureIds(particles);
}

// Selections find the block of a particle through its vertex cell, which stands for a cell at its point.
void EnsureVertexCells(vtkPolyData* particles)
{
  if (particles->GetNumberOfVerts() > 0)
  {
    return;
  }
  vtkStaticCellLinksTemplate<vtkIdType> links;
  links.BuildLinks(particles);
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkIdTypeArray> cells;
  cells->SetName(SplatInput::BlockCellIdName);
  for (vtkIdType point = 0; point < particles->GetNumberOfPoints(); ++point)
  {
    vertices->InsertNextCell(1, &point);
    cells->InsertNextValue(links.GetNcells(point) > 0 ? links.GetCells(point)[0] : -1);
  }
  particles->GetCellData()->Initialize();
  particles->GetCellData()->AddArray(cells);
  particles->SetVerts(vertices);
  particles->SetLines(nullptr);
  particles->SetPolys(nullptr);
  particles->SetStrips(nullptr);
}

// Flat indices of the blocks with data that the selectors name.
std::set<unsigned int> SelectedBlocks(
  vtkCompositeDataSet* input, const std::set<std::string>& selectors)
{
  vtkNew<vtkDataAssembly> hierarchy;
  vtkDataAssemblyUtilities::GenerateHierarchy(input, hierarchy);
  const std::vector<std::string> names(selectors.begin(), selectors.end());
  auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(input);
  const std::vector<unsigned int> named = collection
    ? hierarchy->GetDataSetIndices(hierarchy->SelectNodes(names))
    : vtkDataAssemblyUtilities::GetSelectedCompositeIds(names, hierarchy, nullptr, true);
  std::set<unsigned int> blocks(named.begin(), named.end());
  // The leaves of a collection's hierarchy are partitioned data sets; the leaves of its data are their partitions.
  if (collection)
  {
    for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
    {
      for (unsigned int j = 0; j < collection->GetNumberOfPartitions(i); ++j)
      {
        if (blocks.count(collection->GetCompositeIndex(i)))
        {
          blocks.insert(collection->GetCompositeIndex(i, j));
        }
      }
    }
  }
  return blocks;
}

// The numbers that ParaView's geometry gives to blocks, by flat index. Empty blocks count. The pieces of a data set
// have one number; in multiblocks the numbers of its pieces are left out before the next block.
std::map<unsigned int, unsigned int> BlockNumbers(vtkCompositeDataSet* input)
{
  std::map<unsigned int, unsigned int> numbers;
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  if (!tree)
  {
    return numbers;
  }
  vtkSmartPointer<vtkDataObjectTreeIterator> nodes;
  nodes.TakeReference(tree->NewTreeIterator());
  nodes->VisitOnlyLeavesOff();
  nodes->SkipEmptyNodesOff();
  unsigned int number = 0;
  unsigned int next = 0;
  unsigned int lastPiece = 0; // flat index
  for (nodes->InitTraversal(); !nodes->IsDoneWithTraversal(); nodes->GoToNextItem())
  {
    const unsigned int index = nodes->GetCurrentFlatIndex();
    vtkDataObject* node = nodes->GetCurrentDataObject();
    if (index > lastPiece)
    {
      number = next;
      if (auto* pieces = vtkPartitionedDataSet::SafeDownCast(node))
      {
        lastPiece = index + pieces->GetNumberOfPartitions();
        next += tree->IsA("vtkMultiBlockDataSet") ? pieces->GetNumberOfPartitions() : 1;
      }
      else if (!vtkDataObjectTree::SafeDownCast(node))
      {
        ++next;
      }
    }
    numbers[index] = number;
  }
  return numbers;
}

// Red, green, blue and opacity of a block without a colour of its own: the mapper takes values above 1 for none.
constexpr std::array<double, 4> Unchanged = { 2., 2., 2., 2. };

// Colours and opacities by flat index; blocks without either have no entry.
std::map<unsigned int, std::array<double, 4>> BlockColors(
  vtkCompositeDataSet* input, const SplatInput::Blocks& blocks)
{
  std::map<unsigned int, std::array<double, 4>> colors;
  for (const auto& [selector, color] : blocks.Colors)
  {
    for (unsigned int block : SelectedBlocks(input, { selector }))
    {
      std::copy(color.begin(), color.end(), colors.emplace(block, Unchanged).first->second.begin());
    }
  }
  for (const auto& [selector, opacity] : blocks.Opacities)
  {
    for (unsigned int block : SelectedBlocks(input, { selector }))
    {
      colors.emplace(block, Unchanged).first->second[3] = opacity;
    }
  }
  return colors;
}

void GiveColor(vtkPolyData* particles, const std::array<double, 4>& color)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(SplatInput::BlockColorName);
  array->SetNumberOfComponents(4);
  array->SetNumberOfTuples(particles->GetNumberOfCells());
  for (int c = 0; c < 4; ++c)
  {
    array->FillComponent(c, color[c]);
  }
  particles->GetCellData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> CompositeAsParticles(
  vtkCompositeDataSet* input, const SplatInput::Blocks& drawing)
{
  const bool all = drawing.Drawn.count("/") != 0;
  const std::set<unsigned int> selected =
    all ? std::set<unsigned int>() : SelectedBlocks(input, drawing.Drawn);
  const auto colors = BlockColors(input, drawing);
  auto numbers = BlockNumbers(input);
  vtkNew<vtkAppendPolyData> merge;
  vtkSmartPointer<vtkCompositeDataIterator> blocks;
  blocks.TakeReference(input->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    vtkSmartPointer<vtkPolyData> particles =
      SplatInput::AsParticles(blocks->GetCurrentDataObject());
    const bool visible = all || selected.count(blocks->GetCurrentFlatIndex()) != 0;
    if (visible && particles->GetNumberOfPoints() > 0)
    {
      EnsureVertexCells(particles);
      RememberBlock(particles, blocks->GetCurrentFlatIndex());
      GiveCells(particles, SplatInput::BlockNumberName,
        numbers[blocks->GetCurrentFlatIndex()] % drawing.DistinctNumbers);
      if (!colors.empty())
      {
        const auto color = colors.find(blocks->GetCurrentFlatIndex());
        GiveColor(particles, color != colors.end() ? color->second : Unchanged);
      }
      merge->AddInputData(particles);
    }
  }
  if (merge->GetNumberOfInputConnections(0) == 0)
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  merge->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  merge->Update();
  return merge->GetOutput();
}
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> SplatInput::AsParticles(vtkDataObject* data, const Blocks& blocks)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    return CompositeAsParticles(composite, blocks);
  }
  auto particles = vtkSmartPointer<vtkPolyData>::New();
  if (auto* polydata = vtkPolyData::SafeDownCast(data))
  {
    particles->ShallowCopy(polydata);
    return particles;
  }
  auto* points = vtkPointSet::SafeDownCast(data);
  return points && points->GetPoints() ? PointSetAsParticles(points) : particles;
}

//------------------------------------------------------------------------------
void SplatInput::EnsureIds(vtkPolyData* particles)
{
  if (!particles->GetPointData()->HasArray(BlockPointIdName))
  {
    particles->GetPointData()->AddArray(Numbers(BlockPointIdName, particles->GetNumberOfPoints()));
  }
  if (!particles->GetCellData()->HasArray(BlockCellIdName))
  {
    particles->GetCellData()->AddArray(Numbers(BlockCellIdName, particles->GetNumberOfCells()));
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> SplatInput::WithoutBlockIds(vtkPolyData* particles)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(particles);
  copy->GetPointData()->RemoveArray(BlockPointIdName);
  copy->GetCellData()->RemoveArray(BlockCellIdName);
  copy->GetCellData()->RemoveArray(BlockIndexName);
  copy->GetCellData()->RemoveArray(BlockColorName);
  if (vtkDataArray* numbers = particles->GetCellData()->GetArray(BlockNumberName))
  {
    vtkNew<vtkFieldData> fields;
    fields->ShallowCopy(particles->GetFieldData());
    fields->AddArray(numbers);
    copy->SetFieldData(fields);
    copy->GetCellData()->RemoveArray(BlockNumberName);
  }
  return copy;
}
}
