/**
 * @class vtkSMParticleDisplayHelper
 * @brief shows particles as 'Surface Splats' from the start, whatever made them
 *
 * *Clip*, *Threshold*, readers of files and others make particles of particles, and ParaView would show them as dots. In
 * XML, among the hints of a representation: `<InitializationHelper class="vtkSMParticleDisplayHelper"/>`.
 */
#ifndef vtkSMParticleDisplayHelper_h
#define vtkSMParticleDisplayHelper_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMProxyInitializationHelper.h"

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkSMParticleDisplayHelper
  : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMParticleDisplayHelper* New();
  vtkTypeMacro(vtkSMParticleDisplayHelper, vtkSMProxyInitializationHelper);

  /**
   * Chooses 'Surface Splats' where the input of the representation is particles, unless the user has chosen: points with
   * the arrays `Normals`, `Radius` and `Isovalue` and one cell each. Meshes have other numbers of cells. What this
   * project's filters give is shown by their property OutputType, also where it is empty. Warns where a filter
   * found nothing in particles, because it looks for cells.
   */
  void PostInitializeProxy(
    vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMParticleDisplayHelper();
  ~vtkSMParticleDisplayHelper() override;

private:
  vtkSMParticleDisplayHelper(const vtkSMParticleDisplayHelper&) = delete;
  void operator=(const vtkSMParticleDisplayHelper&) = delete;
};

#endif
