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
   * Draws for another pass, by a style whose program can look up what is seen. Splats that pass the depth test belong
   * to the surface that is seen, which is taken to be as thick as splats are wide.
   */
  void DrawBy(
    const SplatDrawing& drawing, SplatPrimitives& primitives, SplatPrimitives::Style style);

private:
  /**
   * How thick a surface is, away from the eye, in radii; negative for the back layer. This pass pushes splats back by
   * it if there is one isovalue. Of several isovalues, wide splats of one would fall behind narrow splats of another
   * that lies farther away: so this pass leaves them in their places, and the later passes pull them by the same
   * length.
   */
  double GetThickness() const;

  // r: 1 where there is surface; g: number of its isovalue, plus 128 where it is seen from outward, in 255ths
  vtkNew<vtkTextureObject> Seen;
};
}
