#include "vtkSMParticleDisplayHelper.h"

#include "ParticleData.h"
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
    if (input && input->GetNumberOfProxies() > 0 && hop::isParticles(hop::dataOf(input)))
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
  vtkPVDataInformation* data = input ? hop::dataOf(input) : nullptr;
  if (!data || !kind)
  {
    return;
  }
  if (kind->GetMTime() <= initializationTimeStamp && hop::isParticles(data))
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
