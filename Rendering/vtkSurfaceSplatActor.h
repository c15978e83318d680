/**
 * @class vtkSurfaceSplatActor
 * @brief an actor of vtkSurfaceSplatMapper whose sides may differ in opacity
 *
 * A vtkActor is opaque or translucent by its property alone. This actor asks its backface property as well, so that an
 * opaque side is drawn in the renderer's opaque pass and a translucent one in its translucent pass.
 */

#ifndef vtkSurfaceSplatActor_h
#define vtkSurfaceSplatActor_h

#include "vtkHighOrderParticleRenderingModule.h" // for export macro
#include "vtkOpenGLActor.h"

class VTKHIGHORDERPARTICLERENDERING_EXPORT vtkSurfaceSplatActor : public vtkOpenGLActor
{
public:
  static vtkSurfaceSplatActor* New();
  vtkTypeMacro(vtkSurfaceSplatActor, vtkOpenGLActor);

  ///@{
  /** Whether one of the sides, or some of the particles, are opaque or translucent. */
  vtkTypeBool HasOpaqueGeometry() override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override;
  ///@}

protected:
  vtkSurfaceSplatActor() = default;
  ~vtkSurfaceSplatActor() override = default;

private:
  vtkSurfaceSplatActor(const vtkSurfaceSplatActor&) = delete;
  void operator=(const vtkSurfaceSplatActor&) = delete;
};

#endif
