#include "vtkSMParticleExportHelper.h"

#include "ParticleData.h"
#include "vtkObjectFactory.h"
#include "vtkPythonInterpreter.h"
#include "vtkSMExporterProxy.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMViewProxy.h"

#include <string>

namespace
{

/// Whether a view shows something as splats.
bool showsSplats(vtkSMProxy* view)
{
  const vtkSMPropertyHelper shown(view, "Representations", /*quiet=*/true);
  for (unsigned int i = 0; i < shown.GetNumberOfElements(); ++i)
  {
    vtkSMProxy* representation = shown.GetAsProxy(i);
    const vtkSMPropertyHelper kind(representation, "Representation", /*quiet=*/true);
    const vtkSMPropertyHelper visible(representation, "Visibility", /*quiet=*/true);
    const char* name = kind.GetNumberOfElements() > 0 ? kind.GetAsString() : nullptr;
    if (name && std::string(name).rfind("Surface Splats", 0) == 0 && visible.GetAsInt() != 0)
    {
      return true;
    }
  }
  return false;
}

/// Lets Python know the representation. ParaView's export for VTK.js asks every representation for its actor in Python,
/// and ends with an error where Python knows nothing but a base class without actors.
void tellPython()
{
  vtkPythonInterpreter::RunSimpleString(
    "try:\n"
    "  __import__('highorderparticles.vtkHighOrderParticleRepresentation')\n"
    "except ImportError:\n"
    "  pass\n");
}

} // namespace

vtkStandardNewMacro(vtkSMParticleExportHelper);

vtkSMParticleExportHelper::vtkSMParticleExportHelper() = default;
vtkSMParticleExportHelper::~vtkSMParticleExportHelper() = default;

void vtkSMParticleExportHelper::PostInitializeProxy(
  vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType)
{
  if (auto* exporter = vtkSMExporterProxy::SafeDownCast(proxy))
  {
    if (exporter->GetView() && showsSplats(exporter->GetView()))
    {
      tellPython();
      const bool hasPoints = std::string(exporter->GetXMLName()) != "POVExporter";
      vtkWarningMacro("The exported scene "
        << (hasPoints ? "has the particles of Surface Splats as points"
                      : "leaves out the particles of Surface Splats, as it holds triangles alone")
        << ". For a surface in it show the filter with Output Type Triangles.");
    }
    return;
  }
  vtkSMProperty* input = proxy->GetProperty("Input");
  if (input && hop::isParticles(hop::dataOf(input)))
  {
    vtkWarningMacro(
      "An STL file holds triangles, and particles have none: it will be empty. Choose "
      "Output Type Triangles in the filter, or write a PLY or VTP file, which hold points with "
      "normals.");
  }
}
