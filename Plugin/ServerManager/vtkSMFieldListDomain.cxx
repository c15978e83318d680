#include "vtkSMFieldListDomain.h"

#include "vtkDataObject.h"
#include "vtkHighOrderParticleIsosurface.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <string>

namespace
{

bool isConstant(vtkPVArrayInformation* array)
{
  for (int component = 0; component < array->GetNumberOfComponents(); ++component)
  {
    const double* range = array->GetComponentRange(component);
    if (range[0] < range[1])
    {
      return false;
    }
  }
  return true;
}

/// Whether a point array looks like a field that has isosurfaces.
bool isField(vtkPVDataInformation* input, const std::string& name)
{
  vtkPVArrayInformation* array = input->GetArrayInformation(name.c_str(), vtkDataObject::POINT);
  if (!array || name == "RationalWeights" || name == "subdomain" ||
    vtkHighOrderParticleIsosurface::IsOwnPointArray(name.c_str()))
  {
    return false;
  }
  const int type = array->GetDataType();
  return (type == VTK_FLOAT || type == VTK_DOUBLE) && !isConstant(array);
}

} // namespace

vtkStandardNewMacro(vtkSMFieldListDomain);

vtkSMFieldListDomain::vtkSMFieldListDomain() = default;
vtkSMFieldListDomain::~vtkSMFieldListDomain() = default;

int vtkSMFieldListDomain::SetDefaultValues(vtkSMProperty* property, bool useUnchecked)
{
  // ParaView first connects a new filter to the active source, which may be particles, and then to the input that the
  // script names. Without a choice for the active source, the filter receives the default of the named input.
  vtkPVDataInformation* input = this->GetInputInformation();
  if (!input || !input->HasDataSetType(VTK_UNSTRUCTURED_GRID))
  {
    return 0;
  }
  const int isSet = this->Superclass::SetDefaultValues(property, useUnchecked);
  vtkSMPropertyHelper choice(property);
  choice.SetUseUnchecked(useUnchecked);
  if (!isSet || isField(input, choice.GetInputArrayNameToProcess()))
  {
    return isSet;
  }
  for (unsigned int i = 0; i < this->GetNumberOfStrings(); ++i)
  {
    if (this->GetDomainAssociation(i) == vtkDataObject::POINT && isField(input, this->GetString(i)))
    {
      choice.SetInputArrayToProcess(this->GetFieldAssociation(i), this->GetString(i));
      break;
    }
  }
  return isSet;
}

vtkPVDataInformation* vtkSMFieldListDomain::GetInputInformation()
{
  vtkSMUncheckedPropertyHelper input(this->GetRequiredProperty("Input"));
  vtkSMSourceProxy* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(0)) : nullptr;
  return source ? source->GetDataInformation(input.GetOutputPort(0)) : nullptr;
}
