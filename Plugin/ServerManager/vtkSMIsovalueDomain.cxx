#include "vtkSMIsovalueDomain.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

/// Adds the finite values of an array's component, or magnitudes where there is no such component.
void addValues(vtkDataArray* array, int component, std::vector<double>& values)
{
  const int components = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    double value = 0.0;
    if (components == 1 || component < components)
    {
      value = array->GetComponent(i, components == 1 ? 0 : component);
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

/// The value below which that share of all values lies.
/// \pre there are values
double quantile(std::vector<double>& values, double share)
{
  const auto nth = values.begin() +
    static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

} // namespace

vtkStandardNewMacro(vtkSMIsovalueDomain);

vtkSMIsovalueDomain::vtkSMIsovalueDomain() = default;
vtkSMIsovalueDomain::~vtkSMIsovalueDomain() = default;

int vtkSMIsovalueDomain::SetDefaultValues(vtkSMProperty* property, bool useUnchecked)
{
  constexpr double leftOut = 0.01; // at either end
  std::vector<double> values = this->NodalValues();
  if (values.empty())
  {
    return this->Superclass::SetDefaultValues(property, useUnchecked);
  }
  const double isovalue = 0.5 * (quantile(values, leftOut) + quantile(values, 1.0 - leftOut));
  vtkSMPropertyHelper isovalues(property);
  isovalues.SetUseUnchecked(useUnchecked);
  isovalues.SetNumberOfElements(1);
  isovalues.Set(0, isovalue);
  return 1;
}

/// The values of the chosen array, if they are in this process and all of them are.
std::vector<double> vtkSMIsovalueDomain::NodalValues()
{
  vtkSMUncheckedPropertyHelper input(this->GetRequiredProperty("Input"));
  vtkSMUncheckedPropertyHelper choice(this->GetRequiredProperty("ArraySelection"));
  vtkSMUncheckedPropertyHelper component(this->GetRequiredProperty("ComponentSelection"));
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  vtkSMSourceProxy* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(0)) : nullptr;
  auto* algorithm = vtkAlgorithm::SafeDownCast(source ? source->GetClientSideObject() : nullptr);
  if (!algorithm || (ranks && ranks->GetNumberOfProcesses() > 1))
  {
    return {};
  }
  vtkDataObject* data = algorithm->GetOutputDataObject(static_cast<int>(input.GetOutputPort(0)));
  const std::string name = choice.GetInputArrayNameToProcess();
  std::vector<double> values;
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets<vtkDataSet>(data))
  {
    if (vtkDataArray* array = block->GetPointData()->GetArray(name.c_str()))
    {
      addValues(array, component.GetAsInt(), values);
    }
  }
  return values;
}
