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

#include <set>
#include <string>

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

// Why nothing comes of particles, behind the name of the filter.
const char* WhyNothing(vtkSMProxy* filter)
{
  static const std::set<std::string> lookForCells = { "AdaptiveResampleToImage", "Contour", "Cut",
    "ProbeLine", "ProbePoint", "ResampleToImage", "ResampleWithDataset", "StreamTracer" };
  return lookForCells.count(filter->GetXMLName()) > 0
    ? " found nothing in particles, which are points without cells around them: use filters that "
      "look for cells or cut them (Plot Over Line, Probe, Resample, Slice, Contour) on the grid."
    : " left none of the particles: it chose none, or failed and said why.";
}

// How output is to be shown; nullptr where ParaView decides. Our own filters know it before they have any particles.
const char* KindFor(vtkSMProxy* source, vtkPVDataInformation* data)
{
  vtkSMProperty* type = source->GetProperty("OutputType");
  const std::string name = source->GetVTKClassName() ? source->GetVTKClassName() : "";
  if (type && name.rfind("vtkHighOrderParticle", 0) == 0)
  {
    return vtkSMPropertyHelper(type).GetAsInt() == 0 ? "Surface Splats" : "Surface";
  }
  return hop::isParticles(data) ? "Surface Splats" : nullptr;
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
  vtkSMProxy* filter = vtkSMPropertyHelper(input).GetAsProxy();
  const char* wanted = KindFor(filter, data);
  if (wanted && kind->GetMTime() <= initializationTimeStamp)
  {
    // ParaView leaves properties alone that were set here.
    vtkSMPropertyHelper(kind).Set(wanted);
    proxy->UpdateVTKObjects();
  }
  if (IsNothing(data) && HasParticlesAsInput(filter))
  {
    vtkWarningMacro(<< filter->GetXMLLabel() << WhyNothing(filter));
  }
}
