#include "vtkSMParticleDisplayHelper.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

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

vtkPVDataInformation* InputOf(vtkSMProxy* representation)
{
  if (!representation->GetProperty("Input"))
  {
    return nullptr;
  }
  const vtkSMPropertyHelper input(representation, "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  return source ? source->GetDataInformation(input.GetOutputPort()) : nullptr;
}
}

vtkStandardNewMacro(vtkSMParticleDisplayHelper);

vtkSMParticleDisplayHelper::vtkSMParticleDisplayHelper() = default;
vtkSMParticleDisplayHelper::~vtkSMParticleDisplayHelper() = default;

void vtkSMParticleDisplayHelper::PostInitializeProxy(
  vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType initializationTimeStamp)
{
  vtkSMProperty* kind = proxy->GetProperty("Representation");
  if (kind && kind->GetMTime() <= initializationTimeStamp && IsParticles(InputOf(proxy)))
  {
    vtkSMPropertyHelper(kind).Set(
      "Surface Splats"); // ParaView leaves properties alone that were set here
    proxy->UpdateVTKObjects();
  }
}
