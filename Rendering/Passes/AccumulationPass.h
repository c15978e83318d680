/**
 * @class AccumulationPass
 * @brief second pass: weighted sums of what the splats of the surface that is seen know of it
 */

#pragma once

#include "Passes/SplatPass.h"

namespace hop
{
class VisibilityPass;

class AccumulationPass : public SplatPass
{
public:
  AccumulationPass(LayerSide side, VisibilityPass& visibility);
  ~AccumulationPass() override;

  bool Prepare(const SplatDrawing& drawing) override;
  void Draw(const SplatDrawing& drawing, SplatPrimitives& primitives) override;

private:
  VisibilityPass& Visibility;
  vtkNew<vtkTextureObject> NormalWeight; // sums of weight * normal, weight
  vtkNew<vtkTextureObject> OffsetDepth;  // sums of weight * offset from the particle, weight * z
  vtkNew<vtkTextureObject> ColorSum;     // sums of weight * colour or lookup coordinates
};
}
