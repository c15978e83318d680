#ifndef vtkSurfaceSplatMapper_h
#define vtkSurfaceSplatMapper_h
#include "vtkHighOrderParticleRenderingModule.h"
#include "vtkOpenGLPolyDataMapper.h"
class VTKHIGHORDERPARTICLERENDERING_EXPORT vtkSurfaceSplatMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkSurfaceSplatMapper* New();
  vtkTypeMacro(vtkSurfaceSplatMapper, vtkOpenGLPolyDataMapper);
};
#endif
