/**
 * @class StrongestPass
 * @brief third pass, where colours must not be mixed or particles are selected: the number of the particle with the
 *        largest weight at each pixel
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

  /** Does nothing and returns true if the drawing does not ask for strongest particles. */
  bool Prepare(const SplatDrawing& drawing) override;
  void Draw(const SplatDrawing& drawing, SplatPrimitives& primitives) override;

private:
  VisibilityPass& Visibility;
  vtkNew<vtkTextureObject> Number; // of the particle, from 1 on
};
}
