/**
 * @class vtkSurfaceSplatVisibilityPass
 * @brief first pass: where there is surface, from which side it is seen, and what hides what
 */

#ifndef vtkSurfaceSplatVisibilityPass_h
#define vtkSurfaceSplatVisibilityPass_h

#include "vtkSurfaceSplatPass.h"
#include "vtkSurfaceSplatPrimitives.h"

class vtkSurfaceSplatVisibilityPass : public vtkSurfaceSplatPass
{
public:
  explicit vtkSurfaceSplatVisibilityPass(vtkSurfaceSplatSide side);
  ~vtkSurfaceSplatVisibilityPass() override;

  bool Prepare(const vtkSurfaceSplatDrawing& drawing) override;
  void Draw(const vtkSurfaceSplatDrawing& drawing, vtkSurfaceSplatPrimitives& primitives) override;

  /** Copies the depth of what is seen into the framebuffer that is bound for drawing. */
  void CopyDepth(const vtkSurfaceSplatDrawing& drawing) const;

  /** Draws for another pass, by a style whose program can look up what is seen. */
  void DrawBy(const vtkSurfaceSplatDrawing& drawing, vtkSurfaceSplatPrimitives& primitives,
    const vtkSurfaceSplatPrimitives::Style& style);

private:
  vtkNew<vtkTextureObject> Seen; // r: 1 where there is surface; g: 1 where it is seen from outward
};

#endif
