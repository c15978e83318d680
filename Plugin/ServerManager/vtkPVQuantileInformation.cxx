#include "vtkPVQuantileInformation.h"

#include "ComponentValue.h"
#include "DerivedSamples.h"
#include "vtkAlgorithm.h"
#include "vtkClientServerStream.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkHighOrderParticleIsosurface.h"
#include "vtkMultiProcessStream.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{

/// Values that a rank sends at most: one for each thousandth, with both ends. More make quantiles of several ranks more
/// exact, fewer coarser.
constexpr std::size_t mostSamples = 1001;

/// About the number of values that a rank looks at in longer arrays: sorting more would delay the default isovalue in
/// the panel, fewer could miss small regions. Chosen by experiment.
constexpr vtkIdType mostLookedAt = 1'000'000;

/// About the number of cells of a rank in which derivatives are taken: some 10 microseconds each.
constexpr vtkIdType mostCells = 10'000;

using Samples = std::vector<std::pair<double, double>>;

double weightOf(const Samples& samples)
{
  double all = 0.0;
  for (const auto& sample : samples)
  {
    all += sample.second;
  }
  return all;
}

/// Quantiles of sorted samples with weights, for shares that rise. The samples lie side by side on a line, each as long
/// as its weight; share 0 is the middle of the first, share 1 that of the last.
class RisingQuantiles
{
public:
  explicit RisingQuantiles(const Samples& sorted)
    : Sorted(sorted)
    , First(0.5 * sorted.front().second)
    , Length(weightOf(sorted) - First - 0.5 * sorted.back().second)
  {
  }

  double At(double share)
  {
    const double wanted = this->First + share * this->Length;
    while (this->Next + 1 < this->Sorted.size() &&
      this->Passed + this->Sorted[this->Next].second <= wanted)
    {
      this->Passed += this->Sorted[this->Next++].second;
    }
    return this->Sorted[this->Next].first;
  }

private:
  const Samples& Sorted;
  double First;
  double Length;
  double Passed = 0.0;
  std::size_t Next = 0;
};

} // namespace

vtkStandardNewMacro(vtkPVQuantileInformation);

vtkPVQuantileInformation::vtkPVQuantileInformation() = default;
vtkPVQuantileInformation::~vtkPVQuantileInformation() = default;

/// Adds every step-th value of the component if it is finite; of the magnitude where there is no such component.
void vtkPVQuantileInformation::AddValues(
  vtkDataArray* array, vtkDataArray* spacings, vtkIdType step)
{
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); i += step)
  {
    const double value = ComponentValue(array, i, this->Component);
    const double spacing = spacings ? spacings->GetComponent(i, 0) : 1.0;
    if (std::isfinite(value) && std::isfinite(spacing) && spacing > 0.0)
    {
      this->Samples.emplace_back(value, spacing * spacing);
    }
  }
}

/// Adds values in the middles of cells.
void vtkPVQuantileInformation::AddDerived(vtkDataObject* data)
{
  const std::vector<vtkDataSet*> blocks = vtkCompositeDataSet::GetDataSets<vtkDataSet>(data);
  vtkIdType size = 0;
  for (vtkDataSet* block : blocks)
  {
    size += block->GetNumberOfCells();
  }
  const long long step = 1 + (size - 1) / mostCells;
  for (vtkDataSet* block : blocks)
  {
    vtkDataArray* array = block->GetPointData()->GetArray(this->ArrayName.c_str());
    std::vector<double> values;
    if (this->Quantity == vtkHighOrderParticleIsosurface::EXPRESSION)
    {
      values = hop::sampleExpression(block, this->Expression, step);
    }
    else if (array && array->GetNumberOfTuples() >= block->GetNumberOfPoints())
    {
      values = hop::sampleDerived(block, array, this->Component, this->Quantity, step);
    }
    for (const double value : values)
    {
      this->Samples.emplace_back(value, 1.0);
    }
  }
}

/// Leaves evenly spaced quantiles of the samples, each with the same part of their weight.
void vtkPVQuantileInformation::ThinOut()
{
  if (this->Samples.empty())
  {
    return;
  }
  std::sort(this->Samples.begin(), this->Samples.end());
  const std::size_t count = std::min(this->Samples.size(), mostSamples);
  const double weight = weightOf(this->Samples) / static_cast<double>(count);
  RisingQuantiles quantiles(this->Samples);
  std::vector<std::pair<double, double>> left;
  for (std::size_t n = 0; n < count; ++n)
  {
    const double share = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0.0;
    left.emplace_back(quantiles.At(share), weight);
  }
  this->Samples = std::move(left);
}

void vtkPVQuantileInformation::CopyFromObject(vtkObject* object)
{
  this->Samples.clear();
  auto* algorithm = vtkAlgorithm::SafeDownCast(object);
  if (!algorithm || this->Port >= algorithm->GetNumberOfOutputPorts())
  {
    return;
  }
  vtkDataObject* data = algorithm->GetOutputDataObject(this->Port);
  std::vector<vtkPointData*> blocks;
  vtkIdType size = 0;
  if (this->Quantity != 0)
  {
    this->AddDerived(data);
    this->ThinOut();
    return;
  }
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets<vtkDataSet>(data))
  {
    if (vtkDataArray* array = block->GetPointData()->GetArray(this->ArrayName.c_str()))
    {
      blocks.push_back(block->GetPointData());
      size += array->GetNumberOfTuples();
    }
  }
  for (vtkPointData* block : blocks)
  {
    this->AddValues(block->GetArray(this->ArrayName.c_str()),
      block->GetArray(this->SpacingArrayName.c_str()), 1 + (size - 1) / mostLookedAt);
  }
  this->ThinOut();
}

void vtkPVQuantileInformation::AddInformation(vtkPVInformation* information)
{
  if (auto* other = vtkPVQuantileInformation::SafeDownCast(information))
  {
    this->Samples.insert(this->Samples.end(), other->Samples.begin(), other->Samples.end());
  }
}

double vtkPVQuantileInformation::GetQuantile(double share)
{
  std::sort(this->Samples.begin(), this->Samples.end());
  return RisingQuantiles(this->Samples).At(share);
}

void vtkPVQuantileInformation::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply;
  for (const auto& [value, weight] : this->Samples)
  {
    *stream << value << weight;
  }
  *stream << vtkClientServerStream::End;
}

void vtkPVQuantileInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  this->Samples.clear();
  double value = 0.0;
  double weight = 0.0;
  for (int argument = 0;
       stream->GetArgument(0, argument, &value) && stream->GetArgument(0, argument + 1, &weight);
       argument += 2)
  {
    this->Samples.emplace_back(value, weight);
  }
}

void vtkPVQuantileInformation::CopyParametersToStream(vtkMultiProcessStream& stream)
{
  stream << this->Port << this->ArrayName << this->SpacingArrayName << this->Component
         << this->Quantity << this->Expression;
}

void vtkPVQuantileInformation::CopyParametersFromStream(vtkMultiProcessStream& stream)
{
  stream >> this->Port >> this->ArrayName >> this->SpacingArrayName >> this->Component >>
    this->Quantity >> this->Expression;
}

void vtkPVQuantileInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Port: " << this->Port << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "SpacingArrayName: " << this->SpacingArrayName << "\n";
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "Quantity: " << this->Quantity << "\n";
  os << indent << "Expression: " << this->Expression << "\n";
  os << indent << "Samples: " << this->Samples.size() << "\n";
}
