#include "vtkPVCrossedCellsInformation.h"

#include "ComponentValue.h"
#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkClientServerStream.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkMultiProcessStream.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

/// About the number of cells of a block that a rank looks at: more would delay the default isovalue in the panel, with
/// fewer small surfaces may be missed. Chosen by experiment.
constexpr vtkIdType mostLookedAt = 100'000;

} // namespace

vtkStandardNewMacro(vtkPVCrossedCellsInformation);

vtkPVCrossedCellsInformation::vtkPVCrossedCellsInformation() = default;
vtkPVCrossedCellsInformation::~vtkPVCrossedCellsInformation() = default;

/// Adds every n-th cell to the sizes of the isosurfaces that it holds, n times.
void vtkPVCrossedCellsInformation::AddCells(vtkDataSet* block, vtkDataArray* array)
{
  const vtkIdType step = 1 + (block->GetNumberOfCells() - 1) / mostLookedAt;
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < block->GetNumberOfCells(); cell += step)
  {
    block->GetCellPoints(cell, points);
    vtkBoundingBox box;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const vtkIdType point : *points)
    {
      if (point >= 0 && point < std::min(block->GetNumberOfPoints(), array->GetNumberOfTuples()))
      {
        const double value = ComponentValue(array, point, this->Component);
        low = std::min(low, value);
        high = std::max(high, value);
        box.AddPoint(block->GetPoint(point));
      }
    }
    const double size = low < high ? std::pow(box.GetDiagonalLength(), 2) : 0.0;
    for (std::size_t i = 0; i < this->Isovalues.size(); ++i)
    {
      // Surfaces in faces between cells count, twice.
      if (low <= this->Isovalues[i] && this->Isovalues[i] <= high)
      {
        this->Sizes[i] += static_cast<double>(step) * size;
      }
    }
  }
}

void vtkPVCrossedCellsInformation::CopyFromObject(vtkObject* object)
{
  this->Sizes.assign(this->Isovalues.size(), 0.0);
  auto* algorithm = vtkAlgorithm::SafeDownCast(object);
  if (!algorithm || this->Port >= algorithm->GetNumberOfOutputPorts())
  {
    return;
  }
  vtkDataObject* data = algorithm->GetOutputDataObject(this->Port);
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets<vtkDataSet>(data))
  {
    if (vtkDataArray* array = block->GetPointData()->GetArray(this->ArrayName.c_str()))
    {
      this->AddCells(block, array);
    }
  }
}

void vtkPVCrossedCellsInformation::AddInformation(vtkPVInformation* information)
{
  if (auto* other = vtkPVCrossedCellsInformation::SafeDownCast(information))
  {
    this->Sizes.resize(std::max(this->Sizes.size(), other->Sizes.size()), 0.0);
    for (std::size_t i = 0; i < other->Sizes.size(); ++i)
    {
      this->Sizes[i] += other->Sizes[i];
    }
  }
}

void vtkPVCrossedCellsInformation::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply;
  for (const double size : this->Sizes)
  {
    *stream << size;
  }
  *stream << vtkClientServerStream::End;
}

void vtkPVCrossedCellsInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  this->Sizes.clear();
  double size = 0.0;
  for (int argument = 0; stream->GetArgument(0, argument, &size); ++argument)
  {
    this->Sizes.push_back(size);
  }
}

void vtkPVCrossedCellsInformation::CopyParametersToStream(vtkMultiProcessStream& stream)
{
  stream << this->Port << this->ArrayName << this->Component
         << static_cast<int>(this->Isovalues.size());
  for (const double isovalue : this->Isovalues)
  {
    stream << isovalue;
  }
}

void vtkPVCrossedCellsInformation::CopyParametersFromStream(vtkMultiProcessStream& stream)
{
  int count = 0;
  stream >> this->Port >> this->ArrayName >> this->Component >> count;
  this->Isovalues.resize(count);
  for (double& isovalue : this->Isovalues)
  {
    stream >> isovalue;
  }
}

void vtkPVCrossedCellsInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Port: " << this->Port << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "Isovalues: " << this->Isovalues.size() << "\n";
}
