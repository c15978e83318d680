/**
 * @class vtkSMParticleExportHelper
 * @brief says what to do before particles are written in a format that has no place for them
 *
 * STL files hold triangles, and particles have none; scenes that are exported hold them as bare points. In XML, among the
 * hints of a writer or an exporter: `<InitializationHelper class="vtkSMParticleExportHelper"/>`.
 */
#ifndef vtkSMParticleExportHelper_h
#define vtkSMParticleExportHelper_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMProxyInitializationHelper.h"

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkSMParticleExportHelper
  : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMParticleExportHelper* New();
  vtkTypeMacro(vtkSMParticleExportHelper, vtkSMProxyInitializationHelper);

  /**
   * Warns in one line where the input of a writer is particles, or the view of an exporter shows splats.
   */
  void PostInitializeProxy(
    vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMParticleExportHelper();
  ~vtkSMParticleExportHelper() override;

private:
  vtkSMParticleExportHelper(const vtkSMParticleExportHelper&) = delete;
  void operator=(const vtkSMParticleExportHelper&) = delete;
};

#endif
