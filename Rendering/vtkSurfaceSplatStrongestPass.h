/**
 * @class vtkSurfaceSplatStrongestPass
 * @brief third pass, where colours must not be mixed or particles are selected: the particle that counts
 *        most at a pixel
 */

#ifndef vtkSurfaceSplatStrongestPass_h
#define vtkSurfaceSplatStrongestPass_h

#include "vtkSurfaceSplatPass.h"

class vtkSurfaceSplatVisibilityPass;

class vtkSurfaceSplatStrongestPass : public vtkSurfaceSplatPass
{
public:
  vtkSurfaceSplatStrongestPass(vtkSurfaceSplatSide side, vtkSurfaceSplatVisibilityPass& visibility);
  ~vtkSurfaceSplatStrongestPass() override;

  /** True, and nothing done, where it is not asked for. */
  bool Prepare(const vtkSurfaceSplatDrawing& drawing) override;
  void Draw(const vtkSurfaceSplatDrawing& drawing, vtkSurfaceSplatPrimitives& primitives) override;

private:
  vtkSurfaceSplatVisibilityPass& Visibility;
  vtkNew<vtkTextureObject> Number; // of the particle, from 1 on
};

#endif
