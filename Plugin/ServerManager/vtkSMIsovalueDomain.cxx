#include "vtkSMIsovalueDomain.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVQuantileInformation.h"
#include "vtkProcessModule.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

vtkStandardNewMacro(vtkSMIsovalueDomain);

vtkSMIsovalueDomain::vtkSMIsovalueDomain() = default;
vtkSMIsovalueDomain::~vtkSMIsovalueDomain() = default;

int vtkSMIsovalueDomain::SetDefaultValues(vtkSMProperty* property, bool useUnchecked)
{
  // Share of the values that is left out at either end. Larger shares hide small regions of extreme values, smaller
  // ones let a few wrong values decide. Chosen by experiment.
  constexpr double leftOut = 0.01;
  vtkNew<vtkPVQuantileInformation> values;
  this->LookAtValues(values);
  if (!values->HasValues())
  {
    return this->Superclass::SetDefaultValues(property, useUnchecked);
  }
  const double isovalue = 0.5 * (values->GetQuantile(leftOut) + values->GetQuantile(1.0 - leftOut));
  vtkSMPropertyHelper isovalues(property);
  isovalues.SetUseUnchecked(useUnchecked);
  isovalues.SetNumberOfElements(1);
  isovalues.Set(0, isovalue);
  return 1;
}

/// Gathers the values of the chosen array. Where every MPI rank runs the same script nothing is gathered: each rank
/// would see only its own values and choose another isovalue.
void vtkSMIsovalueDomain::LookAtValues(vtkPVQuantileInformation* values)
{
  vtkSMUncheckedPropertyHelper input(this->GetRequiredProperty("Input"));
  vtkSMUncheckedPropertyHelper choice(this->GetRequiredProperty("ArraySelection"));
  vtkSMUncheckedPropertyHelper component(this->GetRequiredProperty("ComponentSelection"));
  vtkSMSourceProxy* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(0)) : nullptr;
  const char* array = choice.GetInputArrayNameToProcess();
  if (!source || !array || vtkProcessModule::GetProcessModule()->GetSymmetricMPIMode())
  {
    return;
  }
  values->SetPort(static_cast<int>(input.GetOutputPort(0)));
  values->SetArrayName(array);
  values->SetComponent(component.GetAsInt());
  source->GatherInformation(values);
}
