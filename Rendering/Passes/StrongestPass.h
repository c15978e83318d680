/**
 * @class StrongestPass
 * @brief third pass, where colours must not be mixed or particles are selected: the particle that counts
 *        most at a pixel
 */

#pragma once

#include "Passes/SplatPass.h"

namespace hop
{
class VisibilityPass;

class StrongestPass : public SplatPass
{
public:
  StrongestPass(LayerSide side, VisibilityPass& visibility);
  ~StrongestPass() override;

  /** True, and nothing done, where it is not asked for. */
  bool Prepare(const SplatDrawing& drawing) override;
  void Draw(const SplatDrawing& drawing, SplatPrimitives& primitives) override;

private:
  VisibilityPass& Visibility;
  vtkNew<vtkTextureObject> Number; // of the particle, from 1 on
};
}
