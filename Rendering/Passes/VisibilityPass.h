/**
 * @class VisibilityPass
 * @brief first pass: where there is surface, from which side it is seen, and what hides what
 */

#pragma once

#include "Drawing/SplatPrimitives.h"
#include "Passes/SplatPass.h"

namespace hop
{
class VisibilityPass : public SplatPass
{
public:
  explicit VisibilityPass(LayerSide side);
  ~VisibilityPass() override;

  bool Prepare(const SplatDrawing& drawing) override;
  void Draw(const SplatDrawing& drawing, SplatPrimitives& primitives) override;

  /** Copies the depth of what is seen into the framebuffer that is bound for drawing. */
  void CopyDepth(const SplatDrawing& drawing) const;

  /**
   * Draws for another pass, by a style whose program can look up what is seen. Whatever passes the depth test
   * is of the surface that is seen, as thick as splats are wide.
   */
  void DrawBy(
    const SplatDrawing& drawing, SplatPrimitives& primitives, SplatPrimitives::Style style);

private:
  /**
   * How thick a surface is, away from the eye, in radii. One isovalue is pushed back by it in this pass. Of several
   * the wider splats would fall behind the narrower ones of a isovalue farther away, so that this pass leaves them
   * where they are, and the others pull them.
   */
  double GetThickness() const;

  // r: 1 where there is surface; g: number of its isovalue, and 128 more where it is seen from outward, in 255ths
  vtkNew<vtkTextureObject> Seen;
};
}
