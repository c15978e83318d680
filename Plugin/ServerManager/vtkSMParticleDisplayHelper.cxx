#include "vtkSMParticleDisplayHelper.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMInputProperty.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"

namespace
{
bool HasArray(vtkPVDataInformation* data, const char* name, int components)
{
  vtkPVArrayInformation* array = data->GetArrayInformation(name, vtkDataObject::POINT);
  return array && array->GetNumberOfComponents() == components;
}

bool IsParticles(vtkPVDataInformation* data)
{
  return data && data->GetNumberOfPoints() > 0 &&
    data->GetNumberOfCells() == data->GetNumberOfPoints() && HasArray(data, "Normals", 3) &&
    HasArray(data, "Radius", 1) && HasArray(data, "Isovalue", 1);
}

vtkPVDataInformation* DataOf(vtkSMProperty* input)
{
  const vtkSMPropertyHelper helper(input);
  auto* source = vtkSMSourceProxy::SafeDownCast(helper.GetAsProxy());
  return source ? source->GetDataInformation(helper.GetOutputPort()) : nullptr;
}

// No points, or a probe's points of which none lies in a cell.
bool IsNothing(vtkPVDataInformation* data)
{
  vtkPVArrayInformation* found =
    data->GetArrayInformation("vtkValidPointMask", vtkDataObject::POINT);
  return data->GetNumberOfPoints() == 0 || (found && found->GetComponentRange(0)[1] <= 0.);
}

bool HasParticlesAsInput(vtkSMProxy* filter)
{
  vtkSmartPointer<vtkSMPropertyIterator> properties;
  properties.TakeReference(filter->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    auto* input = vtkSMInputProperty::SafeDownCast(properties->GetProperty());
    if (input && input->GetNumberOfProxies() > 0 && IsParticles(DataOf(input)))
    {
      return true;
    }
  }
  return false;
}
}

vtkStandardNewMacro(vtkSMParticleDisplayHelper);

vtkSMParticleDisplayHelper::vtkSMParticleDisplayHelper() = default;
vtkSMParticleDisplayHelper::~vtkSMParticleDisplayHelper() = default;

void vtkSMParticleDisplayHelper::PostInitializeProxy(
  vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType initializationTimeStamp)
{
  vtkSMProperty* input = proxy->GetProperty("Input");
  vtkSMProperty* kind = proxy->GetProperty("Representation");
  vtkPVDataInformation* data = input ? DataOf(input) : nullptr;
  if (!data || !kind)
  {
    return;
  }
  if (kind->GetMTime() <= initializationTimeStamp && IsParticles(data))
  {
    // ParaView leaves properties alone that were set here.
    vtkSMPropertyHelper(kind).Set("Surface Splats");
    proxy->UpdateVTKObjects();
  }
  vtkSMProxy* filter = vtkSMPropertyHelper(input).GetAsProxy();
  if (IsNothing(data) && HasParticlesAsInput(filter))
  {
    vtkWarningMacro(<< filter->GetXMLLabel()
                    << " found nothing in particles, which are points without cells around "
                    << "them: use filters that look for cells or cut them (Plot Over Line, Probe, "
                       "Resample, Slice, "
                    << "Contour) on the grid.");
  }
}
