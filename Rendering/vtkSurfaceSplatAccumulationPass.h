/**
 * @class vtkSurfaceSplatAccumulationPass
 * @brief second pass: weighted sums of what the splats of the surface that is seen know of it
 */

#ifndef vtkSurfaceSplatAccumulationPass_h
#define vtkSurfaceSplatAccumulationPass_h

#include "vtkSurfaceSplatPass.h"

class vtkSurfaceSplatVisibilityPass;

class vtkSurfaceSplatAccumulationPass : public vtkSurfaceSplatPass
{
public:
  vtkSurfaceSplatAccumulationPass(
    vtkSurfaceSplatSide side, vtkSurfaceSplatVisibilityPass& visibility);
  ~vtkSurfaceSplatAccumulationPass() override;

  bool Prepare(const vtkSurfaceSplatDrawing& drawing) override;
  void Draw(const vtkSurfaceSplatDrawing& drawing, vtkSurfaceSplatPrimitives& primitives) override;

private:
  vtkSurfaceSplatVisibilityPass& Visibility;
  vtkNew<vtkTextureObject> NormalWeight; // sums of weight * normal, weight
  vtkNew<vtkTextureObject> OffsetDepth;  // sums of weight * offset from the particle, weight * z
  vtkNew<vtkTextureObject> ColorSum;     // sums of weight * colour or lookup coordinates
};

#endif
