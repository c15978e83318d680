/**
 * @class SplatLayer
 * @brief one layer of the splatted surface, as sums in textures: the first passes of the splatting
 *
 * The front layer is the surface that is seen first from the eye, the back layer the one that is seen last (the far
 * side of a closed surface); together they make translucent surfaces. Visibility and accumulation are the first two
 * passes of M. Botsch, A. Hornung, M. Zwicker, L. Kobbelt, *High-Quality Surface Splatting on Today's GPUs*, 2005; here
 * they draw into floating-point textures of the size of the viewport. The mapper does the third one, which resolves
 * the sums. Passes run only if something that they depend on has changed.
 */

#pragma once

#include "Drawing/SplatPrimitives.h"
#include "Passes/AccumulationPass.h"
#include "Passes/StrongestPass.h"
#include "Passes/VisibilityPass.h"

#include <array>
#include <vector>

class vtkShaderProgram;
class vtkWindow;

namespace hop
{
struct SplatDrawing;

class SplatLayer
{
public:
  explicit SplatLayer(LayerSide side);

  /** Brings the textures up to date. False if the driver cannot draw into them. */
  bool Update(const SplatDrawing& drawing);

  ///@{
  /** Programs can read the textures between these two calls. */
  void Activate();
  void Deactivate();
  ///@}

  /** Tells a program that resolves the sums where those of this layer and of the front layer are. Both must be active. */
  void SetUniforms(
    vtkShaderProgram* program, const SplatLayer& front, const SplatDrawing& drawing) const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  SplatLayer(const SplatLayer&) = delete;
  void operator=(const SplatLayer&) = delete;

  VisibilityPass Visibility;
  AccumulationPass Accumulation;
  StrongestPass Strongest;
  const std::array<SplatPass*, 3> Passes; // in this order
  SplatPrimitives Primitives;
  std::vector<double> Key; // what the textures were drawn from
};
}
