/**
 * @class AccumulationPass
 * @brief second pass: weighted sums of normal, offset, depth and colour of the visible surface's splats
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
  vtkNew<vtkTextureObject>
    BorderSum;          // sums of the weight that colours have, this weight * coverage by edges
  int NumberOfSums = 0; // that are drawn
};
}
