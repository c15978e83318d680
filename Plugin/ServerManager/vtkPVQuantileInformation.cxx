#include "vtkPVQuantileInformation.h"

#include "vtkAlgorithm.h"
#include "vtkClientServerStream.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkMultiProcessStream.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

namespace
{

/// Values that a rank sends at most: one for each thousandth, with both ends. More make quantiles of several ranks more
/// exact, fewer coarser.
constexpr std::size_t mostSamples = 1001;

/// About the number of values that a rank looks at in longer arrays: sorting more would delay the default isovalue in
/// the panel, fewer could miss small regions. Chosen by experiment.
constexpr vtkIdType mostLookedAt = 1'000'000;

} // namespace

vtkStandardNewMacro(vtkPVQuantileInformation);

vtkPVQuantileInformation::vtkPVQuantileInformation() = default;
vtkPVQuantileInformation::~vtkPVQuantileInformation() = default;

/// Adds every step-th value of the component if it is finite; of the magnitude where there is no such component.
void vtkPVQuantileInformation::AddValues(
  vtkDataArray* array, vtkIdType step, std::vector<double>& values) const
{
  const int components = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); i += step)
  {
    double value = 0.0;
    if (components == 1 || this->Component < components)
    {
      value = array->GetComponent(i, components == 1 ? 0 : this->Component);
    }
    else
    {
      for (int c = 0; c < components; ++c)
      {
        value = std::hypot(value, array->GetComponent(i, c));
      }
    }
    if (std::isfinite(value))
    {
      values.push_back(value);
    }
  }
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
  std::vector<vtkDataArray*> arrays;
  vtkIdType size = 0;
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets<vtkDataSet>(data))
  {
    if (vtkDataArray* array = block->GetPointData()->GetArray(this->ArrayName.c_str()))
    {
      arrays.push_back(array);
      size += array->GetNumberOfTuples();
    }
  }
  std::vector<double> values;
  for (vtkDataArray* array : arrays)
  {
    this->AddValues(array, 1 + (size - 1) / mostLookedAt, values);
  }
  std::sort(values.begin(), values.end());
  const std::size_t count = std::min(values.size(), mostSamples);
  const double last = static_cast<double>(values.size()) - 1.0;
  for (std::size_t n = 0; n < count; ++n)
  {
    const double share = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0.0;
    this->Samples.emplace_back(
      values[std::lround(share * last)], static_cast<double>(values.size()) / count);
  }
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
  double all = 0.0;
  for (const auto& sample : this->Samples)
  {
    all += sample.second;
  }
  // Each sample stands in the middle of its weight: of n samples with equal weights, number share * (n - 1) is wanted.
  const double wanted = share * all * (1.0 - 1.0 / static_cast<double>(this->Samples.size()));
  double passed = 0.0;
  for (const auto& [value, weight] : this->Samples)
  {
    if (wanted < passed + 0.5 * weight)
    {
      return value;
    }
    passed += weight;
  }
  return this->Samples.back().first;
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
  stream << this->Port << this->ArrayName << this->Component;
}

void vtkPVQuantileInformation::CopyParametersFromStream(vtkMultiProcessStream& stream)
{
  stream >> this->Port >> this->ArrayName >> this->Component;
}

void vtkPVQuantileInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Port: " << this->Port << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "Samples: " << this->Samples.size() << "\n";
}
