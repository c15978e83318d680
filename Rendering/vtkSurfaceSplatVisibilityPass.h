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

  /**
   * Draws for another pass, by a style whose program can look up what is seen. Whatever passes the depth test
   * is of the surface that is seen, as thick as splats are wide.
   */
  void DrawBy(const vtkSurfaceSplatDrawing& drawing, vtkSurfaceSplatPrimitives& primitives,
    vtkSurfaceSplatPrimitives::Style style);

private:
  /**
   * How thick a surface is, away from the eye, in radii. One sheet is pushed back by it in this pass. Of several
   * the wider splats would fall behind the narrower ones of a sheet farther away, so that this pass leaves them
   * where they are, and the others pull them.
   */
  double GetThickness() const;

  // r: 1 where there is surface; g: number of its sheet, and 128 more where it is seen from outward, in 255ths
  vtkNew<vtkTextureObject> Seen;
};

#endif
