#include "ParticleData.h"

#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

namespace
{

bool hasArray(vtkPVDataInformation* data, const char* name, int components)
{
  vtkPVArrayInformation* array = data->GetArrayInformation(name, vtkDataObject::POINT);
  return array && array->GetNumberOfComponents() == components;
}

} // namespace

bool hop::isParticles(vtkPVDataInformation* data)
{
  return data && data->GetNumberOfPoints() > 0 &&
    data->GetNumberOfCells() == data->GetNumberOfPoints() && hasArray(data, "Normals", 3) &&
    hasArray(data, "Radius", 1) && hasArray(data, "Isovalue", 1);
}

vtkPVDataInformation* hop::dataOf(vtkSMProperty* input)
{
  const vtkSMPropertyHelper helper(input);
  auto* source = vtkSMSourceProxy::SafeDownCast(helper.GetAsProxy());
  return source ? source->GetDataInformation(helper.GetOutputPort()) : nullptr;
}
