/**
 * @class vtkSMSurfaceSplatRepresentationProxy
 * @brief a representation whose legends of curvature begin with a range that serves the surface seen
 *
 * ParaView's first range of a legend is that of all values. Near tips and crossings of the surface the curvature of a
 * few particles is large without bound, and everything else has one colour. Here the first range of a legend of
 * curvature leaves out the fiftieth of the surface's area with the lowest values and that with the highest, and
 * ParaView's automatic rescaling is switched off for this legend. Rescaling by hand, to the range of the data or to any other, works as for all legends.
 */
#ifndef vtkSMSurfaceSplatRepresentationProxy_h
#define vtkSMSurfaceSplatRepresentationProxy_h

#include "vtkHighOrderParticleServerManagerModule.h" // for the export macro
#include "vtkSMRepresentationProxy.h"
#include "vtkWeakPointer.h" // for the watched lookup table

class VTKHIGHORDERPARTICLESERVERMANAGER_EXPORT vtkSMSurfaceSplatRepresentationProxy
  : public vtkSMRepresentationProxy
{
public:
  static vtkSMSurfaceSplatRepresentationProxy* New();
  vtkTypeMacro(vtkSMSurfaceSplatRepresentationProxy, vtkSMRepresentationProxy);

  /**
   * Passes the properties on, and from then on waits for the first range of the chosen lookup table.
   */
  void UpdateVTKObjects() override;

  /**
   * From here on a rescaling is one that a user asked for. What comes before the first picture belongs to the choice of
   * the array: traces record it as a rescaling to the range of the data.
   */
  void ViewUpdated(vtkSMProxy* view) override;

protected:
  vtkSMSurfaceSplatRepresentationProxy();
  ~vtkSMSurfaceSplatRepresentationProxy() override;

private:
  vtkSMSurfaceSplatRepresentationProxy(const vtkSMSurfaceSplatRepresentationProxy&) = delete;
  void operator=(const vtkSMSurfaceSplatRepresentationProxy&) = delete;

  void Watch(vtkSMProxy* table);
  void OnRange();
  bool HasRangeOfData();

  vtkWeakPointer<vtkSMProxy> Table;
  unsigned long Observer = 0;
  /// Whether the table was chosen since the last picture, and not by a state that keeps its range.
  bool IsFresh = false;
};

#endif
