#include "vtkSMSurfaceSplatRepresentationProxy.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVQuantileInformation.h"
#include "vtkProcessModule.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionProxy.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

/// The source that a representation draws, and its port; nullptr where there is none.
vtkSMSourceProxy* drawnBy(vtkSMProxy* representation, unsigned int& port)
{
  vtkSMPropertyHelper input(representation, "Input");
  port = input.GetNumberOfElements() > 0 ? input.GetOutputPort() : 0;
  return input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy())
                                         : nullptr;
}

/// The point array of curvatures by which a representation colours; empty where it colours by something else.
std::string curvatureOf(vtkSMProxy* representation)
{
  vtkSMPropertyHelper choice(representation, "ColorArrayName");
  const char* chosen = choice.GetInputArrayNameToProcess();
  const std::string name = chosen ? chosen : "";
  const bool isCurvature = name == "Mean_Curvature" || name == "Gauss_Curvature";
  return isCurvature && choice.GetInputArrayAssociation() == vtkDataObject::POINT ? name : "";
}

/// A value of the lookup tables' property AutomaticRescaleRangeMode, as its enumeration numbers it.
constexpr int never = -1;

/// Whether ParaView may change the range of a lookup table by itself.
bool mayRescale(vtkSMProxy* table)
{
  return vtkSMPropertyHelper(table, "AutomaticRescaleRangeMode", true).GetAsInt() != never;
}

} // namespace

vtkStandardNewMacro(vtkSMSurfaceSplatRepresentationProxy);

vtkSMSurfaceSplatRepresentationProxy::vtkSMSurfaceSplatRepresentationProxy() = default;

vtkSMSurfaceSplatRepresentationProxy::~vtkSMSurfaceSplatRepresentationProxy()
{
  this->Watch(nullptr);
}

void vtkSMSurfaceSplatRepresentationProxy::UpdateVTKObjects()
{
  this->Superclass::UpdateVTKObjects();
  vtkSMPropertyHelper table(this, "LookupTable", true);
  vtkSMProxy* chosen = table.GetNumberOfElements() > 0 ? table.GetAsProxy() : nullptr;
  if (chosen != this->Table)
  {
    this->Watch(chosen);
  }
}

void vtkSMSurfaceSplatRepresentationProxy::ViewUpdated(vtkSMProxy* view)
{
  this->Superclass::ViewUpdated(view);
  this->IsFresh = false;
}

void vtkSMSurfaceSplatRepresentationProxy::Watch(vtkSMProxy* table)
{
  if (this->Table)
  {
    this->Table->RemoveObserver(this->Observer);
  }
  this->Table = table;
  this->IsFresh =
    table && (mayRescale(table) || !this->GetSessionProxyManager()->GetInLoadXMLState());
  if (table)
  {
    this->Observer = table->AddObserver(
      vtkCommand::PropertyModifiedEvent, this, &vtkSMSurfaceSplatRepresentationProxy::OnRange);
  }
}

/// Whether the lookup table has just received the range of all values of a curvature, and ParaView may change it.
bool vtkSMSurfaceSplatRepresentationProxy::HasRangeOfData()
{
  // Relative difference of ranges that are the same: the table's points are rounded when they are scaled.
  constexpr double rounding = 1e-6;
  const std::string name = curvatureOf(this);
  unsigned int port = 0;
  vtkSMSourceProxy* source = drawnBy(this, port);
  vtkPVArrayInformation* array = source && !name.empty()
    ? source->GetDataInformation(port)->GetArrayInformation(name.c_str(), vtkDataObject::POINT)
    : nullptr;
  double range[2];
  if (!array || !vtkSMTransferFunctionProxy::GetRange(this->Table, range) ||
    (!this->IsFresh && !mayRescale(this->Table)))
  {
    return false;
  }
  const double* all = array->GetComponentFiniteRange(0);
  const double slack = rounding * (all[1] - all[0]);
  return std::abs(range[0] - all[0]) <= slack && std::abs(range[1] - all[1]) <= slack;
}

void vtkSMSurfaceSplatRepresentationProxy::OnRange()
{
  // Share of the surface that is left out at either end. Larger: more of it has the colours of the ends; smaller: bends
  // along creases and edges decide. Chosen by pictures of real files.
  constexpr double leftOut = 0.02;
  if (vtkProcessModule::GetProcessModule()->GetSymmetricMPIMode() || !this->HasRangeOfData())
  {
    return;
  }
  unsigned int port = 0;
  vtkSMSourceProxy* source = drawnBy(this, port);
  vtkNew<vtkPVQuantileInformation> values;
  values->SetPort(static_cast<int>(port));
  values->SetArrayName(curvatureOf(this));
  values->SetSpacingArrayName("Radius");
  source->GatherInformation(values);
  // First, as the new range comes here again.
  vtkSMPropertyHelper(this->Table, "AutomaticRescaleRangeMode", true).Set(never);
  if (values->HasValues() && values->GetQuantile(leftOut) < values->GetQuantile(1.0 - leftOut))
  {
    vtkSMTransferFunctionProxy::RescaleTransferFunction(
      this->Table, values->GetQuantile(leftOut), values->GetQuantile(1.0 - leftOut));
  }
}
