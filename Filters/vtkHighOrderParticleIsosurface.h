#ifndef vtkHighOrderParticleIsosurface_h
#define vtkHighOrderParticleIsosurface_h
#include "vtkHighOrderParticleFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"
class VTKHIGHORDERPARTICLEFILTERS_EXPORT vtkHighOrderParticleIsosurface : public vtkPolyDataAlgorithm
{
public:
  static vtkHighOrderParticleIsosurface* New();
  vtkTypeMacro(vtkHighOrderParticleIsosurface, vtkPolyDataAlgorithm);
};
#endif
